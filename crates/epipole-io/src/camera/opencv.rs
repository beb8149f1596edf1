//! Cameras of OpenCV's `FileStorage`: YAML, XML and JSON.
//!
//! OpenCV's samples write `camera_matrix`, `distortion_coefficients` and `image_width`, those for
//! rigs `M1`, `D1`, `M2`, `D2`, `R` and `T`; other programs write `K`, `dist_coeffs` and similar
//! keys. Four coefficients are a fisheye's if `fisheye_model` is 1 or the model is named so. Pixel
//! centers are at integers; `R` and `T` are `right_from_left`, in the unit of the board.
//!
//! Source: OpenCV, `modules/core/src/persistence*.cpp`,
//! `samples/cpp/tutorial_code/calib3d/camera_calibration/camera_calibration.cpp`,
//! `samples/cpp/stereo_calib.cpp`.

use super::named::{Cameras, NamedCamera};
use super::parts::{Size, fisheye, intrinsics, motion, opencv_lens, size_or};
use crate::tree::Field;
use crate::{Error, Result};
use epipole::camera::{Camera, Lens};

/// Keys of K, lower case and without `_`.
pub(super) const MATRIX: [&str; 7] = [
    "cameramatrix",
    "k",
    "intrinsicmatrix",
    "intrinsics",
    "mtx",
    "cammatrix",
    "m",
];
/// Keys of the coefficients.
pub(super) const COEFFICIENTS: [&str; 9] = [
    "distortioncoefficients",
    "distcoeffs",
    "distortioncoeffs",
    "distcoeff",
    "distcoefs",
    "distortion",
    "d",
    "dist",
    "distortions",
];

/// Returns the keys of one side of a rig: with 1 or 2, or left or right, as prefix or suffix.
fn of_side(keys: &[&str], side: usize) -> Vec<String> {
    let (number, word, letter) = [("1", "left", "l"), ("2", "right", "r")][side];
    (keys.iter())
        .flat_map(|key| {
            [
                format!("{key}{number}"),
                format!("{key}{word}"),
                format!("{word}{key}"),
                format!("{key}{letter}"),
            ]
        })
        .collect()
}

/// Returns K of one side of a rig. `k1` may also be a coefficient, a number.
fn side_matrix<'a>(root: &Field<'a>, side: usize) -> Option<Field<'a>> {
    let keys = of_side(&MATRIX, side);
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    root.any(&keys).filter(|field| field.text().is_none())
}

pub(super) fn is_it(root: &Field) -> bool {
    root.any(&MATRIX).is_some() || side_matrix(root, 0).is_some()
}

/// * `size`: of the images, for a file without one
pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let size = match image_size(root)? {
        Some(size) => Some(size),
        None => size,
    };
    let size = size_or(size, "image_width and image_height")?;
    if let Some(left) = side_matrix(root, 0) {
        let right = side_matrix(root, 1)
            .ok_or_else(|| Error::malformed("M1 is a rig's, but M2 is missing"))?;
        let side = |index: usize, matrix: &Field| {
            let keys = of_side(&COEFFICIENTS, index);
            let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
            camera(root, matrix, &keys, size)
        };
        let right_from_left = match (root.get("R"), root.get("T")) {
            (Some(rotation), Some(translation)) => Some(motion(&rotation, &translation)?),
            _ => None,
        };
        return Ok(Cameras {
            cameras: vec![
                NamedCamera::new("left", side(0, &left)?),
                NamedCamera::new("right", side(1, &right)?),
            ],
            right_from_left,
            ..Cameras::default()
        });
    }
    let matrix = root
        .any(&MATRIX)
        .ok_or_else(|| root.missing("camera_matrix", "a 3 × 3 matrix"))?;
    Ok(Cameras::of(camera(root, &matrix, &COEFFICIENTS, size)?))
}

/// Returns width and height, if the file has them.
pub(super) fn image_size(root: &Field) -> Result<Option<Size>> {
    let width = root.any(&["imagewidth", "width"]);
    let height = root.any(&["imageheight", "height"]);
    if let (Some(width), Some(height)) = (width, height) {
        return Ok(Some((width.pixels()?, height.pixels()?)));
    }
    let Some(both) = root.any(&["imagesize", "resolution", "size", "imgsize"]) else {
        return Ok(None);
    };
    let is_side = |side: &f64| side.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(side);
    match both.numbers()?[..] {
        [width, height] if [width, height].iter().all(is_side) => {
            Ok(Some((width as u32, height as u32)))
        }
        _ => Err(both.wrong("is not [width, height] in pixels")),
    }
}

