//! Matches as two calibrated cameras saw them.

use super::RelativePose;
use super::refine_pose::Steps;
use crate::math::random::Random;
use crate::robust::Support;
use nalgebra::Matrix3;

/// A pose, and the matrix that measures its errors: F of the pixels of pinhole cameras, E of the
/// rays of others.
pub(super) type Candidate = (RelativePose, Matrix3<f64>);

/// Errors of matches between two cameras: how a pose is judged and refined. Errors are in pixels.
pub(super) trait Sight: core::fmt::Debug + Send + Sync {
    /// A pose with its matrix.
    fn candidate(&self, pose: RelativePose) -> Candidate;

    /// The squared error of a match.
    fn error_sq(&self, candidate: &Candidate, index: usize) -> f64;

    /// Support among the matches in front of both cameras; stops once the cost exceeds
    /// `cost_limit`.
    fn support(&self, candidate: &Candidate, max_error_px: f64, cost_limit: f64) -> Support;

    /// Fills `inliers` with the matches within the threshold, in front of both cameras.
    fn inliers(&self, candidate: &Candidate, max_error_px: f64, inliers: &mut Vec<usize>);

    /// The pose that minimizes the truncated errors.
    fn refine(
        &mut self,
        candidate: &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        steps: &Steps,
    ) -> Option<Candidate>;

    /// The pose that minimizes the weighted errors of some matches.
    fn polish(
        &self,
        candidate: &Candidate,
        near: &[usize],
        weights: &[f64],
        steps: &Steps,
    ) -> Option<Candidate>;

    /// The homography of rays of a plane that holds most inliers, if there is one.
    fn dominant_plane(
        &mut self,
        candidate: &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>>;
}
