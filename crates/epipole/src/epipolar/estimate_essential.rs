//! E and the relative pose from matches of which many are wrong.

use super::coordinates::{CommonFrame, Coordinates};
use super::estimate_fundamental::refuse_collinear;
use super::five_point::{pose_in_front, solve};
use super::in_front::{self, Lenses};
use super::other_motion::other_motion_of_plane;
use super::plane_recovery::PlaneRecovery;
use super::refine_pose::{RaysInFrame, refine_pose_in_frame};
use super::sampson;
use super::{RelativePose, decompose_essential, select_pose};
use crate::camera::Intrinsics;
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
#[cfg(doc)]
use crate::robust::ransac;
use crate::robust::{
    Estimator, MatchSet, RansacOptions, RansacReport, Support, Trial, ransac_with,
};
use crate::{Error, Result};
use core::ops::ControlFlow;
use nalgebra::{Matrix3, Point2, Vector3};

/// Relative poses of calibrated cameras from matches, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is five matches, and of its solutions only those that put the five points in front of
/// both cameras are looked at. The error is the Sampson error in pixels; refinement
/// minimizes it, truncated, over rotation and direction. A match that is behind a camera supports no
/// pose, however near to its line; one that could be infinitely far away, up to an error within the
/// threshold, is not behind. Where a plane holds most of the inliers, the other motion that it allows
/// is tried, too. Equal matches count once.
///
/// Source: Nistér 2004, "An efficient solution to the five-point relative pose problem";
/// Longuet-Higgins 1986, "The reconstruction of a plane surface from two perspective projections".
#[derive(Debug, Clone)]
pub struct EssentialEstimator {
    matches: MatchSet,
    pixels: Coordinates,
    in_frame: Coordinates,
    /// As `in_frame`, without what is behind a camera of the pose in hand.
    in_front: Coordinates,
    factors: Vec<f64>,
    frame: CommonFrame,
    recovery: PlaneRecovery,
    lenses: Lenses,
    rays_in_frame: RaysInFrame,
    rays: Vec<[Vector3<f64>; 2]>,
    k1: Intrinsics,
    k2: Intrinsics,
}

impl EssentialEstimator {
    /// Prepares the estimation; `k1` and `k2` are the intrinsics of images 1 and 2.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than 5 different matches, [`Error::Degenerate`] if all pixels
    /// of an image lie on one line, or are equal.
    pub fn new(matches: MatchSet, k1: Intrinsics, k2: Intrinsics) -> Result<Self> {
        if matches.len() < 5 {
            return Err(Error::TooFew {
                what: "an essential matrix from matches",
                needed: 5,
                got: matches.len(),
            });
        }
        refuse_collinear(&matches, "an essential matrix from matches")?;
        let pixels = Coordinates::voting(&matches);
        let frame = CommonFrame::new(&matches);
        let rays = (0..matches.len())
            .map(|i| {
                let (p1, p2) = matches.pair(i);
                [k1.ray(&p1).normalize(), k2.ray(&p2).normalize()]
            })
            .collect();
        let in_frame = pixels.mapped(&frame);
        let mut in_front = in_frame.clone();
        let factors = vec![1.0; matches.len()];
        // Takes the memory that the loop needs.
        in_front.weigh_as(&in_frame, &factors);
        Ok(Self {
            in_frame,
            in_front,
            factors,
            recovery: PlaneRecovery::new(matches.len()),
            lenses: Lenses::new(&k1, &k2),
            rays_in_frame: RaysInFrame::new(&frame, &k1, &k2),
            matches,
            pixels,
            frame,
            rays,
            k1,
            k2,
        })
    }
}

/// Where fewer of the matches near to their lines than this share are in front of both cameras, it is
/// the pose that is wrong rather than they: refinement heeds them all.
const FEW_BEHIND: f64 = 0.8;

fn steps(max_iterations: usize) -> LmOptions {
    LmOptions {
        max_iterations,
        cost_tolerance: 1e-5,
        step_tolerance: 1e-9,
        ..LmOptions::default()
    }
}

impl Estimator for EssentialEstimator {
    type Model = RelativePose;

