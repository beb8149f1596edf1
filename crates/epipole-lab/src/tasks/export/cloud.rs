//! The depth of all views for other programs: one cloud with normals.

use super::contents::Export;
use super::frame::file_from_world;
use crate::tasks::archive::Archive;
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use nalgebra::{Point3, Vector3};

/// Adds `fused.ply`, if there is depth of all views.
///
/// # Errors
/// A sentence, if the file cannot be written.
pub(super) fn add(archive: &mut Archive, export: &Export) -> Result<(), String> {
    let Some(all_views) = &export.all_views else {
        return Ok(());
    };
    let frame = file_from_world(export);
    let mut cloud = PointCloud::default();
    for point in all_views.points(1) {
        cloud.points.push(frame * Point3::from(point.position));
        cloud
            .normals
            .push(frame.isometry.rotation * Vector3::from(point.normal));
        cloud.colors.push(point.color);
        cloud.confidences.push(f32::from(point.num_views));
    }
    archive.add("fused.ply", &write_ply(&cloud))
}
