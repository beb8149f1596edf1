//! Summary of a reconstruction: the JSON of the command line with all measures, and a readme.

use super::contents::Export;
use super::table;
use epipole::camera::RigidTransform;
use epipole::sfm::{Reconstruction, SfmImage};
use serde_json::{Value, json};

/// Returns the object that `epipole sfm --json` prints, without its duration.
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
    let place = export.component as usize;
    let summary = json!({
        "focal_refined": export.focal_refined,
        "focal_determined": export.found.determines_focal.get(place).filter(|_| export.focal_refined),
        "lens_refined": export.found.before_correction_px.get(place).is_some_and(Option::is_some),
        "num_registered": model.num_registered(),
        "num_images": images.len(),
        "num_points": model.points.len(),
        "mean_reprojection_px": export.found.mean_error_px.get(place),
        "images": registered,
        "unregistered": left_out,
        "components": components,
        "complete": true,
        "meters_per_unit": export.meters_per_unit,
        "z_is_up": export.floor.is_some(),
        "measures": table::lengths(export),
        "shapes": table::shapes(export),
        "control_points": table::control_points(export),
        "depth": super::depth::json(export),
    });
    summary.to_string()
}

/// Describes the files, and the command that makes them.
pub(super) fn readme(export: &Export) -> String {
    let unit = match (export.meters_per_unit, &export.unit_of) {
        _ if export.measures.aligned.is_some() => {
            "Coordinates are those of the control points, in meters.".to_owned()
        }
        (Some(_), _) => "Lengths are in meters, by the length that was measured.".to_owned(),
        (None, Some(file)) => {
            format!("The unit of length is that of {file}: nothing was measured.")
        }
        (None, None) => "The unit of length is arbitrary: nothing was measured.".to_owned(),
    };
    let mut text =
        String::from("images/              the photographs, as they were reconstructed\n");
    let (place, programs) = (export.format.place(), export.format.programs());
    text.push_str(&format!("{place:<20} cameras and points for {programs}\n"));
    text.push_str(
        "model.html           a page that shows them in any browser\n\
         points.ply           the points with their colors\n\
         trajectory.txt       the poses in the order of the photographs, as KITTI has them\n\
         trajectory.tum       the same with times, as TUM has them, if photographs are named by their times\n\
         reconstruction.json  what `epipole sfm --json` prints\n",
    );
    if export.recipe.program.is_some() {
        text.push_str("reconstruct.rs       a program that does the same\n");
    }
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
    if let Some(all_views) = &export.all_views {
        text.push_str(
            "fused.ply            the depth of all views as points with normals, colors, and the number of \
             photographs that agree as confidence, in the frame of points.ply\n",
        );
        if all_views.triangles().len() > 0 {
            let name = export.format.mesh();
            let colors = match export.format.has_texture() {
                true => "a texture of the photographs",
                false => "colors",
            };
            text.push_str(&format!(
                "{name:<20} their surface: triangles with normals and {colors}, in the same frame\n"
            ));
        }
    }
    if !export.measures.is_empty() {
        text.push_str(
            "measures.csv         all measures and their points, in the frame of points.ply\n",
        );
    }
    text.push_str("report.pdf           the measures on one page, with pictures\n");
    let up = match export.floor {
        Some(_) => " z points up from the floor.",
        None => "",
    };
    text.push_str(&format!("\n{unit}{up}\n"));
    let program = match export.recipe.program {
        Some(_) => "and by the program in reconstruct.rs. ",
        None => "",
    };
    text.push_str(&format!(
        "\nThe same on the command line\n\n    {}\n\n{}{}\n",
        export.recipe.command, program, export.recipe.photographs
    ));
    text
}
