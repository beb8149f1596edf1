//! MATLAB's `cameraParameters`, `cameraIntrinsics` and `stereoParameters` as JSON, written by
//! `jsonencode(toStruct(params))`.
//!
//! Pixel centers count from 1, so 1 is subtracted. `K` is `[fx s cx; 0 fy cy; 0 0 1]`,
//! `IntrinsicMatrix` its transpose, and `RotationOfCamera2` the transpose of R in
//! `x_in_camera2 = R x_in_camera1 + t`. Radial and tangential coefficients are OpenCV's.
//! `ImageSize` is rows, columns.
//!
//! Source: MathWorks, documentation of `cameraParameters`, `stereoParameters`,
//! `cameraIntrinsicsToOpenCV`.

use super::named::{Cameras, NamedCamera};
use super::parts::{Size, check_skew, intrinsics, lens, matrix_rotation, size_or};
use crate::Result;
use crate::tree::Field;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::Translation3;

/// Keys of a camera.
const OWN: [&str; 5] = [
    "RadialDistortion",
    "IntrinsicMatrix",
    "FocalLength",
    "CameraParameters1",
    "MappingCoefficients",
];

fn is_own(field: &Field) -> bool {
    OWN.iter().any(|key| field.get(key).is_some())
}

/// Returns the parameters, which may be the single value under the name of a variable.
fn unwrap_root<'a>(root: &Field<'a>) -> Field<'a> {
    let mut inner = root.entries().into_iter().map(|(_, field)| field);
    match is_own(root) {
        true => root.clone(),
        false => inner.find(is_own).unwrap_or_else(|| root.clone()),
    }
}

pub(super) fn is_it(root: &Field) -> bool {
    is_own(&unwrap_root(root))
}

/// * `size`: of the images, for a file without one
pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let params = unwrap_root(root);
    let Some(left) = params.get("CameraParameters1") else {
        return Ok(Cameras::of(camera(&params, size)?));
    };
    let right = params.need("CameraParameters2", "the second camera of the rig")?;
    Ok(Cameras {
        cameras: vec![
            NamedCamera::new("left", camera(&left, size)?),
            NamedCamera::new("right", camera(&right, size)?),
        ],
        right_from_left: motion(&params)?,
        ..Cameras::default()
    })
}

fn camera(params: &Field, size: Option<Size>) -> Result<Camera> {
    let nested = params.get("Intrinsics");
    let get = |key: &str| {
        let inner = || nested.as_ref().and_then(|nested| nested.get(key));
        params.get(key).or_else(inner)
    };
    if let Some(field) = get("MappingCoefficients") {
        return Err(field.unsupported(
            "is of Scaramuzza's fisheye model, which is not supported: calibrate with another",
        ));
    }
    let rows_and_columns = get("ImageSize");
    let sides = (rows_and_columns.as_ref()).map_or(Ok(Vec::new()), Field::numbers)?;
    let (width, height) = match rows_and_columns {
        Some(field) if !sides.is_empty() => {
            let is_side =
                |side: &f64| side.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(side);
            match sides[..] {
                [rows, columns] if sides.iter().all(is_side) => (columns as u32, rows as u32),
                _ => return Err(field.wrong("is not [rows, columns] in pixels")),
            }
        }
        _ => size_or(size, "rows and columns of ImageSize")?,
    };
    let k = if let Some(field) = get("K") {
        intrinsics(&field, &field.numbers()?)?
    } else if let Some(field) = get("IntrinsicMatrix") {
        let k = field.numbers()?;
        if k.len() != 9 {
            return Err(field.wrong("is not a 3 × 3 matrix"));
        }
        let transposed: Vec<f64> = (0..9).map(|i| k[i % 3 * 3 + i / 3]).collect();
        intrinsics(&field, &transposed)?
    } else {
        let focal = get("FocalLength").ok_or_else(|| params.missing("K", "a 3 × 3 matrix"))?;
        let center = get("PrincipalPoint")
            .ok_or_else(|| params.missing("PrincipalPoint", "[cx, cy] in pixels"))?;
        let ([fx, fy], [cx, cy]) = (two(&focal)?, two(&center)?);
        if let Some(skew) = get("Skew") {
            check_skew(&skew, skew.number()?, fx)?;
        }
        Intrinsics::new(fx, fy, cx, cy)?
    };
    let center = k.principal_point();
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::new(k.fu_px(), k.fv_px(), center.x - 1.0, center.y - 1.0)?,
        lens: lens_of(get("RadialDistortion"), get("TangentialDistortion"))?,
    })
}

fn two(field: &Field) -> Result<[f64; 2]> {
    let numbers = field.numbers()?;
    <[f64; 2]>::try_from(numbers).map_err(|_| field.wrong("is not two numbers"))
}

