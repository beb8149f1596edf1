//! Result of the choice among models of two views.

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
    /// A moving camera and a scene with depth: F or E says all.
    General,
    /// A moving camera and a plane: H says all; F is open, and the motion may be twofold.
    Planar,
    /// A camera that only turned, or hardly moved: H says all; depth cannot be told. Without
    /// intrinsics this cannot be told from a plane and is reported as
    /// [`Planar`](Configuration::Planar).
    Panoramic,
    /// No more matches agree on anything than wrong matches might by chance.
    Degenerate,
}

/// The matrix that describes the pair, unit Frobenius norm, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TwoViewModel {
    /// `x2ᵀ F x1 = 0`.
    Fundamental(Matrix3<f64>),
    /// E; the pixels' F is [`TwoViewReport::fundamental`].
    Essential(Matrix3<f64>),
    /// `x2 ∝ H x1`.
    Homography(Matrix3<f64>),
}

/// Result of the choice among models of two views.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewReport {
    /// Configuration of the views.
    pub configuration: Configuration,
    /// The matrix chosen.
    pub model: TwoViewModel,
    /// Whether `model` and `homography` are of rays, not of pixels: through lenses other than
    /// pinholes.
    pub is_of_rays: bool,
    /// F, where the pair has one: that of the motion for calibrated views of a plane, `None` for
    /// uncalibrated ones and for turns.
    pub fundamental: Option<Matrix3<f64>>,
    /// H, if one was found.
    pub homography: Option<Matrix3<f64>>,
    /// The motion, for calibrated views; |t| = 1, or 0 for [`Configuration::Panoramic`]. `None` for
    /// [`Configuration::Degenerate`].
    pub cam2_from_cam1: Option<RigidTransform>,
    /// Of a plane: another motion that explains the matches as well, if there is one. Which of the
    /// two is right, a plane alone does not tell.
    pub other_cam2_from_cam1: Option<RigidTransform>,
    /// For each match given, whether it fits `model`: within `max_error_px` of F or E, by the
    /// Sampson error, and within 1.25 times as much of H, which has to fit in two dimensions.
    pub inliers: Vec<bool>,
    /// Number of `inliers` that are true.
    pub num_inliers: usize,
    /// Matches that were left out: an infinite coordinate, or one beyond 10⁹ pixels.
    pub num_left_out: usize,
    /// The threshold of F and E, pixels.
    pub max_error_px: f64,
    /// Samples drawn, over all models tried.
    pub iterations: usize,
    /// Number of samples that `model` asks for.
    pub required_iterations: u64,
    /// Why the search for `model` ended.
    pub stop: StopReason,
    /// The median angle at which the inliers' rays meet, radians, for a calibrated pair with
    /// motion.
    pub median_triangulation_angle_rad: Option<f64>,
}

impl TwoViewReport {
    /// A degenerate pair.
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

    /// Fills in the inliers of the model; without enough of them nothing is said of the motion.
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
        if report.num_unique_inliers < options.min_num_inliers || report.could_be_chance() {
            self.configuration = Configuration::Degenerate;
            self.cam2_from_cam1 = None;
            self.other_cam2_from_cam1 = None;
        }
    }

    /// Fills in the matches that fit the homography, which is the model.
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

    /// The mean Sampson error of the inliers, pixels. `None` without inliers, if the pair has no F
    /// to measure by, and for a model of rays.
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
