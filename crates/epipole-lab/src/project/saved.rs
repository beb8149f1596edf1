//! Saved form of a project, without its photographs.

use super::board_options::LensCamera;
use super::document::{Anchor, Measure, PhotoId};
use super::known_poses::KnownPoses;
use super::sample::Sample;
use super::settings::Settings;
use serde::{Deserialize, Serialize};

/// The version that is written.
pub const VERSION: u32 = 1;

/// A project without its photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Saved {
    /// The version of this form.
    pub version: u32,
    /// All settings.
    pub settings: Settings,
    /// The photographs, in order.
    pub photos: Vec<SavedPhoto>,
    /// Measurements; photographs are identified by index.
    pub measures: Vec<Measure>,
    /// Three points of the floor, likewise.
    #[serde(default)]
    pub floor: Option<[Anchor; 3]>,
    /// Pairs whose depth is part of the cloud, likewise.
    #[serde(default)]
    pub dense: Vec<(PhotoId, PhotoId)>,
    /// Whether the depth of all views is part of the cloud.
    #[serde(default)]
    pub all_views: bool,
    /// Photographs of a board, in order. Their files are in a folder of their own.
    #[serde(default)]
    pub boards: Vec<SavedPhoto>,
    /// The calibrated camera that is used.
    #[serde(default)]
    pub camera: Option<LensCamera>,
    /// Cameras and poses from a model of another program.
    #[serde(default)]
    pub poses: Option<KnownPoses>,
}

/// A photograph of a saved project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedPhoto {
    /// Its name, and that of its file.
    pub name: String,
    /// Photograph of a sample, which has no file.
    pub rendered: Option<(Sample, u8)>,
    /// Left out by the reader.
    pub excluded: bool,
    /// The focal length that the reader typed, pixels.
    pub focal_px: Option<f64>,
}