fn camera(root: &Field, matrix: &Field, keys: &[&str], (width, height): Size) -> Result<Camera> {
    let lens = match root.any(keys) {
        Some(field) => {
            let numbers = field.numbers()?;
            match is_fisheye(root) {
                true => fisheye(&field, &numbers)?,
                false => opencv_lens(&field, &numbers)?,
            }
        }
        None => no_lens(root)?,
    };
    Ok(Camera {
        width,
        height,
        intrinsics: intrinsics(matrix, &matrix.numbers()?)?,
        lens,
    })
}

/// Returns a lens without distortion, unless a key looks like distortion.
fn no_lens(root: &Field) -> Result<Lens> {
    let is_lens = |(key, field): &(String, Field)| {
        key.to_lowercase().contains("dist") && field.text().is_none()
    };
    match root.entries().iter().find(|entry| is_lens(entry)) {
        Some((_, field)) => {
            Err(field.wrong("is no known key: distortion_coefficients is expected"))
        }
        None => Ok(Lens::NONE),
    }
}

fn is_fisheye(root: &Field) -> bool {
    let model = root.any(&["distortionmodel", "cameramodel", "model", "lensmodel"]);
    let flag = root.any(&["fisheyemodel", "fisheye", "isfisheye", "usefisheye"]);
    let is_named = model.and_then(|model| model.text()).is_some_and(|model| {
        let model = model.to_lowercase();
        ["fisheye", "equidistant", "kannala"]
            .iter()
            .any(|name| model.contains(name))
    });
    is_named
        || flag
            .and_then(|flag| flag.text())
            .is_some_and(|flag| matches!(flag, "1" | "true" | "True" | "1."))
}

#[cfg(test)]
mod tests {
    use super::super::{CameraFormat, read_cameras};
    use crate::{Error, Result};
    use epipole::camera::{Camera, LensKind};
    use nalgebra::Vector3;

    fn one(text: &str) -> Result<Camera> {
        let (format, cameras) = read_cameras(text.as_bytes(), None)?;
        assert_eq!(format, CameraFormat::OpenCv);
        Ok(cameras.cameras[0].camera)
    }

    /// Written by OpenCV 5.0.
    const YAML: &str = "%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 532.79999999999995, 0., 342.5, 0., 532.89999999999998,
       233.90000000000001, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.28000000000000003, 0.029999999999999999, 0.001, -0.0001,
       0.10000000000000001 ]
calibration_time: \"Mon 3 Feb: x\"
";
    const XML: &str = "<?xml version=\"1.0\"?>
<opencv_storage>
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id=\"opencv-matrix\">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    532.79999999999995 0. 342.5 0. 532.89999999999998 233.90000000000001
    0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id=\"opencv-matrix\">
  <rows>1</rows>
  <cols>5</cols>
  <dt>d</dt>
  <data>
    -0.28000000000000003 0.029999999999999999 0.001 -0.0001
    0.10000000000000001</data></distortion_coefficients>
