//! `epipole inspect`: content, conventions and oddities of a file or folder.

mod other;

use crate::content::Content;
use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::report::Report;
use clap::Args;
use epipole::camera::Camera;
use epipole_io::camera::{CameraFormat, Cameras, is_camera_file, read_cameras};
use epipole_io::model::{ReadModel, format_of_file};
use epipole_io::trajectory::{Trajectory, is_trajectory};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Describe the content of a file or a model folder.
#[derive(Debug, Args)]
#[command(after_help = "Example: epipole inspect reconstruction/sparse/0\n\n\
    Reads the models of COLMAP (text, binary), Bundler, nerfstudio (transforms.json), openMVG (sfm_data.json) and\n\
    PLY files; cameras of any format that --camera takes; trajectories of TUM, KITTI and EuRoC; photographs, PFM\n\
    files, g2o, BAL, tables of points and matches.\n\n\
    JSON: kind (the format), counts, notes. For a model also convention (frames and pixels of the file),\n\
    mean_reprojection_px (null without observations), cameras (lens, k and distortion of each; width and height,\n\
    null if not in the file), notes (omissions and oddities: names with blanks, images without points, points\n\
    behind cameras, NaN). For cameras: convention, cameras, right_from_left (translation of a rig, or null). For a\n\
    trajectory: length, seconds (or null).")]
pub(crate) struct Arguments {
    /// File, or folder of a model.
    input: PathBuf,
}

pub(crate) fn run(arguments: &Arguments, _: &Context) -> Result<Report, Failure> {
    let path = &arguments.input;
    let content = if path.is_dir() {
        Content::read(path)?
    } else {
        let bytes = files::read_bytes(path)?;
        if let Some(described) = other::by_first_bytes(path, &bytes) {
            return described;
        }
        let is_named =
            format_of_file(&bytes).is_some() || is_camera_file(&bytes) || is_trajectory(&bytes);
        match Content::of_bytes(path, &bytes) {
            Err(failure) if !is_named => return other::table(&bytes).ok_or(failure),
            Err(_) if is_camera_file(&bytes) && format_of_file(&bytes).is_none() => {
                without_size(&bytes).map_err(|error| Failure::from(error).about(path))?
            }
            content => content?,
        }
    };
    let report = (Report::default())
        .field("kind", content.format())
        .row("kind", content.format());
    match &content {
        Content::Model(read) => of_model(report, read),
        Content::Cameras(format, cameras) => Ok(of_cameras(report, *format, cameras)),
        Content::Trajectory(_, trajectory) => Ok(of_trajectory(report, trajectory)),
    }
}

/// Reads the cameras of a file without the image size.
///
/// # Errors
/// For other faults of the file.
fn without_size(bytes: &[u8]) -> epipole_io::Result<Content> {
    let (format, mut cameras) = read_cameras(bytes, Some((0, 0)))?;
    let note = "the file has no image size: --camera takes that of the image";
    cameras.notes.push(note.to_owned());
    Ok(Content::Cameras(format, cameras))
}

fn of_model(report: Report, read: &ReadModel) -> Result<Report, Failure> {
    let (model, format) = (&read.model, read.format);
    let mut notes = read.notes.clone();
    notes.extend(model.oddities()?);
    let keypoints: usize = model.images.iter().map(|image| image.keypoints.len()).sum();
    let observations = model.num_observations();
    let mean_px = model.mean_reprojection_px()?;
    let cameras: Vec<Value> = model.cameras.iter().map(of_camera).collect();
    let mut report = report
        .field("convention", format.convention())
        .field(
            "counts",
            json!({
                "cameras": model.cameras.len(), "images": model.images.len(),
                "keypoints": keypoints, "points": model.points.len(),
                "observations": observations, "rigs": model.rigs.len(),
            }),
        )
        .field("mean_reprojection_px", mean_px)
        .field("cameras", cameras)
        .field("notes", &notes)
        .row("convention", format.convention())
        .row("cameras", model.cameras.len())
        .row("images", model.images.len())
        .row("keypoints", keypoints)
        .row("points", model.points.len())
        .row("observations", observations);
    if !model.rigs.is_empty() {
        report = report.row("rigs", model.rigs.len());
    }
    if let Some(mean_px) = mean_px {
        report = report.row("mean reprojection error", format!("{mean_px:.3} px"));
    }
    for note in &notes {
        report = report.row("note", note);
    }
    Ok(report)
}