    fn name(&self) -> &'static str {
        "an essential matrix from matches"
    }

    fn sample_size(&self) -> usize {
        5
    }

    fn num_data(&self) -> usize {
        self.matches.len()
    }

    fn matches(&self) -> Option<&MatchSet> {
        Some(&self.matches)
    }

    fn max_models(&self) -> usize {
        10
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<RelativePose>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        let rays1 = core::array::from_fn(|i| self.rays[sample[i]][0]);
        let rays2 = core::array::from_fn(|i| self.rays[sample[i]][1]);
        let mut solutions = [Matrix3::zeros(); 10];
        let count = solve(&rays1, &rays2, &mut solutions);
        for essential in &solutions[..count] {
            if let Some((rotation, direction)) = pose_in_front(essential, &rays1, &rays2) {
                models.push(RelativePose::new(rotation, direction, &self.k1, &self.k2));
            }
        }
    }

    /// Of the line alone: whether a match is behind a camera depends on the threshold.
    fn error_sq(&self, pose: &RelativePose, index: usize) -> f64 {
        let (x1, x2) = self.matches.pair(index);
        super::sampson_sq(&pose.fundamental, &x1, &x2)
    }

    fn refine(
        &mut self,
        model: &RelativePose,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<RelativePose> {
        let loss = RobustLoss::Truncated {
            width: max_error_px * self.frame.scale,
        };
        let judge = self.lenses.judge(model, max_error_px);
        let near = sampson::support(
            &self.pixels,
            &model.fundamental,
            max_error_px,
            f64::INFINITY,
        );
        let few_behind = inliers.len() as f64 >= FEW_BEHIND * near.num_inliers as f64;
        let coordinates = if few_behind && in_front::mark(&self.pixels, &judge, &mut self.factors) {
            self.in_front.weigh_as(&self.in_frame, &self.factors);
            &self.in_front
        } else {
            &self.in_frame
        };
        let (rotation, direction) =
            refine_pose_in_frame(coordinates, &self.rays_in_frame, model, loss, &steps(2))?;
        let pose = RelativePose::new(rotation, direction, &self.k1, &self.k2);
        if few_behind {
            return Some(pose);
        }
        let back = RelativePose {
            direction: -pose.direction,
            ..pose
        };
        let num_inliers = |pose: &RelativePose| {
            let judge = self.lenses.judge(pose, max_error_px);
            in_front::support(&self.pixels, &judge, max_error_px, f64::INFINITY).num_inliers
        };
        Some(if num_inliers(&back) > num_inliers(&pose) {
            back
        } else {
            pose
        })
    }

    fn polish(
        &mut self,
        model: &RelativePose,
        near: &[usize],
        weights: &[f64],
    ) -> Option<RelativePose> {
        let near = self.in_frame.weighted(near, weights);
        let loss = RobustLoss::Trivial;
        let (rotation, direction) =
            refine_pose_in_frame(&near, &self.rays_in_frame, model, loss, &steps(4))?;
        Some(RelativePose::new(rotation, direction, &self.k1, &self.k2))
    }

    fn settle(
        &mut self,
        model: &RelativePose,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<RelativePose> {
        let f = self.frame.fundamental_to_frame(&model.fundamental);
        let max_error = max_error_px * self.frame.scale;
        let plane = self
            .recovery
            .dominant_plane(&self.in_frame, &f, inliers, max_error, random)?;
        let plane = self.rays_in_frame.homography_of_rays(&plane)?;
        let (rotation, direction) =
            other_motion_of_plane(&model.rotation, &model.direction, &plane)?;
        let cost = |pose: &RelativePose| self.support(pose, max_error_px, f64::INFINITY).cost;
        let there = RelativePose::new(rotation, direction, &self.k1, &self.k2);
        let back = RelativePose {
            direction: -direction,
            ..there
        };
        let known = cost(model);
        let mut pose = if cost(&back) < cost(&there) {
            back
        } else {
            there
        };
        let mut near = Vec::new();
        for reach_px in [2.0 * max_error_px, max_error_px, max_error_px] {
            self.inliers(&pose, reach_px, &mut near);
            pose = self.refine(&pose, &near, reach_px)?;
        }
        let cost = self.support(&pose, max_error_px, f64::INFINITY).cost;
        (cost < known).then_some(pose)
    }

    fn support(&self, pose: &RelativePose, max_error_px: f64, cost_limit: f64) -> Support {
        let judge = self.lenses.judge(pose, max_error_px);
        in_front::support(&self.pixels, &judge, max_error_px, cost_limit)
    }

    fn inliers(&self, pose: &RelativePose, max_error_px: f64, inliers: &mut Vec<usize>) {
        let judge = self.lenses.judge(pose, max_error_px);
        in_front::inliers(&self.pixels, &judge, max_error_px, inliers);
    }
}

/// The relative pose of two calibrated cameras that most matches agree on.
///
/// * `pixels1`, `pixels2`: matching pixels; wrong matches are expected
/// * `k1`, `k2`: intrinsics of the two cameras
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, pixels; an inlier
///   is in front of both cameras as well, or so far away that this cannot be told
///
/// Of the four motions that the essential matrix allows, the one that puts the most inliers in front
/// of both cameras is returned. If the camera hardly moved, the direction means nothing;
/// [`find_explaining_turn`](crate::two_view::find_explaining_turn) tells whether this may be so.
///
/// # Errors
/// As [`MatchSet::new`], [`EssentialEstimator::new`] and [`ransac`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose;
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
/// // Every fifth match is wrong.
/// for i in (0..40).step_by(5) {
///     p2[i] = Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
/// }
/// let report = estimate_relative_pose(&p1, &p2, &k, &k, &RansacOptions::default())?;
/// assert_eq!(report.num_inliers, 32);
/// // The direction of t is found; its length is not to be seen.
/// let found = report.model.cam2_from_cam1();
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// assert!((found.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "recoverPose")]
pub fn estimate_relative_pose(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &RansacOptions,
) -> Result<RansacReport<RelativePose>> {
    estimate_relative_pose_with(pixels1, pixels2, k1, k2, options, |_| {
        ControlFlow::Continue(())
    })
}

/// As [`estimate_relative_pose`], and shows every trial to `watch`, which may end the run by
/// [`ControlFlow::Break`]; the report is then about the best model so far.
///
/// # Errors
/// As [`estimate_relative_pose`] and [`ransac_with`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::Intrinsics;
/// use epipole::epipolar::estimate_relative_pose_with;
/// use epipole::robust::{RansacOptions, StopReason};
/// use nalgebra::Point2;
/// use std::ops::ControlFlow;
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// // A step to the right: near things move more than far ones.
/// let p2: Vec<_> = (0..60).map(|i| Point2::new(p1[i].x - (5 + i * 13 % 31) as f64, p1[i].y)).collect();
/// let report = estimate_relative_pose_with(&p1, &p2, &k, &k, &RansacOptions::default(), |trial| {
///     if trial.iteration == 20 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert_eq!((report.iterations, report.stop), (20, StopReason::Canceled));
/// assert!((report.model.direction.x + 1.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_relative_pose_with(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &RansacOptions,
    watch: impl FnMut(&Trial<'_, RelativePose>) -> ControlFlow<()>,
) -> Result<RansacReport<RelativePose>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    let estimator = EssentialEstimator::new(matches, *k1, *k2)?;
    let mut report = ransac_with(estimator, options, watch)?;
    let inliers_of = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        pixels
            .iter()
            .zip(&report.inliers)
            .filter(|(_, inlier)| **inlier)
            .map(|(p, _)| *p)
            .collect()
    };
    let (inliers1, inliers2) = (inliers_of(pixels1), inliers_of(pixels2));
    let motions = decompose_essential(&report.model.essential())?;
    let chosen = select_pose(&motions, &inliers1, &inliers2, k1, k2)?;
    let rotation = chosen.cam2_from_cam1.rotation.to_rotation_matrix();
    let direction = chosen.cam2_from_cam1.translation.vector;
    report.model = RelativePose::checked(rotation.into_inner(), direction, k1, k2)?;
    Ok(report)
}

/// The essential matrix that most matches agree on, unit Frobenius norm; as
/// [`estimate_relative_pose`].
///
/// # Errors
/// As [`estimate_relative_pose`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{essential_from_motion, estimate_essential};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// let report = estimate_essential(&p1, &p2, &k, &k, &RansacOptions::default())?;
/// let truth = essential_from_motion(&cam2_from_cam1)?;
/// assert_eq!(report.num_inliers, 40);
/// assert!((report.model - truth).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "findEssentialMat")]
pub fn estimate_essential(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &RansacOptions,
) -> Result<RansacReport<Matrix3<f64>>> {
    estimate_relative_pose(pixels1, pixels2, k1, k2, options)
        .map(|report| report.map(|pose| pose.essential()))
}