</opencv_storage>
";
    const JSON: &str = r#"{ "image_width": 640, "image_height": 480,
    "camera_matrix": { "type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
        "data": [ 532.79999999999995, 0.0, 342.5, 0.0, 532.89999999999998, 233.90000000000001, 0.0, 0.0, 1.0 ] },
    "distortion_coefficients": { "type_id": "opencv-matrix", "rows": 1, "cols": 5, "dt": "d",
        "data": [ -0.28000000000000003, 0.029999999999999999, 0.001, -0.0001, 0.10000000000000001 ] } }"#;

    #[test]
    fn yaml_xml_and_json_of_opencv_are_one_camera() {
        for text in [YAML, XML, JSON, &YAML.replace("%YAML:1.0", "%YAML 1.2")] {
            let camera = one(text).unwrap();
            assert_eq!((camera.width, camera.height), (640, 480));
            assert_eq!(camera.intrinsics.fu_px(), 532.8);
            assert_eq!(camera.intrinsics.principal_point(), [342.5, 233.9].into());
            assert_eq!(
                camera.lens.coefficients(),
                [-0.28, 0.03, 0.001, -0.0001, 0.1]
            );
        }
    }

    #[test]
    fn others_names_of_the_same_are_read() {
        for text in [
            "K: [[500, 0, 320], [0, 501, 240], [0, 0, 1]]\nD: [0.1, 0.2, 0.3, 0.4]\nsize: [640, 480]\n",
            "cameraMatrix: [500, 0, 320, 0, 501, 240, 0, 0, 1]\ndistCoeffs: [[0.1], [0.2], [0.3], [0.4]]\nwidth: 640\nheight: 480\n",
            "{\"mtx\": [[500, 0, 320], [0, 501, 240], [0, 0, 1]], \"dist\": [[0.1, 0.2, 0.3, 0.4]], \"image_size\": [640, 480]}",
        ] {
            let camera = one(text).unwrap();
            assert_eq!(camera.intrinsics.fv_px(), 501.0);
            assert_eq!(camera.lens.coefficients(), [0.1, 0.2, 0.3, 0.4, 0.0]);
            if text.starts_with('{') {
                continue;
            }
            for mark in ["fisheye_model: 1\n", "camera_model: opencv_fisheye\n"] {
                let fisheye = one(&format!("{text}{mark}")).unwrap();
                assert_eq!(fisheye.lens.kind(), LensKind::Fisheye);
                assert_eq!(fisheye.lens.coefficients(), [0.1, 0.2, 0.3, 0.4]);
            }
        }
    }

    #[test]
    fn a_stereo_file_is_a_rig() {
        let text = "size: [640, 480]\nM1: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nD1: [0.1, 0.2, 0, 0, 0, 0, 0, 0]\n\
            M2: [510, 0, 320, 0, 511, 240, 0, 0, 1]\nD2: [0, 0, 0, 0, 0, 0.1, 0, 0]\n\
            R: [0, -1, 0, 1, 0, 0, 0, 0, 1]\nT: [-0.12, 0, 0]\n";
        let (_, rig) = read_cameras(text.as_bytes(), None).unwrap();
        let [left, right] = &rig.cameras[..] else {
            panic!("{rig:?}")
        };
        assert_eq!(
            (&*left.name, left.camera.lens.kind()),
            ("left", LensKind::Brown)
        );
        assert_eq!(
            (&*right.name, right.camera.lens.kind()),
            ("right", LensKind::Rational)
        );
        let motion = rig.right_from_left.unwrap();
        assert!((motion.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        assert_eq!(motion.translation.x, -0.12);
        // The same rotation as a vector.
        let vector = text.replace("[0, -1, 0, 1, 0, 0, 0, 0, 1]", "[0, 0, 1.5707963267948966]");
        let (_, same) = read_cameras(vector.as_bytes(), None).unwrap();
        let off = same.right_from_left.unwrap().to_matrix() - motion.to_matrix();
        assert!(off.amax() < 1e-15);
        let (_, still) = read_cameras(text.replace("\nT:", "\nU:").as_bytes(), None).unwrap();
        assert_eq!(still.right_from_left, None);
    }

    #[test]
    fn errors_name_key_and_line() {
        let wrong = |from: &str, to: &str| one(&YAML.replacen(from, to, 1)).unwrap_err();
        for (from, to, message) in [
            (
                "233.90000000000001,",
                "wide,",
                "line 5: camera_matrix is not a list of finite numbers: \"wide\"",
            ),
            (
                "0., 0., 1. ]",
                "0., 1. ]",
                "line 5: camera_matrix is not a 3 × 3 matrix [fx 0 cx; 0 fy cy; 0 0 1]",
            ),
            (
                "image_width: 640\n",
                "",
                "the file has no image size: image_width and image_height are missing",
            ),
            (
                "image_width: 640",
                "image_width: -640",
                "line 3: image_width is not a whole number above 0: \"-640\"",
            ),
            (
                "distortion_coefficients",
                "my_dist_values",
                "line 11: my_dist_values is no known key: distortion_coefficients is expected",
            ),
        ] {
            assert_eq!(wrong(from, to).to_string(), message);
        }
        let prism = YAML.replace("0.10000000000000001 ]", "0.1, 0, 0, 0, 1e-3, 0, 0, 0 ]");
        let error = one(&prism).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }), "{error}");
        let error = one("a: 1\nb: [2]\n").unwrap_err().to_string();
        assert!(
            error.ends_with("MATLAB writes: its keys are a, b"),
            "{error}"
        );
    }
}
