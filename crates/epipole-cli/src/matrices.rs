//! Numbers on the command line and in results: intrinsics, matrices, motions.

use epipole::camera::{Intrinsics, RigidTransform};
use nalgebra::{Matrix3, Point2, Vector3};
use serde::Serialize;

/// Returns the entries of a matrix, row by row.
pub(crate) fn row_major(matrix: &Matrix3<f64>) -> [f64; 9] {
    let mut entries = [0.0; 9];
    entries.copy_from_slice(matrix.transpose().as_slice());
    entries
}

/// A rotation matrix, row by row, and a translation.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Motion {
    rotation: [f64; 9],
    translation: [f64; 3],
}

impl From<&RigidTransform> for Motion {
    fn from(transform: &RigidTransform) -> Self {
        let rotation = transform.rotation.to_rotation_matrix();
        Self {
            rotation: row_major(rotation.matrix()),
            translation: transform.translation.vector.into(),
        }
    }
}

/// Reads `fx,fy,cx,cy`.
pub(crate) fn intrinsics(text: &str) -> Result<Intrinsics, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(numbers @ [_, _, _, _]) if numbers.iter().any(|number| number.abs() > *FAR.end()) => {
            Err(format!("no number may be beyond {:e} pixels", FAR.end()))
        }
        Ok([fu, fv, cu, cv]) => {
            Intrinsics::new(*fu, *fv, *cu, *cv).map_err(|error| error.to_string())
        }
        _ => Err("it must be four numbers: fx,fy,cx,cy".to_owned()),
    }
}

/// Reads `u,v`.
pub(crate) fn pixel(text: &str) -> Result<Point2<f64>, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([u, v]) if u.abs().max(v.abs()) <= *FAR.end() => Ok(Point2::new(*u, *v)),
        _ => Err("it must be two numbers of pixels: u,v".to_owned()),
    }
}

/// Reads `x,y,z`, a direction.
pub(crate) fn direction(text: &str) -> Result<Vector3<f64>, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) => {
            let vector = Vector3::new(*x, *y, *z);
            if !vector.iter().all(|x| x.is_finite()) {
                return Err("x, y and z must be finite numbers".to_owned());
            }
            let has_direction = vector.amax() > 0.0;
            has_direction.then_some(vector).ok_or_else(|| {
                "it must have a direction: not all of x, y and z may be 0".to_owned()
            })
        }
        _ => Err("it must be three numbers: x,y,z".to_owned()),
    }
}

/// Range of lengths, angles and numbers of pixels, whose squares neither overflow nor vanish.
pub(crate) const FAR: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// Reads a number above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if FAR.contains(&value) => Ok(value),
        Ok(value) if value > 0.0 && value.is_finite() => Err(format!(
            "\"{text}\" is beyond all measure: at least {:e} and at most {:e}",
            FAR.start(),
            FAR.end()
        )),
        _ => Err(format!("\"{text}\" is not a number above 0")),
    }
}

/// Reads a number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= *FAR.end() => Ok(value),
        _ => Err(format!("\"{text}\" is not a number up to {:e}", FAR.end())),
    }
}

/// Reads a number of 0 or more.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err(format!("\"{text}\" is not a number of 0 or more")),
    }
}

/// Reads a fraction, 0 to 1.
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err(format!("\"{text}\" is not a number from 0 to 1")),
    }
}

/// Reads `WIDTHxHEIGHT`.
pub(crate) fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text
        .split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match parsed {
        Some((width @ 1..=16384, height @ 1..=16384)) => Ok((width, height)),
        _ => Err("it must be WIDTHxHEIGHT, each 1 to 16384, as 1600x1200".to_owned()),
    }
}