fn lens_of(radial: Option<Field>, tangential: Option<Field>) -> Result<Lens> {
    let mut k = [0.0; 5];
    if let Some(field) = radial {
        match field.numbers()?[..] {
            [k1, k2] => [k[0], k[1]] = [k1, k2],
            [k1, k2, k3] => [k[0], k[1], k[4]] = [k1, k2, k3],
            _ => return Err(field.wrong("is not two or three numbers")),
        }
    }
    if let Some(field) = tangential {
        [k[2], k[3]] = two(&field)?;
    }
    lens(LensKind::Brown, &k)
}

fn motion(params: &Field) -> Result<Option<RigidTransform>> {
    let (rotation, translation, is_transposed) =
        match (params.get("RotationOfCamera2"), params.get("PoseCamera2")) {
            (Some(rotation), _) => {
                let translation = params.need("TranslationOfCamera2", "three numbers")?;
                (rotation, translation, true)
            }
            (None, Some(pose)) => {
                let rotation = pose.need("R", "a 3 × 3 matrix")?;
                (rotation, pose.need("Translation", "three numbers")?, false)
            }
            (None, None) => return Ok(None),
        };
    let [x, y, z] = translation.numbers()?[..] else {
        return Err(translation.wrong("is not three numbers"));
    };
    let rotation_of_second = matrix_rotation(&rotation, &rotation.numbers()?)?;
    let rotation_of_second = match is_transposed {
        true => rotation_of_second.inverse(),
        false => rotation_of_second,
    };
    Ok(Some(RigidTransform::from_parts(
        Translation3::new(x, y, z),
        rotation_of_second,
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::tree::Syntax;
    use nalgebra::Vector3;

    fn parse(text: &str) -> Result<Cameras> {
        let node = Syntax::Json.parse(text).unwrap();
        let root = Field::root(&node);
        assert!(is_it(&root));
        read(&root, None)
    }

    const ONE: &str = r#"{"RadialDistortion": [-0.3, 0.1], "TangentialDistortion": [0.001, 0.002],
        "ImageSize": [480, 640], "IntrinsicMatrix": [[500, 0, 0], [0, 501, 0], [320, 240, 1]]}"#;

    #[test]
    fn pixels_count_from_one() {
        for text in [
            ONE.to_owned(),
            format!("{{\"cameraParams\": {ONE}}}"),
            ONE.replace("IntrinsicMatrix", "K").replace(
                "[500, 0, 0], [0, 501, 0], [320, 240, 1]",
                "[500,0,320],[0,501,240],[0,0,1]",
            ),
            ONE.replace(
                "\"IntrinsicMatrix\": [[500, 0, 0], [0, 501, 0], [320, 240, 1]]",
                "\"FocalLength\": [500, 501], \"PrincipalPoint\": [320, 240], \"Skew\": 0",
            ),
        ] {
            let camera = parse(&text).unwrap().cameras[0].camera;
            let k = Intrinsics::new(500.0, 501.0, 319.0, 239.0).unwrap();
            assert_eq!(
                (camera.width, camera.height, camera.intrinsics),
                (640, 480, k)
            );
            assert_eq!(camera.lens.coefficients(), [-0.3, 0.1, 0.001, 0.002, 0.0]);
        }
        let error = parse(&ONE.replace("[0.001, 0.002]", "[0.001]")).unwrap_err();
        assert_eq!(error.to_string(), "TangentialDistortion is not two numbers");
        let skewed = ONE.replace("[0, 501, 0]", "[3, 501, 0]");
        assert!(matches!(parse(&skewed), Err(Error::Unsupported { .. })));
    }

    #[test]
    fn rotations_of_rows_are_transposed() {
        // [x2 y2 z2] = [x1 y1 z1] R: x of the first camera is y of the second one.
        let rows = "[[0, 1, 0], [-1, 0, 0], [0, 0, 1]]";
        let text = format!(
            r#"{{"CameraParameters1": {ONE}, "CameraParameters2": {ONE}, "RotationOfCamera2": {rows},
            "TranslationOfCamera2": [-120, 1, 2]}}"#
        );
        let motion = parse(&text).unwrap().right_from_left.unwrap();
        assert!((motion.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        assert_eq!(motion.translation.vector.x, -120.0);
        let columns = text
            .replace(&format!("\"RotationOfCamera2\": {rows}"), "\"PoseCamera2\": {\"R\": [[0,-1,0],[1,0,0],[0,0,1]], \"Translation\": [-120, 1, 2]}")
            .replace("\"TranslationOfCamera2\"", "\"other\"");
        let same = parse(&columns).unwrap().right_from_left.unwrap();
        assert!((same.to_matrix() - motion.to_matrix()).amax() < 1e-15);
    }
}
