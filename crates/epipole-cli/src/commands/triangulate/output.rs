//! Files of triangulated points.

use super::judge::Point;
use crate::failure::Failure;
use crate::files;
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use std::fmt::Write as _;
use std::path::Path;

type Writer = fn(&Path, &[Option<Point>]) -> Result<(), Failure>;

/// The writer of a file, by its ending.
///
/// # Errors
/// A sentence on another ending.
pub(super) fn writer(path: &Path) -> Result<Writer, Failure> {
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

fn ply(path: &Path, points: &[Option<Point>]) -> Result<(), Failure> {
    let cloud = PointCloud {
        points: points
            .iter()
            .flatten()
            .map(|point| point.position)
            .collect(),
        colors: Vec::new(),
    };
    files::write(path, &write_ply(&cloud))
}

/// A line for each match; without numbers where it has no point.
fn csv(path: &Path, points: &[Option<Point>]) -> Result<(), Failure> {
    let mut text = "x,y,z,error_px,angle_deg\n".to_owned();
    for point in points {
        let row = point
            .map(Point::row)
            .map(|row| row.map(|number| number.to_string()).join(","));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", row.unwrap_or_else(|| ",,,,".to_owned()));
    }
    files::write(path, text.as_bytes())
}
