//! A camera as the YAML of ROS, see [`ros`](super::ros).

use super::named::Cameras;
use super::yaml_number::numbers;
use crate::{Error, Result};
use epipole::camera::{Camera, LensKind};
use std::fmt::Write;

/// Writes one camera, without rectification.
pub(super) fn write(cameras: &Cameras) -> Result<String> {
    let [named] = &cameras.cameras[..] else {
        return Err(Error::unsupported(format!(
            "a file of ROS holds one camera, not {}",
            cameras.cameras.len()
        )));
    };
    let camera: &Camera = &named.camera;
    let model = match camera.lens.kind() {
        LensKind::Brown => "plumb_bob",
        LensKind::Rational => "rational_polynomial",
        LensKind::Fisheye => "equidistant",
        LensKind::Division => {
            return Err(Error::unsupported(
                "ROS has no lens of the model division: brown, rational and fisheye are written",
            ));
        }
    };
    let k = camera.intrinsics.matrix();
    let projection = k.insert_column(3, 0.0);
    let name = serde_json::Value::from(named.name.as_str());
    // Writing to a string cannot fail.
    let mut text = String::new();
    let _ = writeln!(
        text,
        "image_width: {}\nimage_height: {}\ncamera_name: {name}",
        camera.width, camera.height
    );
    matrix(&mut text, "camera_matrix", 3, k.transpose().as_slice());
    let _ = writeln!(text, "distortion_model: {model}");
    matrix(
        &mut text,
        "distortion_coefficients",
        1,
        &camera.lens.coefficients(),
    );
    let identity = nalgebra::Matrix3::<f64>::identity();
    matrix(&mut text, "rectification_matrix", 3, identity.as_slice());
    matrix(
        &mut text,
        "projection_matrix",
        3,
        projection.transpose().as_slice(),
    );
    Ok(text)
}

fn matrix(text: &mut String, key: &str, rows: usize, values: &[f64]) {
    let columns = values.len() / rows;
    let _ = write!(
        text,
        "{key}:\n  rows: {rows}\n  cols: {columns}\n  data: [{}]\n",
        numbers(values)
    );
}
