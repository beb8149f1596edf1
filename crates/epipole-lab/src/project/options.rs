//! The settings of each step, as sent to workers.

use serde::{Deserialize, Serialize};

/// Kind of descriptor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeatureKind {
    /// SIFT with the Hellinger kernel.
    RootSift,
    /// SIFT as published.
    Sift,
}

/// Feature settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FeatureOptions {
    /// The descriptor.
    pub kind: FeatureKind,
    /// Maximum number of features per photograph, the strongest.
    pub max_features: u32,
    /// Minimum contrast of a feature, for gray values in [0, 1].
    pub contrast: f32,
}

impl Default for FeatureOptions {
    /// Returns the defaults of `epipole sfm`.
    fn default() -> Self {
        Self {
            kind: FeatureKind::RootSift,
            max_features: 8192,
            contrast: 0.02,
        }
    }
}

/// Matching settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MatchOptions {
    /// Maximum ratio of the distances to the nearest and the second nearest descriptor.
    pub ratio: f32,
    /// Require mutual nearest neighbors.
    pub mutual: bool,
}

impl Default for MatchOptions {
    fn default() -> Self {
        Self {
            ratio: 0.8,
            mutual: true,
        }
    }
}

/// Two-view settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PairOptions {
    /// Maximum error of an inlier, pixels.
    pub max_error_px: f64,
    /// Seed; equal seeds give equal results.
    pub seed: u64,
}

impl Default for PairOptions {
    /// Returns the defaults of `epipole two-view`.
    fn default() -> Self {
        Self {
            max_error_px: 2.0,
            seed: 0,
        }
    }
}

/// Reconstruction settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SfmOptions {
    /// Minimum number of points that a photograph sees, and of matches that join two photographs.
    pub min_num_inliers: u32,
    /// Whether to refine one factor for all focal lengths.
    pub refine_focal: bool,
    /// Whether to refine two terms of radial distortion shared by all photographs.
    pub refine_distortion: bool,
    /// Whether to correct focal lengths and radial distortion at the end if that lowers the error.
    #[serde(default)]
    pub correct_lens: bool,
    /// Seed; equal seeds give equal results.
    pub seed: u64,
}

impl Default for SfmOptions {
    fn default() -> Self {
        Self {
            min_num_inliers: 15,
            refine_focal: false,
            refine_distortion: false,
            correct_lens: false,
            seed: 0,
        }
    }
}

/// Stereo matcher for a rectified pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum DepthMethod {
    /// Semi-global matching.
    SemiGlobal,
    /// Block matching.
    Block,
}

/// Dense depth settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DepthOptions {
    /// Stereo matcher.
    pub method: DepthMethod,
    /// Whether to fill pixels without a disparity from the background beside them.
    pub fill: bool,
    /// Smallest and largest disparity to search, in pixels of the coarser photograph; `None` for
    /// the range given by the sparse points.
    pub range_px: Option<[i32; 2]>,
}

impl Default for DepthOptions {
    /// Returns the defaults of `epipole stereo`, except for the range.
    fn default() -> Self {
        Self {
            method: DepthMethod::SemiGlobal,
            fill: false,
            range_px: None,
        }
    }
}

/// Settings of the depth of all views.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AllViewsOptions {
    /// Maximum size of a photograph, megapixels; larger ones are downscaled.
    pub max_megapixels: f64,
}

impl Default for AllViewsOptions {
    /// Returns settings that take a minute or two for a small scene in a browser.
    fn default() -> Self {
        Self {
            max_megapixels: 0.3,
        }
    }
}
