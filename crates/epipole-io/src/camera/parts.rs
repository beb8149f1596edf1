//! Parts shared by several formats: K, sizes, lenses in OpenCV's order, rotations.

use crate::rotation::{FOUR_DIGITS, rotation_from_matrix};
use crate::tree::Field;
use crate::{Error, Result};
use epipole::camera::{Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::{Matrix3, Translation3, UnitQuaternion, Vector3};

/// Width and height, pixels.
pub(super) type Size = (u32, u32);

/// Bound of a translation, in units of the file.
const FAR: f64 = 1e12;

/// Maximum skew relative to the focal length that counts as rounding.
const ROUNDED_SKEW: f64 = 1e-9;

/// Returns the size of the images for a file without one, if the caller knows it.
///
/// # Errors
/// [`Error::Malformed`] if not.
pub(super) fn size_or(size: Option<Size>, keys: &str) -> Result<Size> {
    size.ok_or_else(|| Error::malformed(format!("the file has no image size: {keys} are missing")))
}

/// Returns the intrinsics from the nine numbers of K, row by row, or column by column as in Open3D.
pub(super) fn intrinsics(field: &Field, k: &[f64]) -> Result<Intrinsics> {
    if let &[fx, skew, 0.0, 0.0, fy, 0.0, cx, cy, 1.0] = k
        && [cx, cy] != [0.0; 2]
    {
        check_skew(field, skew, fx)?;
        return Ok(Intrinsics::new(fx, fy, cx, cy)?);
    }
    let &[fx, skew, cx, zero, fy, cy, ..] = k else {
        return Err(field.wrong("is not a 3 × 3 matrix"));
    };
    if k.len() != 9 || zero != 0.0 || k[6..] != [0.0, 0.0, 1.0] {
        return Err(field.wrong("is not a 3 × 3 matrix [fx 0 cx; 0 fy cy; 0 0 1]"));
    }
    check_skew(field, skew, fx)?;
    Ok(Intrinsics::new(fx, fy, cx, cy)?)
}

/// # Errors
/// [`Error::Unsupported`] for a skew other than 0.
pub(super) fn check_skew(field: &Field, skew: f64, focal_px: f64) -> Result<()> {
    match skew.abs() <= ROUNDED_SKEW * focal_px.abs() {
        true => Ok(()),
        false => {
            Err(field.unsupported(&format!("has a skew of {skew} pixels: only 0 is supported")))
        }
    }
}

/// Returns the lens of OpenCV's coefficients: none, k1 k2 p1 p2, then k3, then k4 k5 k6, then s1 to
/// s4 and τx τy, which must be 0.
///
/// Source: OpenCV's documentation of `calib3d`, "Detailed description".
pub(super) fn opencv_lens(field: &Field, k: &[f64]) -> Result<Lens> {
    match k.len() {
        0 => Ok(Lens::NONE),
        4 => lens(LensKind::Brown, &[k[0], k[1], k[2], k[3], 0.0]),
        5 => lens(LensKind::Brown, k),
        8 => rational(k),
        12 | 14 if k[8..].iter().all(|&more| more == 0.0) => rational(&k[..8]),
        12 | 14 => Err(field.unsupported(
            "has coefficients of a thin prism or a tilted sensor: only 0 is supported for these",
        )),
        count => Err(field.wrong(&format!(
            "has {count} coefficients: 4, 5, 8, 12 or 14 are expected"
        ))),
    }
}

/// Returns a rational lens, or Brown's if the denominator is 1.
fn rational(k: &[f64]) -> Result<Lens> {
    match k[5..] == [0.0; 3] {
        true => lens(LensKind::Brown, &k[..5]),
        false => lens(LensKind::Rational, k),
    }
}

/// Returns a fisheye lens from k1 to k4.
pub(super) fn fisheye(field: &Field, k: &[f64]) -> Result<Lens> {
    match k.len() {
        4 => lens(LensKind::Fisheye, k),
        count => Err(field.wrong(&format!(
            "has {count} coefficients: 4 are expected of a fisheye"
        ))),
    }
}

pub(super) fn lens(kind: LensKind, k: &[f64]) -> Result<Lens> {
    Ok(Lens::from_coefficients(kind, k)?)
}

/// Returns a translation, and refuses one so long that inverting the pose could overflow.
pub(super) fn translation(field: &Field, [x, y, z]: [f64; 3]) -> Result<Translation3<f64>> {
    match [x, y, z].iter().all(|part| part.abs() < FAR) {
        true => Ok(Translation3::new(x, y, z)),
        false => Err(field.wrong("is too far for a camera")),
    }
}

/// Returns a motion from a rotation, nine numbers row by row or a rotation vector, and a
/// translation.
pub(super) fn motion(rotation: &Field, place: &Field) -> Result<RigidTransform> {
    let numbers = rotation.numbers()?;
    let quaternion = match numbers[..] {
        [x, y, z] if Vector3::new(x, y, z).norm() < FAR => {
            UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z))
        }
        [_, _, _] => return Err(rotation.wrong("is not a rotation vector in radians")),
        _ => matrix_rotation(rotation, &numbers)?,
    };
    let [x, y, z] = place.numbers()?[..] else {
        return Err(place.wrong("is not three numbers"));
    };
    Ok(RigidTransform::from_parts(
        translation(place, [x, y, z])?,
        quaternion,
    ))
}

