//! Formats to convert to.

use crate::content::Content;
use crate::failure::Failure;
use clap::ValueEnum;
use epipole_io::camera::CameraFormat;
use epipole_io::model::ModelFormat;
use epipole_io::trajectory::TrajectoryFormat;
use std::path::Path;

/// Formats of the output.
#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum Format {
    ColmapText,
    ColmapBinary,
    Bundler,
    Transforms,
    Openmvg,
    Ply,
    Glb,
    Html,
    /// Cameras: JSON as `epipole calibrate` writes it.
    Epipole,
    /// Cameras: YAML.
    Opencv,
    /// Cameras: camera_info.
    Ros,
    /// Cameras: cameras.txt alone.
    ColmapCameras,
    /// Trajectory, with times.
    Tum,
    /// Trajectory, without times.
    Kitti,
    /// Trajectory, with times.
    Euroc,
}

/// Format of a result, by its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Target {
    Model(ModelFormat),
    Cameras(CameraFormat),
    Trajectory(TrajectoryFormat),
}

impl From<Format> for Target {
    fn from(format: Format) -> Self {
        match format {
            Format::ColmapText => Self::Model(ModelFormat::ColmapText),
            Format::ColmapBinary => Self::Model(ModelFormat::ColmapBinary),
            Format::Bundler => Self::Model(ModelFormat::Bundler),
            Format::Transforms => Self::Model(ModelFormat::Transforms),
            Format::Openmvg => Self::Model(ModelFormat::OpenMvg),
            Format::Ply => Self::Model(ModelFormat::Ply),
            Format::Glb => Self::Model(ModelFormat::Glb),
            Format::Html => Self::Model(ModelFormat::Html),
            Format::Epipole => Self::Cameras(CameraFormat::Epipole),
            Format::Opencv => Self::Cameras(CameraFormat::OpenCv),
            Format::Ros => Self::Cameras(CameraFormat::Ros),
            Format::ColmapCameras => Self::Cameras(CameraFormat::Colmap),
            Format::Tum => Self::Trajectory(TrajectoryFormat::Tum),
            Format::Kitti => Self::Trajectory(TrajectoryFormat::Kitti),
            Format::Euroc => Self::Trajectory(TrajectoryFormat::EuRoC),
        }
    }
}

impl Target {
    /// Returns the format for a file name and its content; `None` for a folder or an unknown
    /// extension.
    pub(super) fn of_name(output: &Path, content: &Content) -> Option<Self> {
        if output.is_dir() {
            return None;
        }
        let name = output.file_name().unwrap_or_default().to_string_lossy();
        let name = name.to_lowercase();
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        let format = match (ending, content) {
            ("yml" | "yaml", _) => Format::Opencv,
            ("json", Content::Cameras(..)) => Format::Epipole,
            ("txt", Content::Cameras(..)) => Format::ColmapCameras,
            ("json", Content::Model(..)) if name.starts_with("camera") => Format::Epipole,
            ("txt", Content::Model(..)) if name.starts_with("camera") => Format::ColmapCameras,
            ("csv", _) => Format::Euroc,
            ("tum", _) => Format::Tum,
            ("txt", Content::Trajectory(TrajectoryFormat::Kitti, _)) => Format::Kitti,
            ("txt", Content::Trajectory(..)) => Format::Tum,
            ("ply", _) => Format::Ply,
            ("glb", _) => Format::Glb,
            ("html" | "htm", _) => Format::Html,
            ("out", _) => Format::Bundler,
            ("json", _) if name.contains("sfm_data") => Format::Openmvg,
            ("json", _) => Format::Transforms,
            _ => return None,
        };
        Some(format.into())
    }

    /// Returns the default format for a name without one.
    ///
    /// # Errors
    /// If there is none.
    pub(super) fn usual(output: &Path, content: &Content) -> Result<Self, Failure> {
        let looks_like_file = output.extension().is_some() && !output.is_dir();
        match content {
            Content::Model(read) if !looks_like_file => Ok(Self::Model(match read.format {
                ModelFormat::ColmapBinary => ModelFormat::ColmapText,
                _ => ModelFormat::ColmapBinary,
            })),
            _ => Err(Failure::usage(format!(
                "{} names no format to write {} in: give --to",
                output.display(),
                content.format()
            ))),
        }
    }
}
