//! Recognition of formats, and reading and writing by format.

use super::notes::has_blank;
use super::{
    Model, ModelFile, ModelFolder, bundler, colmap_binary, colmap_text, nerfstudio, openmvg,
    points_of,
};
use crate::cloud::read_ply;
use crate::{Error, Result};
use epipole::camera::LensKind;
use epipole::mvs::Mesh;

/// Formats of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModelFormat {
    /// COLMAP's `cameras.txt`, `images.txt`, `points3D.txt`.
    ColmapText,
    /// COLMAP's `cameras.bin`, `images.bin`, `points3D.bin`.
    ColmapBinary,
    /// Bundler's `bundle.out` and `list.txt`.
    Bundler,
    /// nerfstudio's `transforms.json`.
    Transforms,
    /// openMVG's `sfm_data.json`.
    OpenMvg,
    /// Points in a PLY file.
    Ply,
    /// Points and cameras in a binary glTF file: written only.
    Glb,
    /// Points and cameras in a page for browsers: written only.
    Html,
}

impl ModelFormat {
    /// Returns the name in commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::ColmapText => "colmap-text",
            Self::ColmapBinary => "colmap-binary",
            Self::Bundler => "bundler",
            Self::Transforms => "transforms",
            Self::OpenMvg => "openmvg",
            Self::Ply => "ply",
            Self::Glb => "glb",
            Self::Html => "html",
        }
    }

    /// Describes the frames and the pixel convention of the format in a sentence.
    pub fn convention(self) -> &'static str {
        match self {
            Self::ColmapText | Self::ColmapBinary => {
                "poses camera from world, y down, z forward, pixel centers at halves"
            }
            Self::Bundler => {
                "poses camera from world, y up, looking along -z, pixels relative to the principal \
                 point with y up"
            }
            Self::Transforms => {
                "poses world from camera, y up, looking along -z, pixel centers at halves"
            }
            Self::OpenMvg => {
                "rotations camera from world and centers, y down, z forward, pixel centers at \
                 integers"
            }
            Self::Ply => "points of the world",
            Self::Glb => "y up, cameras looking along -z, the world rotated by 180° about x",
            Self::Html => "a page that shows points and cameras of the world",
        }
    }

    /// Describes the losses of a model in the format, a sentence each.
    pub fn losses(self, model: &Model) -> Vec<String> {
        let mut losses = Vec::new();
        let blanks = model.images.iter().filter(|image| has_blank(&image.name));
        let blanks = blanks.count();
        if self == Self::ColmapText && blanks > 0 {
            let names = match blanks {
                1 => "1 name has blanks".to_owned(),
                _ => format!("{blanks} names have blanks"),
            };
            losses.push(format!(
                "{names}, where COLMAP cuts them in text files: use colmap-binary"
            ));
        }
        let has_tracks = model.num_observations() > 0;
        let has_images = !model.images.is_empty();
        let is_colmap = matches!(self, Self::ColmapText | Self::ColmapBinary);
        if !model.rigs.is_empty() && !is_colmap && self != Self::Ply {
            losses.push("rigs are not written: each image has its pose".to_owned());
        }
        let mut kinds = model
            .cameras
            .iter()
            .map(|c| c.lens.kind() == LensKind::Fisheye);
        let first = kinds.next();
        if self == Self::Transforms && kinds.any(|kind| Some(kind) != first) {
            losses.push(
                "nerfstudio reads one camera model for all images, and these have several: convert \
                 those of fisheyes apart"
                    .to_owned(),
            );
        }
        match self {
            Self::Transforms if has_tracks => {
                losses.push("keypoints and tracks are not written".to_owned());
            }
            Self::Bundler if has_images => losses.push(
                "principal points, image sizes and keypoints without a point are not written"
                    .to_owned(),
            ),
            Self::OpenMvg if has_images => {
                losses.push("colors and keypoints without a point are not written".to_owned());
            }
            Self::Ply if has_images => losses.push("only the points are written".to_owned()),
            Self::Glb | Self::Html if has_tracks => {
                losses.push("tracks are not written".to_owned())
            }
            _ => {}
        }
        losses
    }
}

/// A model and its format.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadModel {
    /// Its format.
    pub format: ModelFormat,
    /// Cameras, images and points.
    pub model: Model,
    /// Sentences on omissions and assumptions.
    pub notes: Vec<String>,
}

fn with_format(format: ModelFormat, (model, notes): (Model, Vec<String>)) -> ReadModel {
    ReadModel {
        format,
        model,
        notes,
    }
}

