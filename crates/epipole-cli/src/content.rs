//! Content of a file or folder: a model, cameras or a trajectory.

use crate::failure::Failure;
use crate::{files, model};
use epipole_io::Error;
use epipole_io::camera::{CameraFormat, Cameras, is_camera_file, read_cameras};
use epipole_io::model::{ReadModel, format_of_file};
use epipole_io::photo::sensor_size;
use epipole_io::trajectory::{Trajectory, TrajectoryFormat, is_trajectory, read_trajectory};
use std::path::Path;

/// Content of a file or folder.
pub(crate) enum Content {
    Model(ReadModel),
    Cameras(CameraFormat, Cameras),
    Trajectory(TrajectoryFormat, Trajectory),
}

impl Content {
    /// Reads a folder as a model; reads a file, or standard input for `-`, as the first of model,
    /// cameras and trajectory that fits.
    ///
    /// # Errors
    /// A failure that names the path and why it is none of them.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return model::read(path).map(Self::Model);
        }
        Self::of_bytes(path, &files::read_bytes(path)?)
    }

    /// Reads the bytes of a file, as [`read`](Self::read).
    ///
    /// # Errors
    /// As [`read`](Self::read). The error is about the format that the first words suggest.
    pub(crate) fn of_bytes(path: &Path, bytes: &[u8]) -> Result<Self, Failure> {
        let of_model = match model::of_file(path, bytes) {
            Ok(read) => return Ok(Self::Model(read)),
            Err(failure) => failure,
        };
        let of_cameras = match read_cameras(bytes, None) {
            Ok((format, cameras)) => return Ok(Self::Cameras(format, cameras)),
            Err(error) => error,
        };
        let of_trajectory = match read_trajectory(bytes) {
            Ok((format, trajectory)) => return Ok(Self::Trajectory(format, trajectory)),
            Err(error) => error,
        };
        let is_of_colmap = path
            .file_stem()
            .is_some_and(|stem| stem == "images" || stem == "points3D");
        if is_of_colmap || format_of_file(bytes).is_some() {
            return Err(of_model);
        }
        let about = |error: Error| Err(Failure::from(error).about(path));
        // A truncated tree has no keys to recognize, only its extension.
        let is_tree = path.extension().is_some_and(|ending| {
            ["yml", "yaml", "xml", "json"]
                .iter()
                .any(|tree| ending.eq_ignore_ascii_case(tree))
        });
        let has_line = matches!(of_cameras, Error::Malformed { line: Some(_), .. });
        if is_camera_file(bytes) || (is_tree && has_line) {
            return about(of_cameras);
        }
        if is_trajectory(bytes) {
            return about(of_trajectory);
        }
        if bytes.is_empty() {
            return Err(Failure::new("malformed", "the file is empty").about(path));
        }
        if sensor_size(bytes).is_ok() {
            let message = "this is an image, where a model, cameras or a trajectory is expected";
            return Err(Failure::new("malformed", message).about(path));
        }
        if let Err(image @ Error::BadImage { .. }) = sensor_size(bytes)
            && image.to_string().contains("not supported")
        {
            return about(image);
        }
        let message = format!(
            "this is no model (of COLMAP, nerfstudio, openMVG, Bundler or PLY) and no trajectory (of TUM, KITTI or \
             EuRoC); as cameras: {of_cameras}"
        );
        Err(Failure::new("malformed", message).about(path))
    }

    /// Returns the name of the format.
    pub(crate) fn format(&self) -> String {
        match self {
            Self::Model(read) => read.format.name().to_owned(),
            Self::Cameras(format, _) => format!("cameras of {}", format.name()),
            Self::Trajectory(format, _) => format!("trajectory of {}", format.name()),
        }
    }
}
