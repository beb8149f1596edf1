//! A reconstruction in words and numbers: the command line's JSON, and the command that does the
//! same.

use super::contents::Export;
use epipole::camera::RigidTransform;
use epipole::sfm::{Reconstruction, SfmImage};
use serde_json::{Value, json};

/// The object that `epipole sfm --json` prints, without its time.
pub(super) fn json(export: &Export, images: &[SfmImage], model: &Reconstruction) -> String {
    let motion = |transform: &RigidTransform| {
        let rotation = transform.rotation.to_rotation_matrix();
        json!({
            "rotation": rotation.matrix().transpose().as_slice(),
            "translation": transform.translation.vector.as_slice(),
        })
    };
    let registered: Vec<Value> = (images.iter().zip(&model.cameras))
        .filter_map(|(image, camera)| {
            let camera = camera.as_ref()?;
            Some(json!({
                "name": image.name,
                "focal_px": camera.camera.intrinsics.fu_px(),
                "lens": camera.camera.lens.kind().name(),
                "distortion": camera.camera.lens.coefficients(),
                "cam_from_world": motion(&camera.cam_from_world),
            }))
        })
        .collect();
    let components: Vec<Value> = (export.found.components.iter())
        .map(|c| json!({ "num_registered": c.num_registered(), "num_points": c.points.len() }))
        .collect();
    let left_out: Vec<Value> = (export.left_out.iter())
        .map(|(name, reason)| json!({ "name": name, "reason": reason }))
        .collect();
    let errors: f64 = (model.points.iter())
        .map(|p| p.error_px * p.track.len() as f64)
        .sum();
    let summary = json!({
        "focal_refined": export.focal_refined,
        "num_registered": model.num_registered(),
        "num_images": images.len(),
        "num_points": model.points.len(),
        "mean_reprojection_px": errors / model.num_observations().max(1) as f64,
        "images": registered,
        "unregistered": left_out,
        "components": components,
        "complete": true,
        "meters_per_unit": export.meters_per_unit,
        "depth": super::depth::json(export),
    });
    summary.to_string()
}

/// Description of the files, and the command line that makes them.
pub(super) fn readme(export: &Export) -> String {
    let unit = match export.meters_per_unit {
        Some(_) => "Lengths are in meters, by the length that was measured.",
        None => "The unit of length is arbitrary: nothing was measured.",
    };
    let mut text = String::from(
        "images/              the photographs, as they were reconstructed\n\
         sparse/0/            COLMAP's text model: `colmap gui`, or the import of another program, opens it\n\
         points.ply           the points with their colors\n\
         reconstruction.json  what `epipole sfm --json` prints\n\
         reconstruct.rs       a program that does the same\n",
    );
    if export.recipe.camera_json.is_some() {
        text.push_str("camera.json          the calibrated camera, which removed the distortion from the photographs\n");
    }
    if !export.dense.is_empty() {
        text.push_str(
            "depth/               the depth of every pixel of a rectified photograph, along its camera's axis; the \
             photograph as PNG, and its camera in reconstruction.json\n\
             dense.ply            all of these pixels as points with their colors, in the frame of points.ply\n",
        );
    }
    text.push_str(&format!("\n{unit}\n"));
    text.push_str(&format!(
        "\nThe same on the command line\n\n    {}\n\nand by the program in reconstruct.rs. {}\n",
        export.recipe.command, export.recipe.photographs
    ));
    text
}