/// Reads the model in a folder: COLMAP's files, binary files first as in COLMAP, or one of
/// `transforms.json`, `sfm_data.json`, `bundle.out` and `points.ply`. `None` if there is none.
///
/// * `folder`: files of the folder
///
/// # Errors
/// As [`read_model_file`]; [`Error::Malformed`] also if one of COLMAP's files is missing.
///
/// ```
/// use epipole_io::model::{ModelFormat, read_model_folder};
/// let file = |name: &str| match name {
///     "cameras.txt" => Some(b"7 SIMPLE_PINHOLE 640 480 500 320 240\n".to_vec()),
///     "images.txt" => Some(b"3 1 0 0 0 0 0 2 7 a photo.jpg\n\n".to_vec()),
///     _ => None,
/// };
/// let read = read_model_folder(&file)?.unwrap();
/// assert_eq!(read.format, ModelFormat::ColmapText);
/// assert_eq!((read.model.images[0].id, &*read.model.images[0].name), (3, "a photo.jpg"));
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn read_model_folder(folder: &dyn ModelFolder) -> Result<Option<ReadModel>> {
    type Read = fn(&[u8], &[u8], Option<&[u8]>, Option<[&[u8]; 2]>) -> Result<(Model, Vec<String>)>;
    let readers: [(_, _, Read); 2] = [
        ("bin", ModelFormat::ColmapBinary, colmap_binary::read),
        ("txt", ModelFormat::ColmapText, colmap_text::read),
    ];
    for (ending, format, read) in readers {
        let [cameras, images, points] =
            ["cameras", "images", "points3D"].map(|name| folder.file(&format!("{name}.{ending}")));
        let (cameras, images) = match (cameras, images) {
            (Some(cameras), Some(images)) => (cameras, images),
            (Some(_), None) => return Err(missing_companion("cameras", "images", ending)),
            (None, Some(_)) => return Err(missing_companion("images", "cameras", ending)),
            (None, None) => continue,
        };
        let [rigs, frames] =
            ["rigs", "frames"].map(|name| folder.file(&format!("{name}.{ending}")));
        let of_rigs = rigs.as_deref().zip(frames.as_deref()).map(|(r, f)| [r, f]);
        let joined = read(&cameras, &images, points.as_deref(), of_rigs)?;
        let mut read = with_format(format, joined);
        if points.is_none() {
            (read.notes).push(format!("points3D.{ending} is not there: no points"));
        }
        for (name, this, other) in [("rigs", &rigs, &frames), ("frames", &frames, &rigs)] {
            if this.is_none() && other.is_some() {
                read.notes.push(format!(
                    "{name}.{ending} is not there: no rigs, and poses are those of the images"
                ));
            }
        }
        return Ok(Some(read));
    }
    for name in [
        "transforms.json",
        "sfm_data.json",
        "bundle.out",
        "points.ply",
    ] {
        if let Some(bytes) = folder.file(name) {
            return read_model_file(name, &bytes, folder).map(Some);
        }
    }
    Ok(None)
}

fn missing_companion(this: &str, other: &str, ending: &str) -> Error {
    Error::malformed(format!(
        "a COLMAP model needs {other}.{ending} beside {this}.{ending}"
    ))
}

/// Reads a model of one file, whose format is recognized by its content.
///
/// * `name`: name of the file in its folder
/// * `folder`: the other files
///
/// # Errors
/// [`Error::Malformed`] with the line or place, [`Error::Unsupported`] for other formats and for
/// unsupported cameras, [`Error::Invalid`] for impossible cameras.
pub fn read_model_file(name: &str, bytes: &[u8], folder: &dyn ModelFolder) -> Result<ReadModel> {
    let unknown = || {
        Error::unsupported(format!(
            "{name} is no model: expected a folder of COLMAP, transforms.json, sfm_data.json, \
             a Bundler file or PLY"
        ))
    };
    let format = format_of_file(bytes).ok_or_else(unknown)?;
    let read = match format {
        ModelFormat::Ply => {
            let (cloud, notes) = read_ply(bytes)?;
            let model = Model {
                points: points_of(cloud),
                ..Model::default()
            };
            (model, notes)
        }
        ModelFormat::Bundler => {
            let stem = name.strip_suffix(".out").unwrap_or(name);
            let lists = [
                "list.txt".to_owned(),
                format!("{name}.list.txt"),
                format!("{stem}.list.txt"),
            ];
            bundler::read(bytes, &lists, folder)?
        }
        ModelFormat::OpenMvg => openmvg::read(bytes)?,
        ModelFormat::Transforms => nerfstudio::read(bytes, folder)?,
        ModelFormat::ColmapText
        | ModelFormat::ColmapBinary
        | ModelFormat::Glb
        | ModelFormat::Html => return Err(unknown()),
    };
    Ok(with_format(format, read))
}

/// Returns the format of a model file by its first bytes and keys, even if it is malformed.
pub fn format_of_file(bytes: &[u8]) -> Option<ModelFormat> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let first = start.trim_ascii_start();
    let holds = |key: &[u8]| bytes.windows(key.len()).any(|window| window == key);
    let is_json = first.starts_with(b"{");
    let tests: [(ModelFormat, &dyn Fn() -> bool); 4] = [
        (ModelFormat::Ply, &|| first.starts_with(b"ply")),
        (ModelFormat::Bundler, &|| {
            first.starts_with(b"# Bundle file")
        }),
        (ModelFormat::OpenMvg, &|| {
            is_json && holds(b"\"sfm_data_version\"")
        }),
        (ModelFormat::Transforms, &|| is_json && holds(b"\"frames\"")),
    ];
    let found = tests.iter().find(|(_, is_it)| is_it());
    found.map(|(format, _)| *format)
}

impl Model {
    /// Writes the files of a format.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for cameras that the format cannot hold, [`Error::Malformed`] if an
    /// index of the model is wrong.
    pub fn to_files(&self, format: ModelFormat) -> Result<Vec<ModelFile>> {
        match format {
            ModelFormat::ColmapText => self.to_colmap_text(),
            ModelFormat::ColmapBinary => self.to_colmap_binary(),
            ModelFormat::Bundler => self.to_bundler(),
            ModelFormat::Transforms => self.to_transforms(),
            ModelFormat::OpenMvg => self.to_openmvg(),
            ModelFormat::Ply => Ok(vec![ModelFile::new("points.ply", self.to_ply())]),
            ModelFormat::Glb => Ok(vec![ModelFile::new("model.glb", self.to_glb()?)]),
            ModelFormat::Html => Ok(vec![ModelFile::new(
                "model.html",
                self.to_html(&Mesh::default())?,
            )]),
        }
    }
}
