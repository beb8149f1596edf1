//! Output of `epipole sfm`: the model and its images.

use super::input::Used;
use crate::failure::Failure;
use crate::matrices::Motion;
use crate::output_folder::OutputFolder;
use crate::output_folder::colmap::check_foreign;
use crate::photo;
use epipole::camera::PosedCamera;
use epipole::sfm::{Photo, Reconstruction, SfmImage};
use epipole_io::model::{Model, ModelFormat};
use epipole_io::photo::encode_jpeg;
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeSet;
use std::iter;
use std::path::{Path, PathBuf};

/// Folder of the images below the output.
const FOLDER: &str = "images";

/// Images as used, to be written.
pub(super) struct Pictures<'a> {
    used: &'a [Used],
    /// Names; changed photos become JPEG files.
    pub(super) names: Vec<String>,
}

impl<'a> Pictures<'a> {
    /// # Errors
    /// If an image would overwrite another one or an input photo.
    pub(super) fn within(output: &Path, used: &'a [Used]) -> Result<Self, Failure> {
        let folder = output.join(FOLDER);
        let mut names = Vec::new();
        for Used {
            listed,
            is_as_stored,
        } in used
        {
            names.push(match is_as_stored {
                true => listed.name.clone(),
                false => with_jpg(&listed.name),
            });
        }
        let mut taken = BTreeSet::new();
        if let Some(twice) = names.iter().find(|name| !taken.insert(*name)) {
            return Err(Failure::usage(format!(
                "two images would be written to {}",
                folder.join(twice).display()
            )));
        }
        let whole = |path: &Path| path.canonicalize().ok();
        let inputs: BTreeSet<PathBuf> = used
            .iter()
            .filter_map(|used| whole(&used.listed.path))
            .collect();
        let over = (names.iter().map(|name| folder.join(name)))
            .find(|target| whole(target).is_some_and(|target| inputs.contains(&target)));
        match over {
            Some(target) => Err(Failure::usage(format!(
                "{} is one of the input images, and --images would overwrite it: choose another -o",
                target.display()
            ))),
            None => Ok(Self { used, names }),
        }
    }

    /// # Errors
    /// If a file cannot be read again or written.
    pub(super) fn write(&self, photos: &[Photo], output: &mut OutputFolder) -> Result<(), Failure> {
        for ((used, photo), name) in self.used.iter().zip(photos).zip(&self.names) {
            let bytes = match used.is_as_stored {
                true => photo::bytes(&used.listed.path)?,
                false => encode_jpeg(&photo.image)?,
            };
            output.write(&format!("{FOLDER}/{name}"), &bytes)?;
        }
        Ok(())
    }
}

/// Returns a name with the extension of a JPEG file.
fn with_jpg(name: &str) -> String {
    let (folders, file) = name.rsplit_once('/').map_or(("", name), |(a, b)| (a, b));
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    match folders {
        "" => format!("{stem}.jpg"),
        folders => format!("{folders}/{stem}.jpg"),
    }
}

/// Refuses an output folder with files of another COLMAP model.
///
/// # Errors
/// A failure naming the file.
pub(super) fn check_models(output: &OutputFolder) -> Result<(), Failure> {
    let further = (2..).map(component_folder);
    let further = further.take_while(|below| output.folder().join(below).is_dir());
    for below in iter::once(String::new()).chain(further) {
        for format in [ModelFormat::ColmapText, ModelFormat::ColmapBinary] {
            check_foreign(output, &below, format)?;
        }
    }
    Ok(())
}

/// Returns the folder of a further component, counted from 2.
pub(super) fn component_folder(number: usize) -> String {
    format!("component{number}/")
}

/// Writes a reconstruction and returns the files.
///
/// * `folder`: below the output, empty or ending in `/`
///
/// # Errors
/// If one of them cannot be written.
pub(super) fn write_model(
    output: &mut OutputFolder,
    folder: &str,
    reconstruction: &Reconstruction,
    images: &[SfmImage],
) -> Result<Vec<String>, Failure> {
    let model = Model::from_reconstruction(reconstruction, images);
    let mut files = model.to_colmap_text()?;
    // COLMAP cuts names at blanks in text, and prefers binary files.
    if !ModelFormat::ColmapText.losses(&model).is_empty() {
        files.extend(model.to_colmap_binary()?);
    }
    files.extend(model.to_files(ModelFormat::Ply)?);
    let mut written = Vec::new();
    for file in files {
        let path = output.write(&format!("{folder}{}", file.name), &file.bytes)?;
        written.push(path.display().to_string());
    }
    Ok(written)
}

/// Returns name, focal length, lens and pose of each registered image.
pub(super) fn images_json(
    images: &[SfmImage],
    component: &Reconstruction,
) -> Vec<serde_json::Value> {
    let registered = |(image, camera): (&SfmImage, &Option<PosedCamera>)| {
        let camera = camera.as_ref()?;
        let lens = camera.camera.lens;
        Some(json!({
            "name": image.name,
            "focal_px": camera.camera.intrinsics.fu_px(),
            "lens": lens.kind().name(),
            "distortion": lens.coefficients(),
            "cam_from_world": Motion::from(&camera.cam_from_world),
        }))
    };
    (images.iter().zip(&component.cameras))
        .filter_map(registered)
        .collect()
}

/// A photo that is not in the largest component.
#[derive(Debug, Serialize)]
pub(super) struct LeftOut {
    pub(super) name: String,
    pub(super) reason: String,
}
