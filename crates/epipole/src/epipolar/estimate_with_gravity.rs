//! Robust estimation of the relative pose with known gravity.

use super::RelativePose;
use super::essential_estimator::EssentialEstimator;
use super::three_point::{MAX_SOLUTIONS, Upright, solve};
use crate::camera::Camera;
use crate::progress::Monitor;
use crate::robust::{Estimator, Problem, RansacOptions, RansacReport, Support, ransac};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Vector3};

/// Estimator of relative poses of calibrated cameras with known directions of gravity, for
/// [`Ransac`](crate::robust::Ransac).
///
/// A sample is three matches, and only solutions with the three points in front of both cameras are
/// scored. Errors and inliers are those of [`EssentialEstimator`]; refinement keeps gravity fixed
/// and optimizes the rotation about it and the direction of the translation. Equal matches count
/// once.
///
/// Source: as [`relative_pose_3point`](super::relative_pose_3point).
#[derive(Debug)]
pub struct GravityEstimator {
    /// The same problem without gravity.
    free: EssentialEstimator,
    upright: Upright,
}

impl GravityEstimator {
    /// Prepares the estimation.
    ///
    /// * `pixels1`, `pixels2`: matching pixels of the two images, in the same order
    /// * `cameras`: the two cameras, with any lens
    /// * `gravity1`, `gravity2`: the same world direction, down or up, in the frames of both
    ///   cameras, with any length
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 5 matches, as fewer fit many
    /// motions well, [`Error::Degenerate`] for zero gravity vectors, and as
    /// [`EssentialEstimator::new`].
    pub fn new(
        pixels1: &[Point2<f64>],
        pixels2: &[Point2<f64>],
        cameras: [&Camera; 2],
        [gravity1, gravity2]: [&Vector3<f64>; 2],
    ) -> Result<Self> {
        let upright = Upright::new(gravity1, gravity2).ok_or(Error::Degenerate {
            what: "a relative pose with gravity",
            why: "gravity has no direction in one of the cameras",
        })?;
        let free = EssentialEstimator::new(pixels1, pixels2, cameras)?;
        Ok(Self {
            free: free.upright(upright.gravity2),
            upright,
        })
    }
}

impl Estimator for GravityEstimator {
    /// As in [`EssentialEstimator`].
    type Model = (RelativePose, Matrix3<f64>);

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a relative pose with gravity from matches",
            sample_size: 3,
            max_models: MAX_SOLUTIONS,
            codimension: 1,
            data: self.free.problem().data,
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        let Some([rays1, rays2]) = self.free.rays_of(sample) else {
            return;
        };
        let solutions = solve(&rays1, &rays2, &self.upright);
        models.extend((solutions.iter()).map(|pose| self.free.candidate((*pose).into())));
    }

    fn error_sq(&self, model: &Self::Model, index: usize) -> f64 {
        self.free.error_sq(model, index)
    }

    fn refine(
        &mut self,
        model: &Self::Model,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<Self::Model> {
        self.free.refine(model, inliers, max_error_px)
    }

    fn polish(
        &mut self,
        model: &Self::Model,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Self::Model> {
        self.free.polish(model, near, weights)
    }

    fn support(&self, model: &Self::Model, max_error_px: f64, cost_limit: f64) -> Support {
        self.free.support(model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &Self::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        self.free.inliers(model, max_error_px, inliers);
    }
}

/// Estimates the relative pose of two calibrated cameras with known directions of gravity on which
/// most matches agree.
///
/// Samples have three matches instead of five, so many more outliers are tolerated: at an inlier
/// ratio of one in four, 99.9 % confidence takes 440 samples of three, but 7000 of five.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `cameras`: the two cameras, with any lens
/// * `gravity`: the same world direction, down or up, in the frames of both cameras, with any
///   length: from accelerometers, or from vanishing points of verticals
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, pixels
///
/// Gravity is assumed exact. If it is off by half a degree, as for phones, the threshold should be
/// large enough for the effect on pixels, and [`refine_relative_pose`](super::refine_relative_pose)
/// on the inliers then removes this error. If the camera hardly moved, the direction is
/// meaningless.
///
/// # Errors
/// As [`GravityEstimator::new`] and [`ransac`].
///
/// Source: as [`GravityEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose_with_gravity;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point2, Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(camera.project(&x)?);
///     p2.push(camera.project(&(cam2_from_cam1 * x))?);
/// }
/// // Every second match is wrong.
/// for i in (0..40).step_by(2) {
///     p2[i] = Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
/// }
/// let gravity1 = Vector3::new(0.1, 1.0, 0.2);
/// let gravity2 = cam2_from_cam1.rotation * gravity1;
/// let options = RansacOptions::default();
/// let gravity = [&gravity1, &gravity2];
/// let report = estimate_relative_pose_with_gravity(&p1, &p2, [&camera; 2], gravity, &options, &mut ())?;
/// let found = report.model.cam2_from_cam1();
/// assert!(report.num_inliers >= 20);
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// assert!((found.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-5);
/// # Ok(()) }
/// ```
pub fn estimate_relative_pose_with_gravity(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    gravity: [&Vector3<f64>; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RelativePose>> {
    let estimator = GravityEstimator::new(pixels1, pixels2, cameras, gravity)?;
    Ok(ransac(estimator, options, monitor)?.map(|(pose, _)| pose))
}
