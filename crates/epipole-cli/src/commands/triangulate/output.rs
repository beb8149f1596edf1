//! Files of triangulated points.

use super::judge::Point;
use crate::failure::Failure;
use crate::files::is_standard;
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use std::fmt::Write as _;
use std::path::Path;

type Writer = fn(&[Option<Point>]) -> Vec<u8>;

/// Returns the writer for a file extension; CSV for `-`.
///
/// # Errors
/// For other extensions.
pub(super) fn writer(path: &Path) -> Result<Writer, Failure> {
    if is_standard(path) {
        return Ok(csv);
    }
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    match ending.to_str() {
        Some("ply") => Ok(ply),
        Some("csv") => Ok(csv),
        _ => Err(Failure::usage(format!(
            "{} must be a .ply or .csv file",
            path.display()
        ))),
    }
}

fn ply(points: &[Option<Point>]) -> Vec<u8> {
    let cloud = PointCloud {
        points: points
            .iter()
            .flatten()
            .map(|point| point.position)
            .collect(),
        ..PointCloud::default()
    };
    write_ply(&cloud)
}

/// Writes a line per match, without numbers if it has no point.
fn csv(points: &[Option<Point>]) -> Vec<u8> {
    let mut text = "x,y,z,error_px,angle_deg\n".to_owned();
    for point in points {
        let row = point
            .map(Point::row)
            .map(|row| row.map(|number| number.to_string()).join(","));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", row.unwrap_or_else(|| ",,,,".to_owned()));
    }
    text.into_bytes()
}
