//! Cameras as YAML of OpenCV's `FileStorage`: the keys of OpenCV's samples, see
//! [`opencv`](super::opencv).

use super::named::Cameras;
use super::yaml_number::numbers;
use crate::{Error, Result};
use epipole::camera::{Camera, LensKind};
use std::fmt::Write;

/// Writes one camera, or two with or without their motion.
pub(super) fn write(cameras: &Cameras) -> Result<String> {
    let all: Vec<&Camera> = cameras.cameras.iter().map(|named| &named.camera).collect();
    let size = (all[0].width, all[0].height);
    if all.len() > 2
        || all
            .iter()
            .any(|camera| (camera.width, camera.height) != size)
    {
        return Err(Error::unsupported(format!(
            "OpenCV's file holds one camera or a rig of two of one size, not these {} cameras",
            all.len()
        )));
    }
    if let Some(camera) = all.iter().find(|c| c.lens.kind() == LensKind::Division) {
        return Err(Error::unsupported(format!(
            "OpenCV has no lens of the model {}: brown, rational and fisheye are written",
            camera.lens.kind().name()
        )));
    }
    let is_fisheye = |camera: &&Camera| camera.lens.kind() == LensKind::Fisheye;
    let num_fisheyes = all.iter().filter(|camera| is_fisheye(camera)).count();
    if num_fisheyes != 0 && num_fisheyes != all.len() {
        return Err(Error::unsupported(
            "OpenCV has no rig of a fisheye and another lens",
        ));
    }
    // Writing to a string cannot fail.
    let mut text = String::from("%YAML:1.0\n---\n");
    let _ = writeln!(text, "image_width: {}\nimage_height: {}", size.0, size.1);
    let _ = writeln!(text, "fisheye_model: {}", u8::from(num_fisheyes > 0));
    let keys: &[[&str; 2]] = match all.len() {
        1 => &[["camera_matrix", "distortion_coefficients"]],
        _ => &[["M1", "D1"], ["M2", "D2"]],
    };
    for (camera, [k, d]) in all.iter().zip(keys) {
        matrix(
            &mut text,
            k,
            3,
            camera.intrinsics.matrix().transpose().as_slice(),
        );
        matrix(&mut text, d, 1, &camera.lens.coefficients());
    }
    if let (Some(motion), 2) = (&cameras.right_from_left, all.len()) {
        let rotation = motion.rotation.to_rotation_matrix();
        matrix(&mut text, "R", 3, rotation.matrix().transpose().as_slice());
        matrix(&mut text, "T", 3, motion.translation.vector.as_slice());
    }
    Ok(text)
}

fn matrix(text: &mut String, key: &str, rows: usize, values: &[f64]) {
    let columns = values.len() / rows;
    let _ = write!(
        text,
        "{key}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data: [ {} ]\n",
        numbers(values)
    );
}
