//! Points that do not determine a pose.

use crate::failure::Failure;
use nalgebra::{Point2, Point3, Vector3};
use std::collections::BTreeSet;
use std::path::Path;

/// Minimum number of points of a unique pose.
pub(super) const MIN_POINTS: usize = 4;

/// Distance from a line, relative to its length, below which points are on it.
const FLAT: f64 = 1e-6;

/// Message for four points without a focal length.
pub(super) const NO_FOCAL: &str = "no focal length fits these points: three of them lie on one line, in the world or in \
    the image, their plane faces the camera, or a pixel belongs to another point";

/// Refuses points that do not determine the pose.
///
/// # Errors
/// A failure with the reason.
pub(super) fn check(pixels: &[Point2<f64>], points: &[Point3<f64>]) -> Result<(), Failure> {
    let distinct = |keys: &mut dyn Iterator<Item = Vec<u64>>| keys.collect::<BTreeSet<_>>().len();
    // −0 equals 0.
    let key = |numbers: &[f64]| numbers.iter().map(|x| (x + 0.0).to_bits()).collect();
    let num_points = distinct(&mut points.iter().map(|x| key(x.coords.as_slice())));
    let num_pixels = distinct(&mut pixels.iter().map(|x| key(x.coords.as_slice())));
    let rows = points.len();
    let too_few = |message: String| Err(Failure::new("too-few", message));
    if rows < MIN_POINTS {
        return too_few(format!(
            "there are {rows} points, and a pose needs {MIN_POINTS}: three have up to four poses"
        ));
    }
    if num_points < MIN_POINTS {
        return too_few(format!(
            "only {num_points} of the {rows} points are distinct, and a pose needs {MIN_POINTS}"
        ));
    }
    if num_pixels < MIN_POINTS {
        return too_few(format!(
            "the {rows} points are at only {num_pixels} distinct pixels, and a pose needs {MIN_POINTS}"
        ));
    }
    if are_on_a_line(points) {
        let message = "all points are collinear: a rotation about their line moves no pixel, so the pose is not determined";
        return Err(Failure::new("degenerate", message));
    }
    Ok(())
}

fn are_on_a_line(points: &[Point3<f64>]) -> bool {
    let farthest = |from: &Point3<f64>| -> Vector3<f64> {
        let sides = points.iter().map(|x| x - from);
        sides
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))
            .unwrap_or_default()
    };
    let end = points[0] + farthest(&points[0]);
    let along = farthest(&end);
    let length = along.norm();
    let beside = |x: &Point3<f64>| along.cross(&(x - end)).norm() / length;
    points.iter().all(|x| beside(x) <= FLAT * length)
}

/// Adds advice to a failure without a pose.
pub(super) fn with_advice(failure: Failure, path: &Path) -> Failure {
    let failure = failure.about(path);
    match failure.kind {
        "no-consensus" => Failure {
            message: format!("{failure}; {ADVICE}"),
            ..failure
        },
        _ => failure,
    }
}

/// Usual causes of a missing pose.
pub(super) const ADVICE: &str =
    "are the columns x y z u v, and the intrinsics those of this image?";

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn points_on_a_line_are_found_at_any_place_and_scale() {
        for (place, scale) in [(0.0, 1.0), (1e3, 1.0), (0.0, 1e-9), (1e6, 1e3)] {
            let point = |n: u32| Vector3::new(1.0, 2.0, -0.5) * f64::from(n * n) * scale;
            let mut line: Vec<_> = (0..6)
                .map(|n| Point3::from(point(n)).map(|x| x + place))
                .collect();
            assert!(are_on_a_line(&line), "{place} {scale}");
            line[3].x += 0.01 * scale;
            assert!(!are_on_a_line(&line), "{place} {scale}");
        }
    }
}
