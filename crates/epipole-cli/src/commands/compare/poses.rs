//! Poses to compare: of a trajectory, or of the images of a model.

use crate::failure::Failure;
use crate::{files, listing, model};
use epipole_io::model::ReadModel;
use epipole_io::trajectory::{Trajectory, read_trajectory};
use std::path::Path;

/// Poses of a file or folder.
pub(super) struct Poses {
    /// Name of the format.
    pub(super) format: &'static str,
    pub(super) trajectory: Trajectory,
    /// Names of the images of a model.
    pub(super) names: Option<Vec<String>>,
}

impl Poses {
    /// Reads a trajectory, or else a model.
    ///
    /// # Errors
    /// A failure that names the path; for a file that is neither, the reason why it is no
    /// trajectory.
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return Self::of_model(model::read(path)?, path);
        }
        let bytes = files::read_bytes(path)?;
        match read_trajectory(&bytes) {
            Ok((format, trajectory)) => Ok(Self {
                format: format.name(),
                trajectory,
                names: None,
            }),
            Err(error) => match model::of_file(path, &bytes) {
                Ok(read) => Self::of_model(read, path),
                Err(_) => Err(Failure::from(error).about(path)),
            },
        }
    }

    /// Returns the poses of the images, in the natural order of their names.
    fn of_model(read: ReadModel, path: &Path) -> Result<Self, Failure> {
        let mut images = read.model.images;
        if images.is_empty() {
            return Err(Failure::new("malformed", "this model has no posed images").about(path));
        }
        images.sort_by(|a, b| listing::natural(Path::new(&a.name), Path::new(&b.name)));
        let poses = images.iter().map(|image| image.cam_from_world.inverse());
        Ok(Self {
            format: read.format.name(),
            trajectory: Trajectory {
                world_from_cam: poses.collect(),
                notes: read.notes,
                ..Trajectory::default()
            },
            names: Some(images.into_iter().map(|image| image.name).collect()),
        })
    }
}
