//! Options of SIFT.

use crate::{Error, Result};
use derive_setters::Setters;

/// Scaling of the 128 sums of a SIFT descriptor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum SiftNormalization {
    /// Lowe's: unit length, entries clipped at 0.2, unit length again.
    #[default]
    L2,
    /// RootSIFT: the square roots of the entries divided by their sum, so that the Euclidean
    /// distance compares histograms by the Hellinger kernel.
    ///
    /// Source: Arandjelović & Zisserman 2012, "Three things everyone should know to improve
    /// object retrieval", §3.
    Root,
}

/// Options of [`detect_sift`](super::detect_sift). The defaults are Lowe's, as in OpenCV, except
/// for the assumed blur of the image: 0.3 instead of 0.5 pixels. The first octave is then blurred
/// more, and fewer of the features are too small to be seen from farther away.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct SiftOptions {
    /// Maximum number of features; the strongest are kept. 0 means no limit.
    pub max_features: usize,
    /// Number of layers per octave that are searched for extrema, 1 to 10.
    pub layers_per_octave: usize,
    /// Blur of the first layer of an octave, pixels of that octave, 0.8 to 4.
    pub sigma_px: f64,
    /// Assumed blur of the image, pixels, 0 to `sigma_px / 2`.
    pub input_blur_px: f64,
    /// Start at twice the image's size (octave −1): gives more and smaller features, at four times
    /// the cost.
    pub upsample: bool,
    /// Minimum response of an extremum times the layers per octave, for gray values in [0, 1].
    pub contrast_threshold: f32,
    /// Maximum ratio of the principal curvatures, > 1.
    pub edge_threshold: f32,
    /// Maximum number of directions per position, ≥ 1; each gives a feature.
    pub max_orientations: usize,
    /// Minimum weight of a further direction, relative to the strongest, in (0, 1].
    pub orientation_peak_ratio: f32,
    /// Assume direction 0, for upright cameras.
    pub upright: bool,
    /// Scaling of descriptors.
    pub normalization: SiftNormalization,
}

impl Default for SiftOptions {
    fn default() -> Self {
        Self {
            max_features: 0,
            layers_per_octave: 3,
            sigma_px: 1.6,
            input_blur_px: 0.3,
            upsample: true,
            contrast_threshold: 0.04,
            edge_threshold: 10.0,
            max_orientations: 2,
            orientation_peak_ratio: 0.8,
            upright: false,
            normalization: SiftNormalization::L2,
        }
    }
}

/// Rejects options outside their range.
pub(super) fn check(options: &SiftOptions) -> Result<()> {
    let ranges = [
        (
            "the layers per octave",
            "between 1 and 10",
            options.layers_per_octave as f64,
            (1..=10).contains(&options.layers_per_octave),
        ),
        (
            "the blur of an octave's first layer in pixels",
            "between 0.8 and 4",
            options.sigma_px,
            (0.8..=4.0).contains(&options.sigma_px),
        ),
        (
            "the blur of the input in pixels",
            "between 0 and half that of the first layer",
            options.input_blur_px,
            (0.0..=0.5 * options.sigma_px).contains(&options.input_blur_px),
        ),
        (
            "the contrast threshold",
            "between 0 and 1",
            f64::from(options.contrast_threshold),
            (0.0..=1.0).contains(&options.contrast_threshold),
        ),
        (
            "the edge threshold",
            "greater than 1",
            f64::from(options.edge_threshold),
            options.edge_threshold > 1.0,
        ),
        (
            "the number of directions per keypoint",
            "at least 1",
            options.max_orientations as f64,
            options.max_orientations >= 1,
        ),
        (
            "the relative height of a further direction's peak",
            "greater than 0 and at most 1",
            f64::from(options.orientation_peak_ratio),
            options.orientation_peak_ratio > 0.0 && options.orientation_peak_ratio <= 1.0,
        ),
    ];
    Error::check_rules(&ranges)
}
