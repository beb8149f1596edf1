//! What can be asked.

use super::{
    Blob, FeatureOptions, MatchOptions, PairOptions, Photograph, Reconstructed, Sample, SfmOptions,
};
use crate::project::Saved;
use serde::{Deserialize, Serialize};

/// Where a photograph comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Source {
    /// The bytes of a PNG, JPEG or WebP file.
    File(Blob),
    /// A photograph of a sample, rendered.
    Rendered(Sample, u8),
}

/// Descriptors, one after the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Described {
    /// Numbers in a descriptor.
    pub dimension: u32,
    /// All of them.
    pub values: Blob,
}

/// Intrinsics: the principal point is the middle of the photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Calibrated {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Focal length, pixels.
    pub focal_px: f64,
}

/// A photograph reduced to its keypoints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImagePoints {
    /// Its name.
    pub name: String,
    /// Its size and focal length.
    pub camera: Calibrated,
    /// Where its keypoints are, pixels.
    pub points: Vec<[f64; 2]>,
    /// Their colors.
    pub colors: Vec<[u8; 3]>,
}

/// Matches of two photographs, by their places in a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairOf {
    /// Place of the first.
    pub first: u32,
    /// Place of the second.
    pub second: u32,
    /// Indices of keypoints, first photograph first.
    pub matches: Vec<(u32, u32)>,
}

/// A photograph for an archive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Packed {
    /// Its name, which no other one has.
    pub name: String,
    /// As it was given.
    pub source: Source,
    /// As it was used; not needed for a project.
    pub used: Option<Photograph>,
}

/// A task, with everything that its answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Decode or render a photograph, upright, and reduce it.
    Photograph {
        /// Where it comes from.
        source: Source,
        /// The largest number of pixels.
        max_pixels: u32,
    },
    /// Find features.
    Features {
        /// In this photograph.
        photograph: Photograph,
        /// How.
        options: FeatureOptions,
    },
    /// Match the features of two photographs.
    Matches {
        /// Of the first.
        first: Described,
        /// Of the second.
        second: Described,
        /// How.
        options: MatchOptions,
    },
    /// Find out what two photographs say about each other.
    TwoViews {
        /// Places of the matches: `u1, v1, u2, v2`.
        places: Vec<[f64; 4]>,
        /// Of both photographs.
        cameras: [Calibrated; 2],
        /// How.
        options: PairOptions,
    },
    /// Find cameras and points.
    Reconstruction {
        /// The photographs.
        images: Vec<ImagePoints>,
        /// Matches between them.
        pairs: Vec<PairOf>,
        /// How.
        options: SfmOptions,
    },
    /// Write a reconstruction to a zip file.
    Export {
        /// The photographs, as they were reconstructed.
        images: Vec<ImagePoints>,
        /// The same with their pixels.
        photographs: Vec<Packed>,
        /// What was found.
        found: Reconstructed,
        /// Which of its components.
        component: u32,
        /// Meters in a unit of the reconstruction, where something was measured.
        meters_per_unit: Option<f64>,
        /// How, for the command that does the same.
        options: SfmOptions,
        /// How features were found.
        features: FeatureOptions,
        /// How they were matched.
        matching: MatchOptions,
    },
    /// Write photographs, as they were given, and settings to a zip file.
    Save {
        /// The photographs.
        photographs: Vec<Packed>,
        /// The rest of the project.
        project: Saved,
    },
    /// Read such a file.
    Open {
        /// Its bytes.
        archive: Blob,
    },
}
