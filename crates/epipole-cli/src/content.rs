//! Content of a file or folder of another program: a model, cameras or a trajectory.

use crate::failure::Failure;
use crate::{files, model};
use epipole_io::camera::{CameraFormat, Cameras, read_cameras};
use epipole_io::model::ReadModel;
use epipole_io::trajectory::{Trajectory, TrajectoryFormat, read_trajectory};
use std::path::Path;

/// Content of a file or folder.
pub(crate) enum Content {
    Model(ReadModel),
    Cameras(CameraFormat, Cameras),
    Trajectory(TrajectoryFormat, Trajectory),
}

impl Content {
    /// Reads a folder as a model, and a file, or standard input for `-`, as the first that fits of
    /// a model, cameras and a trajectory.
    ///
    /// # Errors
    /// A sentence that names the path and why it is none of them.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return model::read(path).map(Self::Model);
        }
        let bytes = files::read_bytes(path)?;
        let of_model = match model::of_file(path, &bytes) {
            Ok(read) => return Ok(Self::Model(read)),
            Err(failure) => failure,
        };
        let of_cameras = match read_cameras(&bytes, None) {
            Ok((format, cameras)) => return Ok(Self::Cameras(format, cameras)),
            Err(error) => error,
        };
        let of_trajectory = match read_trajectory(&bytes) {
            Ok((format, trajectory)) => return Ok(Self::Trajectory(format, trajectory)),
            Err(error) => error,
        };
        let message = format!(
            "{}; read as cameras: {of_cameras}; read as a trajectory: {of_trajectory}",
            of_model.message
        );
        Err(Failure::new("malformed", message))
    }

    /// Name of the format.
    pub(crate) fn format(&self) -> String {
        match self {
            Self::Model(read) => read.format.name().to_owned(),
            Self::Cameras(format, _) => format!("cameras of {}", format.name()),
            Self::Trajectory(format, _) => format!("trajectory of {}", format.name()),
        }
    }
}
