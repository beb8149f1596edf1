//! Matches between two pinhole cameras, scored and refined eight at a time.

use super::coordinates::{CommonFrame, Coordinates};
use super::in_front::{self, Lenses};
use super::plane_recovery::PlaneRecovery;
use super::refine_pose::{ErrorsInFrame, RaysInFrame, Steps, refine_pose};
use super::sight::{Candidate, Sight};
use super::{RelativePose, sampson, sampson_sq};
use crate::camera::Intrinsics;
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
use crate::robust::{MatchSet, Support};
use nalgebra::{Matrix3, Point2};

/// Matches between two pinhole cameras.
#[derive(Debug, Clone)]
pub(super) struct PinholeMatches {
    pixels: Coordinates,
    in_frame: Coordinates,
    /// As `in_frame`, without the matches behind a camera of the current pose.
    in_front: Coordinates,
    factors: Vec<f64>,
    frame: CommonFrame,
    recovery: PlaneRecovery,
    lenses: Lenses,
    rays_in_frame: RaysInFrame,
    k1: Intrinsics,
    k2: Intrinsics,
}

/// Minimum fraction of the matches near their lines that are in front of both cameras. Below it,
/// the pose is wrong rather than the matches, and refinement uses them all.
const FEW_BEHIND: f64 = 0.8;

impl PinholeMatches {
    pub(super) fn new(matches: &MatchSet, k1: Intrinsics, k2: Intrinsics) -> Self {
        let pixels = Coordinates::voting(matches);
        let frame = CommonFrame::new(matches);
        let in_frame = pixels.mapped(&frame);
        let mut in_front = in_frame.clone();
        let factors = vec![1.0; matches.len()];
        // Allocates the memory for the loop.
        in_front.weigh_as(&in_frame, &factors);
        Self {
            in_frame,
            in_front,
            factors,
            recovery: PlaneRecovery::new(matches.len()),
            lenses: Lenses::new(&k1, &k2),
            rays_in_frame: RaysInFrame::new(&frame, &k1, &k2),
            pixels,
            frame,
            k1,
            k2,
        }
    }

    /// Minimizes the errors of some matches of the frame.
    fn minimize(
        &self,
        coordinates: &Coordinates,
        start: &RelativePose,
        loss: RobustLoss,
        steps: &Steps,
        options: &LmOptions,
    ) -> Option<Candidate> {
        let errors = ErrorsInFrame {
            coordinates,
            rays: &self.rays_in_frame,
            loss,
        };
        let pose = refine_pose(&errors, (start.rotation, start.direction), steps, options)?;
        Some(self.candidate(pose.into()))
    }
}

impl Sight for PinholeMatches {
    fn candidate(&self, pose: RelativePose) -> Candidate {
        (pose, pose.fundamental_or_zeros(&self.k1, &self.k2))
    }

    /// Returns only the line error: whether a match is behind a camera depends on the threshold.
    fn error_sq(&self, (_, fundamental): &Candidate, index: usize) -> f64 {
        let [u1, v1, u2, v2] = self.pixels.at(index);
        sampson_sq(fundamental, &Point2::new(u1, v1), &Point2::new(u2, v2))
    }

    fn support(&self, candidate: &Candidate, max_error_px: f64, cost_limit: f64) -> Support {
        let judge = self.lenses.judge(candidate, max_error_px);
        in_front::support(&self.pixels, &judge, max_error_px, cost_limit)
    }

    fn inliers(&self, candidate: &Candidate, max_error_px: f64, inliers: &mut Vec<usize>) {
        let judge = self.lenses.judge(candidate, max_error_px);
        in_front::inliers(&self.pixels, &judge, max_error_px, inliers);
    }

    fn refine(
        &mut self,
        candidate: &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        steps: &Steps,
    ) -> Option<Candidate> {
        let loss = RobustLoss::Truncated {
            width: max_error_px * self.frame.scale,
        };
        let (start, fundamental) = candidate;
        let judge = self.lenses.judge(candidate, max_error_px);
        let near = sampson::support(&self.pixels, fundamental, max_error_px, f64::INFINITY);
        let few_behind = inliers.len() as f64 >= FEW_BEHIND * near.num_inliers as f64;
        let coordinates = if few_behind && in_front::mark(&self.pixels, &judge, &mut self.factors) {
            self.in_front.weigh_as(&self.in_frame, &self.factors);
            &self.in_front
        } else {
            &self.in_frame
        };
        let refined = self.minimize(coordinates, start, loss, steps, &LmOptions::few_steps(2))?;
        if few_behind {
            return Some(refined);
        }
        let back = (refined.0.back(), refined.1);
        let num_inliers = |candidate: &Candidate| {
            self.support(candidate, max_error_px, f64::INFINITY)
                .num_inliers
        };
        Some(match num_inliers(&back) > num_inliers(&refined) {
            true => back,
            false => refined,
        })
    }

    fn polish(
        &self,
        (start, _): &Candidate,
        near: &[usize],
        weights: &[f64],
        steps: &Steps,
    ) -> Option<Candidate> {
        let near = self.in_frame.weighted(near, weights);
        self.minimize(
            &near,
            start,
            RobustLoss::Trivial,
            steps,
            &LmOptions::few_steps(4),
        )
    }

    fn dominant_plane(
        &mut self,
        (_, fundamental): &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>> {
        let f = self.frame.fundamental_to_frame(fundamental);
        let max_error = max_error_px * self.frame.scale;
        let plane = self
            .recovery
            .dominant_plane(&self.in_frame, &f, inliers, max_error, random)?;
        self.rays_in_frame.ray_homography(&plane)
    }
}
