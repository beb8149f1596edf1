//! COLMAP's lists of cameras: `cameras.txt` and `cameras.bin`.
//!
//! Source: COLMAP's documentation, "Output format".

use super::models::{camera_from_colmap, colmap_from_camera, model_of_id};
use super::words::{Words, content};
use crate::bytes::{Bytes, extend};
use crate::error::{Listed, set_aside};
use crate::{Error, Result};
use epipole::camera::Camera;
use std::fmt::Write;

/// A camera with its ID, or the reason why it is not supported.
pub(crate) type ListedCamera = (u32, Listed<Camera>);

/// Reads `cameras.txt`.
///
/// # Errors
/// [`Error::Malformed`] with the line.
pub(crate) fn read_cameras_text(text: &str) -> Result<Vec<ListedCamera>> {
    let mut cameras = Vec::new();
    for (line, content) in content(text) {
        let mut words = Words::new(line, content);
        let id = words.whole("the camera ID")?;
        let name = words.word("the camera model")?;
        let [width, height] = [words.whole("the width")?, words.whole("the height")?];
        let camera = camera_from_colmap(name, width, height, &words.rest()?);
        let camera = set_aside(camera).map_err(|error| error.on_line(line))?;
        cameras.push((id, camera));
    }
    Ok(cameras)
}

/// Writes `cameras.txt`.
///
/// * `cameras`: with their IDs
pub(crate) fn write_cameras_text(cameras: &[(u32, Camera)]) -> String {
    // Writing to a string cannot fail.
    let mut text = String::from("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
    for (id, camera) in cameras {
        let Camera { width, height, .. } = camera;
        let model = colmap_from_camera(camera);
        let _ = write!(text, "{id} {} {width} {height}", model.name);
        for param in &model.params {
            let _ = write!(text, " {param}");
        }
        text.push('\n');
    }
    text
}

/// Reads `cameras.bin`.
///
/// # Errors
/// [`Error::Malformed`] with the position, [`Error::Unsupported`] for an unknown model, whose
/// length is unknown too.
pub(crate) fn read_cameras_binary(bytes: &[u8]) -> Result<Vec<ListedCamera>> {
    let mut bytes = Bytes::new(bytes);
    let mut cameras = Vec::new();
    for _ in 0..bytes.count("cameras", 24)? {
        let id = bytes.u32()?;
        let (name, num_params) = model_of_id(bytes.i32()?)?;
        let [width, height] = [bytes.u64()?, bytes.u64()?];
        let params = (0..num_params).map(|_| bytes.f64());
        let params = params.collect::<Result<Vec<f64>>>()?;
        let camera = camera_from_colmap(name, width, height, &params);
        let named = |error| Error::malformed(format!("camera {id}: {error}"));
        cameras.push((id, set_aside(camera).map_err(named)?));
    }
    bytes.end()?;
    Ok(cameras)
}

/// Writes `cameras.bin`.
///
/// * `cameras`: with their IDs
pub(crate) fn write_cameras_binary(cameras: &[(u32, Camera)]) -> Vec<u8> {
    let mut bytes = (cameras.len() as u64).to_le_bytes().to_vec();
    for (id, camera) in cameras {
        let model = colmap_from_camera(camera);
        bytes.extend(id.to_le_bytes());
        bytes.extend(model.id.to_le_bytes());
        bytes.extend(u64::from(camera.width).to_le_bytes());
        bytes.extend(u64::from(camera.height).to_le_bytes());
        extend(&mut bytes, &model.params);
    }
    bytes
}
