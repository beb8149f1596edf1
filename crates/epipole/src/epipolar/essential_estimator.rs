//! The relative pose of calibrated cameras, as RANSAC asks for it.

use super::coordinates::{CommonFrame, Coordinates};
use super::estimate_fundamental::refuse_collinear;
use super::five_point::{pose_in_front, solve};
use super::in_front::{self, Lenses};
use super::other_motion::other_motion_of_plane;
use super::plane_recovery::PlaneRecovery;
use super::refine_pose::{Pose, RaysInFrame, refine_pose_in_frame};
use super::{RelativePose, sampson};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::Intrinsics;
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
use crate::robust::{Data, Estimator, Evidence, MatchSet, Problem, Support};
use nalgebra::{Matrix3, Vector3};

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
        matches.at_least(5, "an essential matrix from matches")?;
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

    /// The rays of a sample of matches; `None` if two of them share a pixel.
    pub(super) fn rays_of<const N: usize>(
        &self,
        sample: &[usize],
    ) -> Option<[[Vector3<f64>; N]; 2]> {
        let rays = |image: usize| core::array::from_fn(|i| self.rays[sample[i]][image]);
        (!self.matches.have_shared_pixel(sample)).then(|| [0, 1].map(rays))
    }

    pub(super) fn pose(&self, rotation: Matrix3<f64>, direction: Vector3<f64>) -> RelativePose {
        RelativePose::new(rotation, direction, &self.k1, &self.k2)
    }

    /// As [`Estimator::refine`] has it, by some refinement in the frame of the coordinates.
    pub(super) fn refined_by(
        &mut self,
        model: &RelativePose,
        inliers: &[usize],
        max_error_px: f64,
        by: impl FnOnce(&Coordinates, &RaysInFrame, RobustLoss) -> Option<Pose>,
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
        let (rotation, direction) = by(coordinates, &self.rays_in_frame, loss)?;
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

    /// As [`Estimator::polish`] has it, by some refinement in the frame of the coordinates.
    pub(super) fn polished_by(
        &self,
        near: &[usize],
        weights: &[f64],
        by: impl FnOnce(&Coordinates, &RaysInFrame) -> Option<Pose>,
    ) -> Option<RelativePose> {
        let near = self.in_frame.weighted(near, weights);
        let (rotation, direction) = by(&near, &self.rays_in_frame)?;
        Some(self.pose(rotation, direction))
    }
}

/// Where fewer of the matches near to their lines than this share are in front of both cameras, it is
/// the pose that is wrong rather than they: refinement heeds them all.
const FEW_BEHIND: f64 = 0.8;

impl Estimator for EssentialEstimator {
    type Model = RelativePose;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "an essential matrix from matches",
            sample_size: 5,
            max_models: 10,
            codimension: 1,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<RelativePose>) {
        let Some([rays1, rays2]) = self.rays_of(sample) else {
            return;
        };
        let mut solutions = [Matrix3::zeros(); 10];
        let count = solve(&rays1, &rays2, &mut solutions);
        for essential in &solutions[..count] {
            if let Some((rotation, direction)) = pose_in_front(essential, &rays1, &rays2) {
                models.push(self.pose(rotation, direction));
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
        self.refined_by(model, inliers, max_error_px, |near, rays, loss| {
            refine_pose_in_frame(near, rays, model, loss, &LmOptions::few_steps(2))
        })
    }

    fn polish(
        &mut self,
        model: &RelativePose,
        near: &[usize],
        weights: &[f64],
    ) -> Option<RelativePose> {
        self.polished_by(near, weights, |near, rays| {
            refine_pose_in_frame(
                near,
                rays,
                model,
                RobustLoss::Trivial,
                &LmOptions::few_steps(4),
            )
        })
    }

    fn alternative(
        &mut self,
        model: &RelativePose,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<RelativePose> {
        let Evidence::Inliers(inliers) = evidence else {
            return None;
        };
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
