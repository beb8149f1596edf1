//! Bundle adjustment problems: the text format of "Bundle Adjustment in the Large".
//!
//! Source: Agarwal et al. 2010, "Bundle Adjustment in the Large".

use crate::Result;
use crate::tokens::Tokens;
use epipole::sfm::{BalCamera, BalProblem, BundleObservation};
use nalgebra::{Point2, Point3, Vector3};
use std::fmt::Write;

/// Reads the format: numbers of cameras, points and observations; then one observation per line
/// (camera, point, u, v); then nine numbers per camera (rotation, translation, f, k1, k2); then
/// three per point.
///
/// # Errors
/// [`Error::Malformed`](crate::Error::Malformed) with the line, if words are missing, surplus, not
/// finite, or an index out of range.
pub fn read_bal(text: &str) -> Result<BalProblem> {
    let mut tokens = Tokens::new(text);
    let limit = u32::MAX as usize;
    let num_cameras = tokens.index("the number of cameras", limit)?;
    let num_points = tokens.index("the number of points", limit)?;
    let num_observations = tokens.index("the number of observations", limit)?;
    // The header is not trusted: capacity is limited by the length of the text.
    let room = |promised: usize| promised.min(text.len() / 2);
    let mut problem = BalProblem {
        cameras: Vec::with_capacity(room(num_cameras)),
        points: Vec::with_capacity(room(num_points)),
        observations: Vec::with_capacity(room(num_observations)),
    };
    for _ in 0..num_observations {
        problem.observations.push(BundleObservation {
            camera: tokens.index("an observation's camera", num_cameras)?,
            point: tokens.index("an observation's point", num_points)?,
            pixel: Point2::new(
                tokens.number("an observation's u")?,
                tokens.number("an observation's v")?,
            ),
        });
    }
    for _ in 0..num_cameras {
        let mut v = [0.0; 9];
        for value in &mut v {
            *value = tokens.number("a camera's parameter")?;
        }
        problem.cameras.push(BalCamera {
            rotation: Vector3::new(v[0], v[1], v[2]),
            translation: Vector3::new(v[3], v[4], v[5]),
            focal_px: v[6],
            k1: v[7],
            k2: v[8],
        });
    }
    for _ in 0..num_points {
        let mut v = [0.0; 3];
        for value in &mut v {
            *value = tokens.number("a point's coordinate")?;
        }
        problem.points.push(Point3::from(v));
    }
    tokens.end()?;
    Ok(problem)
}

/// Returns whether the first line of a text is that of a problem (three whole numbers), even if the
/// rest is malformed.
pub fn is_bal(text: &str) -> bool {
    let mut lines = text.lines();
    let mut words = || lines.next().unwrap_or_default().split_whitespace();
    let (first, second) = (words(), words());
    first.clone().count() == 3
        && first.clone().all(|word| word.parse::<usize>().is_ok())
        // Three numbers would be a row of a matrix.
        && second.count() != 3
}

/// Writes the format, with enough digits to read numbers back unchanged.
pub fn write_bal(problem: &BalProblem) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{} {} {}",
        problem.cameras.len(),
        problem.points.len(),
        problem.observations.len()
    );
    for o in &problem.observations {
        let _ = writeln!(
            text,
            "{} {} {:e} {:e}",
            o.camera, o.point, o.pixel.x, o.pixel.y
        );
    }
    for camera in &problem.cameras {
        for value in camera.rotation.iter().chain(&camera.translation) {
            let _ = writeln!(text, "{value:e}");
        }
        let _ = writeln!(
            text,
            "{:e}\n{:e}\n{:e}",
            camera.focal_px, camera.k1, camera.k2
        );
    }
    for point in &problem.points {
        let _ = writeln!(text, "{:e}\n{:e}\n{:e}", point.x, point.y, point.z);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;

    #[test]
    fn malformed_texts_name_the_line() {
        let good = "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n";
        assert!(read_bal(good).is_ok());
        for (bad, line, why) in [
            ("", 1, "ends"),
            ("1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2\n", 4, "ends"),
            ("1 1 1\n0 0 11 nan\n", 2, "not finite"),
            ("1 1 1\n0 0 eleven 20\n", 2, "not a number"),
            ("1 1 1\n1 0 11 20\n", 2, "less than 1"),
            ("1 1 1\n0 -1 11 20\n", 2, "whole"),
            (
                "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n7\n",
                5,
                "should end",
            ),
            ("99999999 9 4000000000\n", 1, "ends"),
        ] {
            match read_bal(bad) {
                Err(Error::Malformed {
                    line: got,
                    message: text,
                }) => {
                    assert_eq!(got, Some(line), "{bad:?}");
                    assert!(text.contains(why), "{text}");
                }
                other => panic!("{bad:?} gave {other:?}"),
            }
        }
    }
}