/// Returns a motion from a 4 × 4 matrix, row by row.
pub(super) fn matrix_motion(field: &Field) -> Result<RigidTransform> {
    let numbers = field.numbers()?;
    let all: [f64; 16] = (numbers.try_into()).map_err(|_| field.wrong("is not a 4 × 4 matrix"))?;
    let rotation = [&all[..3], &all[4..7], &all[8..11]].concat();
    Ok(RigidTransform::from_parts(
        translation(field, [all[3], all[7], all[11]])?,
        matrix_rotation(field, &rotation)?,
    ))
}

/// Returns the rotation nearest to nine numbers, row by row.
pub(super) fn matrix_rotation(field: &Field, numbers: &[f64]) -> Result<UnitQuaternion<f64>> {
    let no_rotation = || field.wrong("is not nine numbers of a rotation");
    if numbers.len() != 9 {
        return Err(no_rotation());
    }
    let matrix = Matrix3::from_row_slice(numbers);
    rotation_from_matrix(&matrix, FOUR_DIGITS).ok_or_else(no_rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::Syntax;

    #[test]
    fn coefficients_of_all_lengths() {
        let node = Syntax::Yaml.parse("D: 1").unwrap();
        let root = Field::root(&node);
        let field = root.get("D").unwrap();
        let all = [
            0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        ];
        for (count, kind) in [
            (0, LensKind::Brown),
            (4, LensKind::Brown),
            (5, LensKind::Brown),
            (8, LensKind::Rational),
            (12, LensKind::Rational),
            (14, LensKind::Rational),
        ] {
            assert_eq!(opencv_lens(&field, &all[..count]).unwrap().kind(), kind);
        }
        let mut prism = all;
        prism[9] = 1e-3;
        assert!(matches!(
            opencv_lens(&field, &prism[..12]),
            Err(Error::Unsupported { .. })
        ));
        let message = opencv_lens(&field, &all[..6]).unwrap_err().to_string();
        assert_eq!(
            message,
            "line 1: D has 6 coefficients: 4, 5, 8, 12 or 14 are expected"
        );
        assert!(fisheye(&field, &all[..5]).is_err());
    }

    #[test]
    fn matrices_are_checked() {
        let node = Syntax::Yaml.parse("K: 1").unwrap();
        let field = Field::root(&node).get("K").unwrap();
        let k = [500.0, 0.0, 320.0, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0];
        assert_eq!(
            intrinsics(&field, &k).unwrap(),
            Intrinsics::new(500.0, 501.0, 320.0, 240.0).unwrap()
        );
        let mut skewed = k;
        skewed[1] = 2.0;
        assert!(matches!(
            intrinsics(&field, &skewed),
            Err(Error::Unsupported { .. })
        ));
        let mut transposed = k;
        transposed.swap(2, 6);
        assert!(intrinsics(&field, &transposed).is_err());
        transposed.swap(5, 7);
        assert_eq!(intrinsics(&field, &transposed), intrinsics(&field, &k));
        assert!(intrinsics(&field, &k[..6]).is_err());
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, 0.2, 0.3));
        let numbers: Vec<f64> = (rotation.to_rotation_matrix().matrix().transpose().iter())
            .map(|x: &f64| (x * 1e5).round() / 1e5)
            .collect();
        let read = matrix_rotation(&field, &numbers).unwrap();
        assert!(read.angle_to(&rotation) < 1e-5);
        assert!(matrix_rotation(&field, &[0.5; 9]).is_err());
    }

    #[test]
    fn motions_without_end_are_refused() {
        let read = |text: &str| {
            let node = Syntax::Json.parse(text).unwrap();
            let root = Field::root(&node);
            motion(&root.get("R").unwrap(), &root.get("T").unwrap())
        };
        assert!(read(r#"{"R": [0.1, 0, 0], "T": [1, 2, 3]}"#).is_ok());
        for (text, why) in [
            (
                r#"{"R": [-1e308, 0, 1], "T": [1, 2, 3]}"#,
                "not a rotation vector",
            ),
            (
                r#"{"R": [0.1, 0, 0], "T": [1e308, 2, 3]}"#,
                "too far for a camera",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(why), "{error}");
        }
    }
}
