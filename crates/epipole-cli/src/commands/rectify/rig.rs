//! Photos of a calibrated stereo rig, for `epipole rectify`.

use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::check_visible_part;
use crate::lens;
use crate::photo::{Photo, check_same_size};
use crate::reading::ReadArguments;
use epipole::camera::{Camera, RigidTransform};
use std::path::Path;

/// Reads the two photos, their cameras, and the pose of the right camera.
///
/// # Errors
/// For files that cannot be read or are not of this rig.
pub(super) fn read(
    file: &Path,
    paths: [&Path; 2],
    reading: ReadArguments,
    context: &Context,
) -> Result<([Photo; 2], [Camera; 2], RigidTransform), Failure> {
    let (cameras, right_from_left) = lens::read_rig(file, Some(paths[0]))?;
    let [left, right] = &cameras;
    let photos = [
        photo_of_side(paths[0], left, "left", reading, context)?,
        photo_of_side(paths[1], right, "right", reading, context)?,
    ];
    check_same_size(&photos)?;
    Ok((photos, cameras, right_from_left))
}

/// Reads a photo of one side of the rig. Refuses one that was rotated upright, because the pose of
/// its camera would differ.
fn photo_of_side(
    path: &Path,
    camera: &Camera,
    side: &str,
    reading: ReadArguments,
    context: &Context,
) -> Result<Photo, Failure> {
    check_visible_part(camera, context)?;
    let photo = Photo::by_camera(path, reading, camera, context)?;
    let (width, height) = photo.sensor_size;
    let why = match photo.lens {
        Some(lens) if lens.quarters == 0 => return Ok(photo),
        Some(_) => "this image is rotated upright by its file".to_owned(),
        None => format!("this image is {width} × {height}"),
    };
    let message = format!(
        "the {side} camera of --rig was calibrated for {} × {} as the sensor gives them, but {why}",
        camera.width, camera.height
    );
    Err(Failure::new("size-mismatch", message).about(path))
}
