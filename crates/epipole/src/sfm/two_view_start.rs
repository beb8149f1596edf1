//! Which matches of two photographs belong together, and how the cameras moved between them.

use super::tracks::PairMatches;
use crate::camera::{Intrinsics, RigidTransform};
use crate::epipolar::estimate_relative_pose;
use crate::robust::RansacOptions;
use nalgebra::Point2;

/// A pair of images whose matches passed the test of epipolar geometry.
#[derive(Debug, Clone)]
pub(super) struct VerifiedPair {
    /// The matches that passed.
    pub(super) pair: PairMatches,
    pub(super) cam2_from_cam1: RigidTransform,
    /// Median angle between the two rays of a match, radians: small for pure rotations and far
    /// scenes, where the start of a reconstruction would be ill-conditioned.
    pub(super) median_angle_rad: f64,
}

/// Keeps the matches that agree with one motion of the camera; `None` if too few do.
///
/// * `pixels`: of all keypoints of both images, distortion undone
pub(super) fn verify_pair(
    pair: &PairMatches,
    pixels: [&[Point2<f64>]; 2],
    intrinsics: [&Intrinsics; 2],
    options: &RansacOptions,
    min_num_inliers: usize,
) -> Option<VerifiedPair> {
    if pair.matches.len() < min_num_inliers.max(5) {
        return None;
    }
    let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
    for &(i, j) in &pair.matches {
        pixels1.push(pixels[0][i as usize]);
        pixels2.push(pixels[1][j as usize]);
    }
    // Without consensus the two photographs simply do not overlap.
    let report =
        estimate_relative_pose(&pixels1, &pixels2, intrinsics[0], intrinsics[1], options).ok()?;
    if report.num_unique_inliers < min_num_inliers {
        return None;
    }
    let cam2_from_cam1 = report.model.cam2_from_cam1();
    let mut angles = Vec::new();
    let mut matches = Vec::new();
    for (n, _) in report
        .inliers
        .iter()
        .enumerate()
        .filter(|(_, inlier)| **inlier)
    {
        let ray1 = cam2_from_cam1.rotation * intrinsics[0].ray(&pixels1[n]).normalize();
        let ray2 = intrinsics[1].ray(&pixels2[n]).normalize();
        angles.push(libm::acos(ray1.dot(&ray2).clamp(-1.0, 1.0)));
        matches.push(pair.matches[n]);
    }
    angles.sort_by(f64::total_cmp);
    Some(VerifiedPair {
        pair: PairMatches { matches, ..*pair },
        cam2_from_cam1,
        median_angle_rad: angles.get(angles.len() / 2).copied().unwrap_or(0.0),
    })
}
