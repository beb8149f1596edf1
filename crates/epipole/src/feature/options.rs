//! Kinds of features, and their common defaults.

use super::{
    CornerMeasure, GoodFeaturesOptions, OrbOptions, SiftNormalization, SiftOptions,
    StructureTensorOptions, Window,
};
use derive_setters::Setters;

/// Kind of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum FeatureKind {
    /// Scale-invariant features ([`detect_sift`](super::detect_sift)) with Euclidean descriptors.
    Sift,
    /// The same with the Hellinger kernel ([`SiftNormalization::Root`]).
    #[default]
    RootSift,
    /// Oriented FAST corners with 256 comparisons ([`detect_orb`](super::detect_orb)).
    Orb,
    /// Harris corners with normalized patches ([`describe_patches`](super::describe_patches)), for
    /// images from nearly the same position, without rotation or change of scale.
    Harris,
}

/// Options of feature detection, with the defaults of all commands and of
/// [`PhotoOptions`](crate::sfm::PhotoOptions); see [`MatchOptions`](super::MatchOptions) and
/// [`RansacOptions`](crate::robust::RansacOptions) for matches and models.
///
/// ```
/// use epipole::feature::{FeatureKind, FeatureOptions};
/// let options = FeatureOptions::default();
/// assert_eq!((options.kind, options.max_features), (FeatureKind::RootSift, 8192));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct FeatureOptions {
    /// RootSIFT.
    pub kind: FeatureKind,
    /// Maximum number of features; the strongest are kept. 0 means no limit. 8192.
    pub max_features: usize,
    /// Minimum response of a feature, for gray values in [0, 1]; `None` for the default of the
    /// kind. SIFT: [`SiftOptions::contrast_threshold`], 0.02, which includes faint features. ORB:
    /// [`OrbOptions::fast_threshold`], 20/255. Harris: ratio to the strongest response,
    /// [`GoodFeaturesOptions::quality`], 0.01.
    pub contrast_threshold: Option<f32>,
    /// Assume direction 0, for upright cameras. Harris corners have no direction. False.
    pub upright: bool,
    /// SIFT: images of up to this many pixels are also searched at twice their size; larger ones,
    /// for which this takes seconds, only if they have fewer than `max_features` without; none
    /// if 0. 1.5 million.
    pub max_upsampled_pixels: u64,
    /// SIFT: assumed blur of the input, pixels, 0 to half of `sigma_px`. 0.5, as Lowe's; 0.3 gives
    /// more matches in sharp images, fewer where features are rare.
    pub input_blur_px: f64,
    /// SIFT: blur of the first layer of an octave, pixels of that octave, 0.8 to 4. 1.6.
    pub sigma_px: f64,
    /// SIFT: number of layers per octave that are searched for extrema, 1 to 10. 3.
    pub layers_per_octave: usize,
    /// SIFT: maximum ratio of the principal curvatures, > 1. 10.
    pub edge_threshold: f32,
    /// SIFT: maximum number of directions per position, ≥ 1; each gives a feature. 2.
    pub max_orientations: usize,
    /// SIFT: minimum weight of a further direction, relative to the strongest, in (0, 1]. 0.8.
    pub orientation_peak_ratio: f32,
    /// ORB: number of levels of the pyramid, 1 to 16. 8.
    pub num_levels: usize,
    /// ORB: ratio of the sizes of successive levels, above 1 and at most 2. 1.2.
    pub scale_factor: f64,
    /// Harris: constant k of the measure, 0 to below 0.25. 0.04.
    pub harris_k: f32,
    /// Harris: minimum distance between corners, pixels; 0 allows neighbors. 8.
    pub min_distance_px: f64,
    /// Harris: side of the square over which gradients are summed, pixels, 1 to 255. 3.
    pub tensor_window_px: usize,
    /// Harris: side of the patch that describes a corner, pixels, 2 to 64. 11.
    pub patch_px: usize,
}

impl Default for FeatureOptions {
    fn default() -> Self {
        let (sift, orb) = (SiftOptions::default(), OrbOptions::default());
        Self {
            kind: FeatureKind::RootSift,
            max_features: 8192,
            contrast_threshold: None,
            upright: false,
            max_upsampled_pixels: 1_500_000,
            input_blur_px: 0.5,
            sigma_px: sift.sigma_px,
            layers_per_octave: sift.layers_per_octave,
            edge_threshold: sift.edge_threshold,
            max_orientations: sift.max_orientations,
            orientation_peak_ratio: sift.orientation_peak_ratio,
            num_levels: orb.num_levels,
            scale_factor: orb.scale_factor,
            harris_k: 0.04,
            min_distance_px: GoodFeaturesOptions::default().min_distance_px,
            tensor_window_px: 3,
            patch_px: 11,
        }
    }
}

impl FeatureOptions {
    /// Returns the options of SIFT for an image of the given size; for a large image, without
    /// upsampling.
    ///
    /// ```
    /// let options = epipole::feature::FeatureOptions::default();
    /// assert!(options.sift(1200, 900).upsample && !options.sift(4000, 3000).upsample);
    /// ```
    pub fn sift(&self, width: u32, height: u32) -> SiftOptions {
        SiftOptions {
            max_features: self.max_features,
            layers_per_octave: self.layers_per_octave,
            sigma_px: self.sigma_px,
            input_blur_px: self.input_blur_px,
            upsample: u64::from(width) * u64::from(height) <= self.max_upsampled_pixels,
            contrast_threshold: self.contrast_threshold.unwrap_or(0.02),
            edge_threshold: self.edge_threshold,
            max_orientations: self.max_orientations,
            orientation_peak_ratio: self.orientation_peak_ratio,
            upright: self.upright,
            normalization: match self.kind {
                FeatureKind::Sift => SiftNormalization::L2,
                _ => SiftNormalization::Root,
            },
        }
    }

    /// Returns the options of ORB.
    pub(super) fn orb(&self) -> OrbOptions {
        OrbOptions {
            max_features: match self.max_features {
                0 => u32::MAX as usize,
                limit => limit,
            },
            scale_factor: self.scale_factor,
            num_levels: self.num_levels,
            fast_threshold: (self.contrast_threshold)
                .unwrap_or(OrbOptions::default().fast_threshold),
            upright: self.upright,
        }
    }

    /// Returns the options of Harris corners.
    pub(super) fn harris(&self) -> GoodFeaturesOptions {
        let default = GoodFeaturesOptions::default();
        GoodFeaturesOptions {
            max_corners: self.max_features,
            quality: self.contrast_threshold.unwrap_or(default.quality),
            min_distance_px: self.min_distance_px,
            measure: CornerMeasure::Harris(self.harris_k),
            tensor: StructureTensorOptions {
                window: Window::Box(self.tensor_window_px),
                ..default.tensor
            },
            ..default
        }
    }
}
