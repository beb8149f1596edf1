//! `camera_info` of ROS, the file of `camera_calibration` and the message as printed.
//!
//! K is of the raw image, pixel centers at integers; rectification and projection matrix are not
//! read.
//!
//! Source: REP 104, `sensor_msgs/CameraInfo`, and `camera_calibration_parsers`.

use super::named::{Cameras, NamedCamera};
use super::opencv::{COEFFICIENTS, MATRIX, image_size};
use super::parts::{Size, fisheye, intrinsics, opencv_lens, size_or};
use crate::Result;
use crate::tree::Field;
use epipole::camera::{Camera, Lens};

pub(super) fn is_it(root: &Field) -> bool {
    root.get("distortion_model").is_some() && root.any(&MATRIX).is_some()
}

/// * `size`: of the images, for a file without one
pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let matrix = root
        .any(&MATRIX)
        .ok_or_else(|| root.missing("camera_matrix", "a 3 × 3 matrix"))?;
    let size = match image_size(root)? {
        Some(size) => Some(size),
        None => size,
    };
    let (width, height) = size_or(size, "image_width and image_height")?;
    check_whole(root)?;
    let k = matrix.numbers()?;
    if k.first() == Some(&0.0) {
        return Err(
            matrix.wrong("begins with 0: ROS says with it that the camera is not calibrated")
        );
    }
    let name = root.get("camera_name").and_then(|name| name.text());
    let camera = Camera {
        width,
        height,
        intrinsics: intrinsics(&matrix, &k)?,
        lens: lens(root)?,
    };
    Ok(Cameras {
        cameras: vec![NamedCamera::new(name.unwrap_or("camera"), camera)],
        ..Cameras::default()
    })
}

/// Refuses a region of interest and binned pixels, for which K of the file is not that of the
/// images.
fn check_whole(root: &Field) -> Result<()> {
    for key in ["binning_x", "binning_y"] {
        if let Some(field) = root
            .get(key)
            .filter(|field| field.number().is_ok_and(|n| n > 1.0))
        {
            return Err(field.unsupported("is above 1: K is that of images without binning"));
        }
    }
    let Some(roi) = root.get("roi") else {
        return Ok(());
    };
    for key in ["x_offset", "y_offset"] {
        if let Some(field) = roi
            .get(key)
            .filter(|field| field.number().is_ok_and(|n| n != 0.0))
        {
            return Err(field.unsupported("is not 0: K is that of the whole sensor"));
        }
    }
    Ok(())
}

fn lens(root: &Field) -> Result<Lens> {
    let model = root.need(
        "distortion_model",
        "plumb_bob, rational_polynomial or equidistant",
    )?;
    let Some(field) = root.any(&COEFFICIENTS) else {
        return Ok(Lens::NONE);
    };
    let numbers = field.numbers()?;
    if numbers.is_empty() {
        return Ok(Lens::NONE);
    }
    match model.text().unwrap_or_default() {
        "plumb_bob" | "rational_polynomial" | "thin_prism" | "radtan" => {
            opencv_lens(&field, &numbers)
        }
        "equidistant" | "fisheye" => fisheye(&field, &numbers),
        other => Err(model.unsupported(&format!(
            "\"{other:.40}\" is not supported: plumb_bob, rational_polynomial and equidistant are"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{CameraFormat, read_cameras};
    use crate::{Error, Result};
    use epipole::camera::{Camera, LensKind};

    fn one(text: &str) -> Result<Camera> {
        let (format, cameras) = read_cameras(text.as_bytes(), None)?;
        assert_eq!(format, CameraFormat::Ros);
        Ok(cameras.cameras[0].camera)
    }

    /// From the documentation of `camera_calibration`, shortened.
    const FILE: &str = "image_width: 640
image_height: 480
camera_name: narrow_stereo/left
camera_matrix:
  rows: 3
  cols: 3
  data: [414.3, 0, 304.8, 0, 414.1, 240.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.009, -0.22, 0.002, 0.001, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [414, 0, 304, 0, 0, 414, 240, 0, 0, 0, 1, 0]
";
    /// As `rostopic echo` prints it.
    const MESSAGE: &str = "header: \n  seq: 1\nheight: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\n\
        D: [0.009, -0.22, 0.002, 0.001, 0.0]\nK: [414.3, 0.0, 304.8, 0.0, 414.1, 240.5, 0.0, 0.0, 1.0]\n\
        R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\nbinning_x: 0\n---\n";

    #[test]
    fn file_and_message_are_one_camera() {
        assert_eq!(one(FILE).unwrap(), one(MESSAGE).unwrap());
        let (_, cameras) = read_cameras(FILE.as_bytes(), None).unwrap();
        assert_eq!(cameras.cameras[0].name, "narrow_stereo/left");
        for (model, data, kind) in [
            (
                "rational_polynomial",
                "1, 2, 3, 4, 5, 6, 7, 8",
                LensKind::Rational,
            ),
            ("equidistant", "1, 2, 3, 4", LensKind::Fisheye),
            ("plumb_bob", "", LensKind::Brown),
        ] {
            let text = FILE
                .replace("plumb_bob", model)
                .replace("0.009, -0.22, 0.002, 0.001, 0]", &format!("{data}]"));
            assert_eq!(one(&text).unwrap().lens.kind(), kind);
        }
        let error = one(&FILE.replace("plumb_bob", "omni")).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }));
        let message = "distortion_model \"omni\" is not supported: plumb_bob, rational_polynomial and equidistant are";
        assert_eq!(error.to_string(), message);
        let of = |from: &str, to: &str| one(&MESSAGE.replace(from, to)).unwrap_err().to_string();
        let zeros = of(
            "414.3, 0.0, 304.8, 0.0, 414.1, 240.5, 0.0, 0.0, 1.0",
            "0, 0, 0, 0, 0, 0, 0, 0, 1",
        );
        assert!(zeros.contains("K begins with 0: ROS says"), "{zeros}");
        assert!(of("binning_x: 0", "binning_x: 2").contains("binning_x is above 1"));
        let roi = of("binning_x: 0", "roi:\n  x_offset: 8\n  y_offset: 0");
        assert!(roi.contains("roi.x_offset is not 0"), "{roi}");
    }
}
