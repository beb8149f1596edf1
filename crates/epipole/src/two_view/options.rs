//! Options of the two-view model choice.

use crate::homography::homography_sampson_sq;
use crate::robust::RansacOptions;
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Matrix3, Point2};

/// Default maximum error of a match between photos, pixels, in
/// [`SfmOptions`](crate::sfm::SfmOptions) and the photo commands. Larger than the one pixel of
/// [`RansacOptions`], as photos have less exact features and imperfect lens models.
pub const PHOTO_MAX_ERROR_PX: f64 = 2.0;

/// Options of the two-view model choice.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TwoViewOptions {
    /// Options for each model that is tried. For H and rotations the threshold is 1.25 times as
    /// large, as their Sampson errors have two dimensions. With
    /// [`ThresholdKind::Noise`](crate::robust::ThresholdKind) all models use the threshold of F,
    /// which needs no intrinsics.
    pub ransac: RansacOptions,
    /// Minimum number of unique inliers; otherwise the pair is
    /// [`Configuration::Degenerate`](super::Configuration::Degenerate). 15.
    pub min_num_inliers: usize,
    /// Minimum fraction of epipolar inliers that a homography must explain for the scene to count
    /// as a plane or pure rotation. Above 1 none does. 0.8.
    pub max_homography_ratio: f64,
    /// Minimum ratio of E's inliers to F's for E to be preferred. 0.95.
    pub min_essential_ratio: f64,
}

impl Default for TwoViewOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default(),
            min_num_inliers: 15,
            max_homography_ratio: 0.8,
            min_essential_ratio: 0.95,
        }
    }
}

/// Ratio of thresholds for errors of two dimensions (homographies) and one (epipolar lines). It
/// keeps the same fraction of correct matches with Gaussian noise: 95 % lie within 2.45 and 1.96
/// standard deviations.
const TWO_DIMENSIONS: f64 = 1.25;

impl TwoViewOptions {
    /// Checks that every field is in its range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the name of the first invalid field; as [`RansacOptions::check`].
    pub fn check(&self) -> Result<()> {
        self.ransac.check()?;
        for (what, value) in [
            (
                "the ratio of inliers that a homography must explain",
                self.max_homography_ratio,
            ),
            (
                "the ratio of F's inliers that E must have",
                self.min_essential_ratio,
            ),
        ] {
            if value.is_nan() || value < 0.0 {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "0 or more",
                    value,
                });
            }
        }
        Ok(())
    }

    /// Returns options for models whose errors are distances in image 2, with the noise of both
    /// images.
    pub(super) fn in_two_dimensions(&self) -> RansacOptions {
        let max_error_px = self.ransac.max_error_px;
        (self.ransac).within(TWO_DIMENSIONS * core::f64::consts::SQRT_2 * max_error_px)
    }

    /// Replaces the threshold, as [`RansacOptions::within`].
    ///
    /// ```
    /// use epipole::two_view::TwoViewOptions;
    /// assert_eq!(TwoViewOptions::default().within(1.5).ransac.max_error_px, 1.5);
    /// ```
    pub fn within(&self, max_error_px: f64) -> Self {
        Self {
            ransac: self.ransac.within(max_error_px),
            ..*self
        }
    }

    pub(super) fn fits_homography(
        &self,
        h: &Matrix3<f64>,
        p1: &Point2<f64>,
        p2: &Point2<f64>,
    ) -> bool {
        let reach_px = self.reach_in_two_dimensions_px();
        homography_sampson_sq(h, p1, p2) < reach_px * reach_px
    }

    /// Returns the maximum Sampson error of a homography, pixels.
    pub(super) fn reach_in_two_dimensions_px(&self) -> f64 {
        TWO_DIMENSIONS * self.ransac.max_error_px
    }
}
