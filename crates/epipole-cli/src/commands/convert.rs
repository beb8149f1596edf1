//! `epipole convert`: a model in another format.

use crate::context::Context;
use crate::failure::Failure;
use crate::output_folder::OutputFolder;
use crate::report::Report;
use crate::{files, model};
use clap::{Args, ValueEnum};
use epipole_io::model::{Model, ModelFile, ModelFormat};
use std::path::{Path, PathBuf};

/// Convert a model between formats.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole convert reconstruction/ model/ --to colmap-binary\n\n\
    A may be a model of COLMAP (text, binary), Bundler, nerfstudio (transforms.json), openMVG (sfm_data.json) or a\n\
    PLY file. B names the format: model.glb, points.ply, transforms.json, sfm_data.json or bundle.out; a folder is\n\
    COLMAP's, binary unless A is. Files of an earlier conversion to the same format are removed, others stay.\n\n\
    COLMAP cuts names at their first blank in text files, not in binary ones.\n\n\
    JSON: read (format of A), written (files), kind (format of B), counts (cameras, images, points), notes (what\n\
    was left out)."
)]
pub(crate) struct Arguments {
    /// The model to read: a file or a folder.
    #[arg(value_name = "A")]
    input: PathBuf,
    /// The file or folder to write.
    #[arg(value_name = "B")]
    output: PathBuf,
    /// Format to write [default: by the name of B].
    #[arg(long, value_name = "FORMAT")]
    to: Option<Format>,
}

/// Formats that are written.
#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    ColmapText,
    ColmapBinary,
    Bundler,
    Transforms,
    Openmvg,
    Ply,
    Glb,
}

impl From<Format> for ModelFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::ColmapText => Self::ColmapText,
            Format::ColmapBinary => Self::ColmapBinary,
            Format::Bundler => Self::Bundler,
            Format::Transforms => Self::Transforms,
            Format::Openmvg => Self::OpenMvg,
            Format::Ply => Self::Ply,
            Format::Glb => Self::Glb,
        }
    }
}

/// The format that a name asks for; `None` for a folder.
fn of_name(output: &Path) -> Result<Option<ModelFormat>, Failure> {
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    let name = name.to_lowercase();
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    Ok(Some(match ending {
        _ if output.is_dir() => return Ok(None),
        "ply" => ModelFormat::Ply,
        "glb" => ModelFormat::Glb,
        "out" => ModelFormat::Bundler,
        "json" if name.contains("sfm_data") => ModelFormat::OpenMvg,
        "json" => ModelFormat::Transforms,
        "txt" | "bin" | "gltf" | "csv" | "xml" => {
            return Err(Failure::usage(format!(
                "{} names no format: give a folder for COLMAP, or --to",
                output.display()
            )));
        }
        _ => return Ok(None),
    }))
}

/// Whether a format is a folder of several files.
fn is_folder(format: ModelFormat) -> bool {
    matches!(format, ModelFormat::ColmapText | ModelFormat::ColmapBinary)
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let by_name = of_name(&arguments.output);
    let by_name = match arguments.to {
        Some(_) => by_name.unwrap_or(None),
        None => by_name?,
    };
    let read = model::read(&arguments.input)?;
    let default = match read.format {
        ModelFormat::ColmapBinary => ModelFormat::ColmapText,
        _ => ModelFormat::ColmapBinary,
    };
    let format = arguments
        .to
        .map(ModelFormat::from)
        .or(by_name)
        .unwrap_or(default);
    let mut notes = read.notes;
    notes.extend(format.losses(&read.model));
    for note in &notes {
        context.warn(note);
    }
    let files = read.model.to_files(format)?;
    let written = match by_name.is_some() && !is_folder(format) {
        true => write_file(&arguments.output, files)?,
        false => write_folder(&arguments.output, format, files)?,
    };
    let Model {
        cameras,
        images,
        points,
    } = &read.model;
    Ok(Report::default()
        .field("read", read.format.name())
        .field("kind", format.name())
        .field("written", &written)
        .field(
            "counts",
            serde_json::json!({
                "cameras": cameras.len(), "images": images.len(), "points": points.len(),
            }),
        )
        .field("notes", &notes)
        .row("read", read.format.name())
        .row("cameras", cameras.len())
        .row("images", images.len())
        .row("points", points.len())
        .row(
            "written",
            format!("{}: {}", format.name(), written.join(", ")),
        ))
}

/// The first file gets the name given; others, which it names, stand beside it.
fn write_file(path: &Path, files: Vec<ModelFile>) -> Result<Vec<String>, Failure> {
    let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    if !folder.as_os_str().is_empty() {
        files::make_folder(&folder)?;
    }
    let mut written = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let path = match index {
            0 => path.to_owned(),
            _ => folder.join(&file.name),
        };
        files::write(&path, &file.bytes)?;
        written.push(path.display().to_string());
    }
    Ok(written)
}

fn write_folder(
    folder: &Path,
    format: ModelFormat,
    files: Vec<ModelFile>,
) -> Result<Vec<String>, Failure> {
    let owner = match format {
        ModelFormat::ColmapText | ModelFormat::ColmapBinary => "convert-colmap",
        other => other.name(),
    };
    let mut output = OutputFolder::new(folder, owner);
    // COLMAP reads binary files first, whatever is beside them.
    if format == ModelFormat::ColmapText && output.holds_foreign("cameras.bin") {
        return Err(Failure::new(
            "write",
            "COLMAP would read this file and not the text beside it: choose another folder, or \
             --to colmap-binary",
        )
        .about(&folder.join("cameras.bin")));
    }
    let mut written = Vec::new();
    for file in &files {
        let path = output.write(&file.name, &file.bytes)?;
        written.push(path.display().to_string());
    }
    output.finish()?;
    Ok(written)
}
