//! `epipole rectify` where the rig is calibrated: nothing is looked for in the photographs.

use super::{Arguments, Found};
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::tell_of_unseen;
use crate::lens;
use crate::photo::{Photo, SizeArguments, check_same_size};
use epipole::camera::Camera;
use epipole::stereo::rectify_calibrated;
use std::path::Path;

/// The two photographs and how they are rectified.
///
/// # Errors
/// A sentence for files that cannot be read or are not of this rig; as the core's rectification.
pub(super) fn rectify(
    arguments: &Arguments,
    context: &Context,
    file: &Path,
) -> Result<([Photo; 2], Found), Failure> {
    let (cameras, right_from_left) = lens::read_rig(file)?;
    let [left, right] = &cameras;
    let photos = [
        photograph(&arguments.first, left, "left", context)?,
        photograph(&arguments.second, right, "right", context)?,
    ];
    check_same_size(&photos)?;
    let options = arguments.shape();
    let rectification = rectify_calibrated(&cameras, &right_from_left, &options)?;
    let found = Found {
        homographies: rectification.homographies,
        maps: [rectification.map(0)?, rectification.map(1)?],
        q: Some(rectification.q),
        num_inliers: None,
    };
    Ok((photos, found))
}

/// A photograph by one side of the rig, as its sensor gave it: turned upright it would be by a camera that stands otherwise.
fn photograph(
    path: &Path,
    camera: &Camera,
    side: &str,
    context: &Context,
) -> Result<Photo, Failure> {
    tell_of_unseen(camera, context)?;
    let photo = Photo::by_camera(path, SizeArguments::default(), camera)?;
    let (width, height) = photo.sensor_size;
    let why = match photo.lens {
        Some(kept) if kept.quarters == 0 => return Ok(photo),
        Some(_) => "this photograph is turned upright by its file".to_owned(),
        None => format!("this photograph is {width} × {height}"),
    };
    let message = format!(
        "the {side} camera of --rig was calibrated for {} × {} as the sensor gives them, but {why}",
        camera.width, camera.height
    );
    Err(Failure::new("size-mismatch", message).about(path))
}