fn of_camera(camera: &Camera) -> Value {
    let (k, center) = (&camera.intrinsics, camera.intrinsics.principal_point());
    let known = |side: u32| (side > 0).then_some(side);
    json!({
        "width": known(camera.width), "height": known(camera.height),
        "k": [k.fu_px(), k.fv_px(), center.x, center.y],
        "lens": camera.lens.kind().name(), "distortion": camera.lens.coefficients(),
    })
}

fn of_cameras(report: Report, format: CameraFormat, cameras: &Cameras) -> Report {
    let each = cameras.cameras.iter().map(|named| {
        let mut fields = of_camera(&named.camera);
        fields["name"] = json!(named.name);
        fields
    });
    let translation = cameras
        .right_from_left
        .map(|motion| motion.translation.vector);
    let mut report = report
        .row("convention", format.convention())
        .field("convention", format.convention())
        .field("counts", json!({ "cameras": cameras.cameras.len() }))
        .field("cameras", each.collect::<Vec<_>>())
        .field("notes", &cameras.notes)
        .field("right_from_left", translation.map(|t| [t.x, t.y, t.z]));
    for named in &cameras.cameras {
        let (camera, k) = (&named.camera, &named.camera.intrinsics);
        let size = match camera.width {
            0 => "size unknown".to_owned(),
            width => format!("{width} × {}", camera.height),
        };
        let words = format!(
            "{size}, focal lengths {:.2} and {:.2} px, principal point ({:.2}, {:.2}), {}",
            k.fu_px(),
            k.fv_px(),
            k.principal_point().x,
            k.principal_point().y,
            lens(camera),
        );
        report = report.row(&named.name, words);
    }
    for note in &cameras.notes {
        report = report.row("note", note);
    }
    match translation {
        Some(t) => report.row(
            "baseline",
            format!("{:.6}, in the unit of the file", t.norm()),
        ),
        None => report,
    }
}

/// Describes the kind and the coefficients of a lens.
fn lens(camera: &Camera) -> String {
    if camera.is_pinhole() {
        return "no distortion".to_owned();
    }
    let numbers = camera.lens.coefficients().into_iter();
    let numbers: Vec<String> = numbers.map(|number| number.to_string()).collect();
    format!("{} lens {}", camera.lens.kind().name(), numbers.join(", "))
}

fn of_trajectory(report: Report, trajectory: &Trajectory) -> Report {
    let poses = &trajectory.world_from_cam;
    let step = |pair: &[epipole::camera::RigidTransform]| {
        (pair[1].translation.vector - pair[0].translation.vector).norm()
    };
    let length: f64 = poses.windows(2).map(step).sum();
    let stamps = trajectory.stamps_ns.as_deref().unwrap_or_default();
    let seconds = (stamps.first().zip(stamps.last()))
        .map(|(first, last)| last.saturating_sub(*first) as f64 * 1e-9);
    let mut report = report
        .field("counts", json!({ "poses": poses.len() }))
        .field("length", length)
        .field("seconds", seconds)
        .field("notes", &trajectory.notes)
        .row("poses", poses.len())
        .row("length", format!("{length:.3}, in the unit of the file"));
    for note in &trajectory.notes {
        report = report.row("note", note);
    }
    match seconds {
        Some(seconds) => report.row("time", format!("{seconds:.3} s")),
        None => report,
    }
}
