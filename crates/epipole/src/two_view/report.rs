//! Result of the two-view model choice.

use super::TwoViewOptions;
use super::pairs::Pairs;
use crate::camera::RigidTransform;
use crate::epipolar::sampson_px;
use crate::homography::homography_sampson_px;
use crate::robust::{RansacReport, StopReason};
use nalgebra::{Matrix3, Point2};

/// Configuration of two views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// A moving camera and a scene with depth, described by F or E.
    General,
    /// A moving camera and a plane, described by H; F is undetermined, and the motion may be
    /// ambiguous.
    Planar,
    /// A camera that only rotated, or hardly moved, described by H; depth is not observable.
    /// Without intrinsics this looks like a plane and is reported as
    /// [`Planar`](Configuration::Planar).
    Panoramic,
    /// No more matches agree on a model than wrong matches might by chance.
    Degenerate,
}

/// The matrix that describes the pair, unit Frobenius norm, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TwoViewModel {
    /// `x2ᵀ F x1 = 0`.
    Fundamental(Matrix3<f64>),
    /// E; [`TwoViewReport::fundamental`] is the F for pixels.
    Essential(Matrix3<f64>),
    /// `x2 ∝ H x1`.
    Homography(Matrix3<f64>),
}

/// Result of the two-view model choice.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewReport {
    /// Configuration of the views.
    pub configuration: Configuration,
    /// The chosen matrix.
    pub model: TwoViewModel,
    /// Whether `model` and `homography` apply to rays instead of pixels: for lenses other than
    /// pinholes.
    pub is_of_rays: bool,
    /// F, if defined: for calibrated views of a plane that of the motion, `None` for uncalibrated
    /// ones and for rotations.
    pub fundamental: Option<Matrix3<f64>>,
    /// H, if one was found.
    pub homography: Option<Matrix3<f64>>,
    /// The motion, for calibrated views; |t| = 1, or 0 for [`Configuration::Panoramic`]. `None` for
    /// [`Configuration::Degenerate`].
    pub cam2_from_cam1: Option<RigidTransform>,
    /// For a plane: another motion that explains the matches equally well, if any. A single plane
    /// cannot resolve this ambiguity.
    pub other_cam2_from_cam1: Option<RigidTransform>,
    /// For each input match, whether it fits `model`: within `max_error_px` of F or E, by the
    /// Sampson error, and within 1.25 times that of H, whose errors have two dimensions.
    pub inliers: Vec<bool>,
    /// Number of `inliers` that are true.
    pub num_inliers: usize,
    /// Number of matches left out: with an infinite coordinate, or one beyond 10⁹ pixels.
    pub num_left_out: usize,
    /// The threshold of F and E, pixels.
    pub max_error_px: f64,
    /// Samples drawn, over all models tried.
    pub iterations: usize,
    /// Number of samples required for `model`.
    pub required_iterations: u64,
    /// Reason why the search for `model` ended.
    pub stop: StopReason,
    /// Median angle between the inliers' rays, radians, for a calibrated pair with motion.
    pub median_triangulation_angle_rad: Option<f64>,
}

impl TwoViewReport {
    /// Returns the report of a degenerate pair.
    pub(super) fn nothing(iterations: usize, options: &TwoViewOptions) -> Self {
        Self {
            configuration: Configuration::Degenerate,
            model: TwoViewModel::Homography(Matrix3::identity() / 3.0_f64.sqrt()),
            is_of_rays: false,
            fundamental: None,
            homography: None,
            cam2_from_cam1: None,
            other_cam2_from_cam1: None,
            inliers: Vec::new(),
            num_inliers: 0,
            num_left_out: 0,
            max_error_px: options.ransac.max_error_px,
            iterations,
            required_iterations: u64::MAX,
            stop: StopReason::Exhausted,
            median_triangulation_angle_rad: None,
        }
    }

    /// Sets the inliers of the model; the motion stays unset if they are too few.
    pub(super) fn take<M>(
        &mut self,
        inliers: Vec<bool>,
        report: &RansacReport<M>,
        options: &TwoViewOptions,
    ) {
        self.num_inliers = inliers.iter().filter(|&&inlier| inlier).count();
        self.inliers = inliers;
        self.num_left_out = report.num_left_out;
        self.required_iterations = report.required_iterations;
        self.stop = report.stop;
        if report.num_unique_inliers < options.min_num_inliers || report.could_be_random() {
            self.configuration = Configuration::Degenerate;
            self.cam2_from_cam1 = None;
            self.other_cam2_from_cam1 = None;
        }
    }

    /// Sets the matches that fit the homography as inliers of the model.
    pub(super) fn take_homography<M>(
        &mut self,
        pairs: &Pairs<'_>,
        report: &RansacReport<M>,
        options: &TwoViewOptions,
    ) {
        if let TwoViewModel::Homography(h) = self.model {
            self.take(pairs.fit(&h, options), report, options);
        }
    }

    /// Returns the mean Sampson error of the inliers, pixels. `None` without inliers, if the pair
    /// has no F, and for a model of rays.
    pub fn mean_error_px(&self, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Option<f64> {
        if self.is_of_rays {
            return None;
        }
        let (mut total, mut count) = (0.0, 0);
        for ((p1, p2), _) in pixels1
            .iter()
            .zip(pixels2)
            .zip(&self.inliers)
            .filter(|(_, is)| **is)
        {
            total += match &self.model {
                TwoViewModel::Homography(h) => homography_sampson_px(h, p1, p2),
                _ => sampson_px(self.fundamental.as_ref()?, p1, p2),
            };
            count += 1;
        }
        (count > 0).then(|| total / f64::from(count))
    }
}
