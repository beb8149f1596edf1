//! `epipole convert`: a model, cameras or a trajectory in another format.

mod target;
mod write;

use self::target::{Format, Target};
use self::write::{write_file, write_folder};
use crate::content::Content;
use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::report::Report;
use clap::Args;
use epipole::camera::Camera;
use epipole_io::camera::{CameraFormat, Cameras, NamedCamera, write_cameras};
use epipole_io::model::{ModelFile, ModelFormat, ReadModel};
use epipole_io::trajectory::{Trajectory, write_trajectory};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Convert a model, cameras or a trajectory between formats.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole convert reconstruction/ model/ --to colmap-binary\n\n\
    A may be a model of COLMAP (text, binary), Bundler, nerfstudio (transforms.json), openMVG (sfm_data.json) or\n\
    a PLY file; cameras of any format that --camera takes; or a trajectory (TUM, KITTI, EuRoC). B names the\n\
    format: model.html (a page to rotate and measure it), model.glb, points.ply, transforms.json, sfm_data.json,\n\
    bundle.out; cameras.yml (OpenCV), camera.json, cameras.txt; path.txt (TUM, or KITTI if A is KITTI), path.csv\n\
    (EuRoC). A folder is a COLMAP model, binary unless A is binary. Files of an earlier conversion to the same\n\
    format are removed, others stay.\n\n\
    A model can also be converted to cameras or to a trajectory: the poses of its images in order,\n\
    with times if the images are named by them.\n\n\
    COLMAP cuts names at their first blank in text files, not in binary files.\n\n\
    JSON: read (format of A), written (files), kind (format of B), counts (cameras, images, points; poses of a\n\
    trajectory), notes (what was left out)."
)]
pub(crate) struct Arguments {
    /// File or folder to read.
    #[arg(value_name = "A")]
    input: PathBuf,
    /// File or folder to write.
    #[arg(value_name = "B")]
    output: PathBuf,
    /// Format to write [default: from the name of B].
    #[arg(long, value_name = "FORMAT")]
    to: Option<Format>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let content = Content::read(&arguments.input)?;
    let by_name = Target::of_name(&arguments.output, &content);
    let target = match (arguments.to, by_name) {
        (Some(format), _) => format.into(),
        (None, Some(target)) => target,
        (None, None) => Target::usual(&arguments.output, &content)?,
    };
    check_other(arguments, &content, target)?;
    let read = content.format();
    let counts = counts(&content);
    let mut notes = Vec::new();
    let mut report = Report::default();
    let mut write_text = |text: String| {
        let path = &arguments.output;
        files::make_folder_of(path)?;
        report = std::mem::take(&mut report).file(path, text.into_bytes())?;
        Ok::<_, Failure>(vec![path.display().to_string()])
    };
    let (kind, written) = match (target, content) {
        (Target::Model(format), Content::Model(read)) => {
            notes = read.notes;
            notes.extend(format.losses(&read.model));
            let model_files = read.model.to_files(format)?;
            let is_folder = matches!(format, ModelFormat::ColmapText | ModelFormat::ColmapBinary);
            let written = if files::is_standard(&arguments.output) {
                let file = only(model_files, format)?;
                report = report.file(&arguments.output, file.bytes)?;
                vec!["-".to_owned()]
            } else if by_name.is_some() && !is_folder {
                write_file(&arguments.output, model_files)?
            } else {
                write_folder(&arguments.output, format, model_files)?
            };
            (format.name(), written)
        }
        (Target::Cameras(format), content) => {
            let mut cameras = cameras_of(content)?;
            notes.append(&mut cameras.notes);
            if format == CameraFormat::Colmap && cameras.right_from_left.is_some() {
                notes.push("the motion between the cameras of the rig is not written".to_owned());
            }
            let text = write_cameras(format, &cameras)?;
            (format.name(), write_text(text)?)
        }
        (Target::Trajectory(format), content) => {
            let mut trajectory = trajectory_of(content)?;
            notes.append(&mut trajectory.notes);
            let text = write_trajectory(format, &trajectory)?;
            (format.name(), write_text(text)?)
        }
        (Target::Model(format), content) => {
            return Err(Failure::usage(format!(
                "{} cannot become a model ({}): it has no images",
                content.format(),
                format.name()
            )));
        }
    };
    for note in &notes {
        context.warn(note);
    }
    report = report
        .field("read", &read)
        .field("kind", kind)
        .field("written", &written)
        .field("counts", &counts)
        .field("notes", &notes)
        .row("read", read);
    for (name, count) in counts.as_object().into_iter().flatten() {
        report = report.row(name, count);
    }
    Ok(report.row("written", format!("{kind}: {}", written.join(", "))))
}

/// Refuses to overwrite the input, because the new format may hold less.
fn check_other(arguments: &Arguments, content: &Content, target: Target) -> Result<(), Failure> {
    let whole = |path: &Path| path.canonicalize().ok();
    let (input, output) = (&arguments.input, &arguments.output);
    let is_same = whole(input).is_some_and(|path| whole(output) == Some(path));
    let is_format = |read: &ReadModel| target == Target::Model(read.format);
    let is_over = match content {
        Content::Model(read) if input.is_dir() => is_format(read),
        _ => true,
    };
    match is_same && is_over && !files::is_standard(output) {
        true => Err(Failure::usage(format!(
            "{} would be written over what is read from it: choose another name",
            output.display()
        ))),
        false => Ok(()),
    }
}

/// Returns the file of a single-file format, for standard output.
fn only(files: Vec<ModelFile>, format: ModelFormat) -> Result<ModelFile, Failure> {
    let [file] = <[ModelFile; 1]>::try_from(files).map_err(|files| {
        let name = format.name();
        let count = files.len();
        Failure::usage(format!(
            "{name} is {count} files: give a folder, not standard output"
        ))
    })?;
    Ok(file)
}

fn counts(content: &Content) -> Value {
    match content {
        Content::Model(read) => json!({
            "cameras": read.model.cameras.len(),
            "images": read.model.images.len(),
            "points": read.model.points.len(),
        }),
        Content::Cameras(_, cameras) => json!({ "cameras": cameras.cameras.len() }),
        Content::Trajectory(_, path) => json!({ "poses": path.world_from_cam.len() }),
    }
}

fn cameras_of(content: Content) -> Result<Cameras, Failure> {
    match content {
        Content::Cameras(_, cameras) => Ok(cameras),
        Content::Model(read) => {
            let model = &read.model;
            let named = |(n, camera): (usize, &Camera)| {
                NamedCamera::new(model.camera_id(n).to_string(), *camera)
            };
            Ok(Cameras {
                cameras: model.cameras.iter().enumerate().map(named).collect(),
                notes: read.notes,
                ..Cameras::default()
            })
        }
        Content::Trajectory(..) => Err(Failure::usage("a trajectory has no cameras to write")),
    }
}

fn trajectory_of(content: Content) -> Result<Trajectory, Failure> {
    match content {
        Content::Trajectory(_, path) => Ok(path),
        Content::Model(read) => Ok(Trajectory {
            notes: read.notes,
            ..read.model.trajectory()
        }),
        Content::Cameras(..) => Err(Failure::usage("cameras have no path to write")),
    }
}
