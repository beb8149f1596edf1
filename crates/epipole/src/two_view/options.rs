//! Options of the choice among models of two views.

use crate::homography::homography_sampson_sq;
use crate::robust::RansacOptions;
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Matrix3, Point2};

/// The largest error of a match of two photographs, pixels, that the commands on photographs and
/// [`SfmOptions`](crate::sfm::SfmOptions) begin with. Features of photographs are less exact, and
/// their lenses less straight, than the one pixel of [`RansacOptions`] would have it.
pub const PHOTO_MAX_ERROR_PX: f64 = 2.0;

/// Options of the choice among models of two views.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TwoViewOptions {
    /// For each of the models that are tried. H and turns, which have to fit in two dimensions, are
    /// given 1.25 times its threshold, by the Sampson error.
    /// [`ThresholdKind::Noise`](crate::robust::ThresholdKind) is that of F, which needs no
    /// intrinsics, for all of them.
    pub ransac: RansacOptions,
    /// Fewer different inliers than this mean
    /// [`Configuration::Degenerate`](super::Configuration::Degenerate). 15.
    pub min_num_inliers: usize,
    /// A homography that explains at least this share of the epipolar inliers means a plane or a
    /// turn. Above 1 nothing does. 0.8.
    pub max_homography_share: f64,
    /// E is preferred to F if it has at least this share of F's inliers. A share above 1 asks
    /// for more of them than F has. 0.95.
    pub min_essential_share: f64,
}

impl Default for TwoViewOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default(),
            min_num_inliers: 15,
            max_homography_share: 0.8,
            min_essential_share: 0.95,
        }
    }
}

/// A match misses a homography in two dimensions, an epipolar line in one. With Gaussian noise, so
/// many times the distance holds the same share of the right matches: 2.45 against 1.96 standard
/// deviations for 95 %.
const TWO_DIMENSIONS: f64 = 1.25;

impl TwoViewOptions {
    /// Whether every field is in its range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] naming the first field that is not; as [`RansacOptions::check`].
    pub fn check(&self) -> Result<()> {
        self.ransac.check()?;
        for (what, value) in [
            (
                "the share of inliers that a homography must explain",
                self.max_homography_share,
            ),
            (
                "the share of F's inliers that E must have",
                self.min_essential_share,
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

    /// For models whose errors are distances in image 2, which have the noise of both images.
    pub(super) fn in_two_dimensions(&self) -> RansacOptions {
        let max_error_px = self.ransac.max_error_px;
        (self.ransac).within(TWO_DIMENSIONS * core::f64::consts::SQRT_2 * max_error_px)
    }

    /// The same with a threshold that is given, as [`RansacOptions::within`].
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

    /// Maximum Sampson error of a homography, pixels.
    pub(super) fn reach_in_two_dimensions_px(&self) -> f64 {
        TWO_DIMENSIONS * self.ransac.max_error_px
    }
}
