//! Matches between two calibrated cameras.

use super::RelativePose;
use super::refine_pose::Steps;
use crate::math::random::Random;
use crate::robust::Support;
use nalgebra::Matrix3;

/// A pose, and the matrix for its errors: F of the pixels of pinhole cameras, E of the rays of
/// other lenses.
pub(super) type Candidate = (RelativePose, Matrix3<f64>);

/// Scoring and refinement of poses by matches between two cameras. Errors are in pixels.
pub(super) trait Sight: core::fmt::Debug + Send + Sync {
    /// Returns a pose with its matrix.
    fn candidate(&self, pose: RelativePose) -> Candidate;

    /// Returns the squared error of a match.
    fn error_sq(&self, candidate: &Candidate, index: usize) -> f64;

    /// Returns the support among the matches in front of both cameras; stops once the cost exceeds
    /// `cost_limit`.
    fn support(&self, candidate: &Candidate, max_error_px: f64, cost_limit: f64) -> Support;

    /// Fills `inliers` with the matches within the threshold, in front of both cameras.
    fn inliers(&self, candidate: &Candidate, max_error_px: f64, inliers: &mut Vec<usize>);

    /// Returns the pose that minimizes the truncated errors.
    fn refine(
        &mut self,
        candidate: &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        steps: &Steps,
    ) -> Option<Candidate>;

    /// Returns the pose that minimizes the weighted errors of some matches.
    fn polish(
        &self,
        candidate: &Candidate,
        near: &[usize],
        weights: &[f64],
        steps: &Steps,
    ) -> Option<Candidate>;

    /// Returns the homography of rays of a plane that holds most inliers, if any.
    fn dominant_plane(
        &mut self,
        candidate: &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>>;
}
