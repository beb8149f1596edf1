//! Requests to workers.

use super::{
    Blob, BoardOptions, CalibrationOptions, CameraFound, Dense, DepthOptions, FeatureOptions,
    LensCamera, MatchOptions, PairOptions, Photograph, Reconstructed, Sample, SfmOptions,
};
use crate::project::{Computed, Saved};
use epipole::camera::Lens;
use serde::{Deserialize, Serialize};

/// Source of a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Source {
    /// The bytes of an image file.
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

/// The size and the intrinsics of a photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Calibrated {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Focal lengths and principal point, pixels.
    pub k: [f64; 4],
}

impl Calibrated {
    /// Square pixels, and the principal point in the middle.
    pub fn centered(width: u32, height: u32, focal_px: f64) -> Self {
        let middle = |side: u32| (f64::from(side) - 1.0) / 2.0;
        Self {
            width,
            height,
            k: [focal_px, focal_px, middle(width), middle(height)],
        }
    }

    /// The focal length of a camera that is [centered](Self::centered).
    pub fn centered_focal_px(&self) -> Option<f64> {
        let centered = Self::centered(self.width, self.height, self.k[0]);
        (*self == centered).then_some(self.k[0])
    }
}

/// A photograph reduced to its keypoints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImagePoints {
    /// Its name.
    pub name: String,
    /// Its size and intrinsics.
    pub camera: Calibrated,
    /// Keypoints, pixels.
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

/// Recipe for the same result elsewhere.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Recipe {
    /// The command line, in the folder of the photographs.
    pub command: String,
    /// Which photographs these are, in words.
    pub photographs: String,
    /// The calibrated camera, as `--camera` reads it.
    pub camera_json: Option<String>,
    /// The same as a program.
    pub program: String,
}

/// A task, with everything that its answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Decode or render a photograph, upright, and reduce it.
    Photograph {
        /// File or sample.
        source: Source,
        /// The largest number of pixels.
        max_pixels: u32,
        /// Camera whose distortion is removed if it has the photograph's size.
        camera: Option<LensCamera>,
    },
    /// Look for a board in a photograph of full size.
    Board {
        /// File or sample.
        source: Source,
        /// The board.
        options: BoardOptions,
    },
    /// Calibrate a camera.
    Calibration {
        /// The board and the lens.
        options: CalibrationOptions,
        /// Width and height of all photographs, pixels.
        size: (u32, u32),
        /// The marks in each, none at all where the board was not found.
        views: Vec<Vec<Option<[f64; 2]>>>,
    },
    /// Find features.
    Features {
        /// In this photograph.
        photograph: Photograph,
        /// Feature settings.
        options: FeatureOptions,
    },
    /// Match the features of two photographs.
    Matches {
        /// Of the first.
        first: Described,
        /// Of the second.
        second: Described,
        /// Matching settings.
        options: MatchOptions,
    },
    /// Estimate the two-view geometry of two photographs.
    TwoViews {
        /// Places of the matches: `u1, v1, u2, v2`.
        places: Vec<[f64; 4]>,
        /// Ratio of descriptor distances of each match: the higher, the more ambiguous.
        ratios: Vec<f32>,
        /// Of both photographs.
        cameras: [Calibrated; 2],
        /// Two-view settings.
        options: PairOptions,
    },
    /// Find cameras and points.
    Reconstruction {
        /// The photographs.
        images: Vec<ImagePoints>,
        /// Matches between them.
        pairs: Vec<PairOf>,
        /// Reconstruction settings.
        options: SfmOptions,
    },
    /// Find the depth of every pixel of a pair.
    Depth {
        /// The pair.
        photographs: [Photograph; 2],
        /// Their cameras.
        cameras: [CameraFound; 2],
        /// The lens of both.
        #[serde(rename = "distortion", with = "super::radial_lens")]
        lens: Lens,
        /// Points that both show.
        points: Vec<[f64; 3]>,
        /// Dense depth settings.
        options: DepthOptions,
    },
    /// Choose the sharpest frame of a part of a video.
    Frames {
        /// The video's name.
        name: String,
        /// Which part, from 0.
        part: u32,
        /// Some frames of it, as files of photographs.
        frames: Vec<Blob>,
    },
    /// Write a picture of the screen to a PNG file.
    Picture {
        /// Width, pixels.
        width: u32,
        /// Red, green, blue, opacity, row by row.
        rgba: Blob,
    },
    /// Write a reconstruction to a zip file.
    Export {
        /// The photographs, as they were reconstructed.
        images: Vec<ImagePoints>,
        /// The same with their pixels, or without: then those are read once more.
        photographs: Vec<Packed>,
        /// The reconstruction.
        found: Reconstructed,
        /// Index of the component.
        component: u32,
        /// Meters in a unit of the reconstruction, where something was measured.
        meters_per_unit: Option<f64>,
        /// Whether focal lengths were refined.
        focal_refined: bool,
        /// Names of photographs that have no camera in it, and why.
        left_out: Vec<(String, String)>,
        /// Recipe for the same result elsewhere.
        recipe: Recipe,
        /// The largest number of pixels of a photograph.
        max_pixels: u32,
        /// Camera whose distortion was removed from photographs of its size.
        camera: Option<LensCamera>,
        /// Names of pairs, and the depth of their pixels.
        dense: Vec<(String, Dense)>,
    },
    /// Write photographs, as they were given, and settings to a zip file.
    Save {
        /// The photographs.
        photographs: Vec<Packed>,
        /// The rest of the project.
        project: Saved,
        /// Results that need not be computed once more.
        computed: Computed,
    },
    /// Read a project's zip file.
    Open {
        /// Its bytes.
        archive: Blob,
    },
}

/// Code module that a request needs: the browser loads one without the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Branch {
    /// Vision on prepared photographs.
    Vision,
    /// Reading, rendering and writing of files, and processing of full-size photographs.
    Files,
}

impl Request {
    /// Which code it needs.
    pub fn branch(&self) -> Branch {
        match self {
            Self::Photograph { .. }
            | Self::Board { .. }
            | Self::Frames { .. }
            | Self::Picture { .. }
            | Self::Export { .. }
            | Self::Save { .. }
            | Self::Open { .. } => Branch::Files,
            Self::Features { .. }
            | Self::Matches { .. }
            | Self::TwoViews { .. }
            | Self::Reconstruction { .. }
            | Self::Depth { .. }
            | Self::Calibration { .. } => Branch::Vision,
        }
    }
}
