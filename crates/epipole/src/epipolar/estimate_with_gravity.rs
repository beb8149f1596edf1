//! The relative pose of cameras that know where down is, from matches of which many are wrong.

use super::RelativePose;
use super::essential_estimator::EssentialEstimator;
use super::refine_gravity::refine_upright_in_frame;
use super::three_point::{MAX_SOLUTIONS, Upright, solve};
use crate::camera::Intrinsics;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::robust::{Estimator, MatchSet, Problem, RansacOptions, RansacReport, Support, ransac};
use crate::{Error, Result};
use nalgebra::{Point2, Vector3};

/// Relative poses of calibrated cameras that know the direction of gravity from matches, for
/// [`Ransac`](crate::robust::Ransac).
///
/// A sample is three matches, and of its solutions only those that put the three points in front of both
/// cameras are looked at. Errors and inliers are those of [`EssentialEstimator`]; refinement leaves gravity where
/// it is and finds the turn about it and the direction of the translation. Equal matches count once.
///
/// Source: as [`relative_pose_3point`](super::relative_pose_3point).
#[derive(Debug, Clone)]
pub struct GravityEstimator {
    /// The same problem without gravity.
    free: EssentialEstimator,
    upright: Upright,
}

impl GravityEstimator {
    /// Prepares the estimation.
    ///
    /// * `k1`, `k2`: intrinsics of images 1 and 2
    /// * `gravity1`, `gravity2`: the same direction of the world, down or up, in the frames of both cameras, of any
    ///   length
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than 5 different matches, as fewer fit many motions well,
    /// [`Error::Degenerate`] for a gravity without direction, and as [`EssentialEstimator::new`].
    pub fn new(
        matches: MatchSet,
        k1: Intrinsics,
        k2: Intrinsics,
        gravity1: &Vector3<f64>,
        gravity2: &Vector3<f64>,
    ) -> Result<Self> {
        let upright = Upright::new(gravity1, gravity2).ok_or(Error::Degenerate {
            what: "a relative pose with gravity",
            why: "gravity has no direction in one of the cameras",
        })?;
        Ok(Self {
            free: EssentialEstimator::new(matches, k1, k2)?,
            upright,
        })
    }
}

impl Estimator for GravityEstimator {
    type Model = RelativePose;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a relative pose with gravity from matches",
            sample_size: 3,
            max_models: MAX_SOLUTIONS,
            codimension: 1,
            data: self.free.problem().data,
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<RelativePose>) {
        let Some([rays1, rays2]) = self.free.rays_of(sample) else {
            return;
        };
        let solutions = solve(&rays1, &rays2, &self.upright);
        models.extend(
            (solutions.iter()).map(|(rotation, direction)| self.free.pose(*rotation, *direction)),
        );
    }

    fn error_sq(&self, pose: &RelativePose, index: usize) -> f64 {
        self.free.error_sq(pose, index)
    }

    fn refine(
        &mut self,
        model: &RelativePose,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<RelativePose> {
        let gravity2 = self.upright.gravity2;
        self.free
            .refined_by(model, inliers, max_error_px, |near, rays, loss| {
                refine_upright_in_frame(
                    near,
                    rays,
                    model,
                    &gravity2,
                    loss,
                    &LmOptions::few_steps(2),
                )
            })
    }

    fn polish(
        &mut self,
        model: &RelativePose,
        near: &[usize],
        weights: &[f64],
    ) -> Option<RelativePose> {
        let gravity2 = self.upright.gravity2;
        self.free.polished_by(near, weights, |near, rays| {
            let loss = RobustLoss::Trivial;
            refine_upright_in_frame(near, rays, model, &gravity2, loss, &LmOptions::few_steps(4))
        })
    }

    fn support(&self, pose: &RelativePose, max_error_px: f64, cost_limit: f64) -> Support {
        self.free.support(pose, max_error_px, cost_limit)
    }

    fn inliers(&self, pose: &RelativePose, max_error_px: f64, inliers: &mut Vec<usize>) {
        self.free.inliers(pose, max_error_px, inliers);
    }
}

/// The relative pose of two calibrated cameras that know the direction of gravity, as most matches have it.
///
/// Three matches are a sample in place of five, so that many more wrong ones are borne: with one right match in four,
/// 440 samples find three right ones with 99.9 %, and 7000 five.
///
/// * `pixels1`, `pixels2`: matching pixels; wrong matches are expected
/// * `k1`, `k2`: intrinsics of the two cameras
/// * `gravity1`, `gravity2`: the same direction of the world, down or up, in the frames of both cameras, of any
///   length: from accelerometers, or from vanishing points of verticals
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, pixels
///
/// Gravity is taken for exact. Where it is off by half a degree, as a phone's is, the threshold should let pass what that does to
/// pixels, and [`refine_relative_pose`](super::refine_relative_pose) with the inliers then frees the pose from it. If the
/// camera hardly moved, the direction means nothing.
///
/// # Errors
/// As [`MatchSet::new`], [`GravityEstimator::new`] and [`ransac`].
///
/// Source: as [`GravityEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose_with_gravity;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point2, Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // Every second match is wrong.
/// for i in (0..40).step_by(2) {
///     p2[i] = Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
/// }
/// let gravity1 = Vector3::new(0.1, 1.0, 0.2);
/// let gravity2 = cam2_from_cam1.rotation * gravity1;
/// let options = RansacOptions::default();
/// let report = estimate_relative_pose_with_gravity(&p1, &p2, [&k, &k], [&gravity1, &gravity2], &options, &mut ())?;
/// let found = report.model.cam2_from_cam1();
/// assert!(report.num_inliers >= 20);
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// assert!((found.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-5);
/// # Ok(()) }
/// ```
pub fn estimate_relative_pose_with_gravity(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    [k1, k2]: [&Intrinsics; 2],
    [gravity1, gravity2]: [&Vector3<f64>; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RelativePose>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    let estimator = GravityEstimator::new(matches, *k1, *k2, gravity1, gravity2)?;
    ransac(estimator, options, monitor)
}
