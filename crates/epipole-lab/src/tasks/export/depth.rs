//! Depth for other programs: a depth image for each pair, and all points in one cloud.

use super::contents::Export;
use super::frame::{file_from_world, moved};
use crate::tasks::archive::Archive;
use crate::tasks::camera_found::CameraFound;
use crate::tasks::dense::Dense;
use epipole::stereo::{DisparityImage, PointCloud};
use epipole_io::cloud::write_ply;
use epipole_io::disparity::write_pfm;
use image::{DynamicImage, ImageFormat, RgbImage};
use serde_json::{Value, json};
use std::io::Cursor;

/// Adds `depth/<pair>.pfm` and `.png` for each pair, and `dense.ply`, if there is any.
///
/// # Errors
/// A message, if the data of a pair are incomplete or a file cannot be written.
pub(super) fn add(archive: &mut Archive, export: &Export) -> Result<(), String> {
    if export.dense.is_empty() {
        return Ok(());
    }
    let scale = export.meters_per_unit.unwrap_or(1.0);
    let frame = file_from_world(export);
    let mut cloud = PointCloud::default();
    for (name, pair) in &export.dense {
        let broken = || format!("the depth of {name} did not arrive whole");
        if !pair.is_whole() {
            return Err(broken());
        }
        let pixels = (0..pair.height).flat_map(|v| (0..pair.width).map(move |u| (u, v)));
        let depths = pixels.map(|(u, v)| pair.depth(u, v).map_or(f32::NAN, |z| (z * scale) as f32));
        // The format holds any number per pixel.
        let depths = DisparityImage::from_raw(pair.width, pair.height, depths.collect())
            .map_err(|_| broken())?;
        archive.add(&format!("depth/{name}.pfm"), &write_pfm(&depths))?;
        let picture =
            RgbImage::from_raw(pair.width, pair.height, pair.left.to_vec()).ok_or_else(broken)?;
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::from(picture)
            .write_to(&mut bytes, ImageFormat::Png)
            .map_err(|error| error.to_string())?;
        archive.add(&format!("depth/{name}.png"), bytes.get_ref())?;
        for (place, color) in pair.points(1) {
            cloud.points.push(frame * nalgebra::Point3::from(place));
            cloud.colors.push(color);
        }
    }
    archive.add("dense.ply", &write_ply(&cloud))
}

/// Returns the entries of `reconstruction.json` for the pairs: files, and camera of the depth
/// image.
pub(super) fn json(export: &Export) -> Vec<Value> {
    let frame = file_from_world(export);
    let one = |(name, pair): &(String, Dense)| {
        let CameraFound {
            intrinsics,
            rotation,
            translation,
        } = moved(&pair.camera, &frame);
        json!({
            "depth": format!("depth/{name}.pfm"),
            "picture": format!("depth/{name}.png"),
            "intrinsics": intrinsics,
            "cam_from_world": {
                "quaternion_xyzw": rotation,
                "translation": translation,
            },
            "share_with_depth": pair.density,
        })
    };
    export.dense.iter().map(one).collect()
}
