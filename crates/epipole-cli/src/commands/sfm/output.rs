//! Output of `epipole sfm`: the model and its images.

use super::input::Used;
use crate::failure::Failure;
use crate::{files, photo, picture};
use epipole::sfm::{Photo, Reconstruction, SfmImage};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Folder of the images as they were used.
pub(super) struct Pictures<'a> {
    used: &'a [Used],
    folder: PathBuf,
    /// A photograph that was changed is a JPEG file now.
    pub(super) names: Vec<String>,
}

impl<'a> Pictures<'a> {
    /// # Errors
    /// A sentence, if one would take the place of another, or of a photograph that was given.
    pub(super) fn within(output: &Path, used: &'a [Used]) -> Result<Self, Failure> {
        let folder = output.join("images");
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
                "two photographs would be written to {}",
                folder.join(twice).display()
            )));
        }
        let whole = |path: &Path| path.canonicalize().ok();
        let given: BTreeSet<PathBuf> = used
            .iter()
            .filter_map(|used| whole(&used.listed.path))
            .collect();
        let over = (names.iter().map(|name| folder.join(name)))
            .find(|target| whole(target).is_some_and(|target| given.contains(&target)));
        match over {
            Some(target) => Err(Failure::usage(format!(
                "{} is one of the photographs given, and --images would write over it: choose another -o",
                target.display()
            ))),
            None => Ok(Self {
                used,
                folder,
                names,
            }),
        }
    }

    /// # Errors
    /// A sentence, if a file cannot be read again or written.
    pub(super) fn write(&self, photos: &[Photo]) -> Result<(), Failure> {
        files::make_folder(&self.folder)?;
        for ((used, photo), name) in self.used.iter().zip(photos).zip(&self.names) {
            let bytes = match used.is_as_stored {
                true => photo::bytes(&used.listed.path)?,
                false => picture::jpeg(&photo.image)?,
            };
            let target = self.folder.join(name);
            files::make_folder_of(&target)?;
            files::write(&target, &bytes)?;
        }
        Ok(())
    }
}

/// A name with the extension of a JPEG file.
fn with_jpg(name: &str) -> String {
    let (folders, file) = name.rsplit_once('/').map_or(("", name), |(a, b)| (a, b));
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    match folders {
        "" => format!("{stem}.jpg"),
        folders => format!("{folders}/{stem}.jpg"),
    }
}

/// Writes a reconstruction and returns the files.
///
/// # Errors
/// A sentence, if one of them cannot be written.
pub(super) fn write_model(
    folder: &Path,
    reconstruction: &Reconstruction,
    images: &[SfmImage],
) -> Result<Vec<String>, Failure> {
    files::make_folder(folder)?;
    let model = reconstruction.to_colmap(images);
    let files = [
        ("cameras.txt", model.cameras.into_bytes()),
        ("images.txt", model.images.into_bytes()),
        ("points3D.txt", model.points.into_bytes()),
        ("points.ply", reconstruction.to_ply()),
    ];
    let mut written = Vec::new();
    for (name, bytes) in files {
        let path = folder.join(name);
        files::write(&path, &bytes)?;
        written.push(path.display().to_string());
    }
    Ok(written)
}
