//! `epipole inspect`: contents, conventions and oddities of a model.

use crate::context::Context;
use crate::failure::Failure;
use crate::model;
use crate::report::Report;
use clap::Args;
use serde_json::json;
use std::path::PathBuf;

/// Tell what a model is, what it holds and what is odd about it.
#[derive(Debug, Args)]
#[command(after_help = "Example: epipole inspect reconstruction/sparse/0\n\n\
    Reads the models of COLMAP (text, binary), Bundler, nerfstudio (transforms.json), openMVG (sfm_data.json) and\n\
    PLY files.\n\n\
    JSON: kind (colmap-text, colmap-binary, bundler, transforms, openmvg or ply), convention (frames and pixels of\n\
    the file), counts (cameras, images, keypoints, points, observations), mean_reprojection_px (null without\n\
    observations), cameras (width, height, lens, k and distortion of each), notes (what was left out or is odd:\n\
    names with blanks, images without points, points behind cameras, NaN).")]
pub(crate) struct Arguments {
    /// A file, or a folder with a model.
    input: PathBuf,
}

pub(crate) fn run(arguments: &Arguments, _: &Context) -> Result<Report, Failure> {
    let read = model::read(&arguments.input)?;
    let (model, format) = (read.model, read.format);
    let mut notes = read.notes;
    notes.extend(model.oddities()?);
    let keypoints: usize = model.images.iter().map(|image| image.keypoints.len()).sum();
    let observations = model.num_observations();
    let mean_px = model.mean_reprojection_px()?;
    let cameras = model.cameras.iter().map(|camera| {
        let (k, center) = (&camera.intrinsics, camera.intrinsics.principal_point());
        json!({
            "width": camera.width, "height": camera.height,
            "k": [k.fu_px(), k.fv_px(), center.x, center.y],
            "lens": camera.lens.kind().name(), "distortion": camera.lens.coefficients(),
        })
    });
    let mut report = Report::default()
        .field("kind", format.name())
        .field("convention", format.convention())
        .field(
            "counts",
            json!({
                "cameras": model.cameras.len(), "images": model.images.len(),
                "keypoints": keypoints, "points": model.points.len(),
                "observations": observations,
            }),
        )
        .field("mean_reprojection_px", mean_px)
        .field("cameras", cameras.collect::<Vec<_>>())
        .field("notes", &notes)
        .row("kind", format.name())
        .row("convention", format.convention())
        .row("cameras", model.cameras.len())
        .row("images", model.images.len())
        .row("keypoints", keypoints)
        .row("points", model.points.len())
        .row("observations", observations);
    if let Some(mean_px) = mean_px {
        report = report.row("mean reprojection error", format!("{mean_px:.3} px"));
    }
    for note in &notes {
        report = report.row("note", note);
    }
    Ok(report)
}
