//! Motion from two-view models.

use super::pairs::Pairs;
use crate::camera::{Intrinsics, RigidTransform};
use crate::epipolar::{RelativePose, decompose_essential, sampson_sq, select_pose, signed_depths};
use crate::homography::{PlaneMotion, decompose_homography};
use crate::math::order::at_rank;
use crate::robust::RansacReport;
use nalgebra::{Matrix3, Point2, Rotation3, Vector3};

pub(super) fn pose_of_fundamental(
    pairs: &Pairs<'_>,
    k1: &Intrinsics,
    k2: &Intrinsics,
    report: &RansacReport<Matrix3<f64>>,
) -> Option<RigidTransform> {
    let essential = k2.matrix().transpose() * report.model * k1.matrix();
    let motions = decompose_essential(&essential).ok()?;
    let (in1, in2): (Vec<Point2<f64>>, Vec<Point2<f64>>) = pairs.among(&report.inliers).unzip();
    select_pose(&motions, &in1, &in2, k1, k2)
        .ok()
        .map(|selected| selected.cam2_from_cam1)
}

/// A motion is as good as the best if it fits at least this fraction of the best one's inliers.
const AS_WELL: f64 = 0.95;

/// Motions closer than this are equal: both their rotations, radians, and their directions.
const SAME_MOTION: f64 = 0.05;

/// Returns the motion past a plane with the most inliers in front of both cameras, and another
/// motion that is equally good, if any.
pub(super) fn planar_motions(
    pairs: &Pairs<'_>,
    k1: &Intrinsics,
    k2: &Intrinsics,
    homography: &RansacReport<Matrix3<f64>>,
    essential: Option<&RansacReport<RelativePose>>,
    max_error_px: f64,
) -> [Option<RelativePose>; 2] {
    let max_error_sq = max_error_px * max_error_px;
    let score = |pose: &RelativePose| {
        let fundamental = pose.fundamental_or_zeros(k1, k2);
        let fits = |(p1, p2): &(&Point2<f64>, &Point2<f64>)| {
            let (d1, d2) = signed_depths(&pose.rotation, &pose.direction, &k1.ray(p1), &k2.ray(p2));
            sampson_sq(&fundamental, p1, p2) < max_error_sq && d1 > 0.0 && d2 > 0.0
        };
        pairs.different().filter(fits).count()
    };
    let mut motions: Vec<RelativePose> = essential.iter().map(|report| report.model).collect();
    let rays1 = (pairs.among(&homography.inliers)).map(|(p1, _)| k1.ray(p1));
    let decomposed = decompose_homography(&homography.model, k1, k2).unwrap_or_default();
    motions.extend(
        in_front_of_plane(&decomposed, rays1)
            .into_iter()
            .map(RelativePose::from),
    );
    let scores: Vec<usize> = motions.iter().map(score).collect();
    let pose = |i: usize| (motions[i].rotation, motions[i].direction);
    best_and_rival(&scores, pose).map(|place| place.map(|i| motions[i]))
}

/// Returns rotations and directions of the motions that put most of a plane's points in front of
/// camera 1: n · x < 0 for the rays of its inliers, which may include outliers.
pub(super) fn in_front_of_plane(
    motions: &[PlaneMotion],
    rays1: impl Iterator<Item = Vector3<f64>> + Clone,
) -> Vec<(Matrix3<f64>, Vector3<f64>)> {
    let mut candidates = Vec::new();
    for motion in motions {
        let (mut in_front, mut count) = (0, 0);
        for ray1 in rays1.clone() {
            in_front += usize::from(motion.normal_in_cam1.dot(&ray1) < 0.0);
            count += 1;
        }
        let t = motion.cam2_from_cam1.translation.vector;
        if let (true, Some(direction)) = (2 * in_front > count, t.try_normalize(1e-12)) {
            let rotation = motion.cam2_from_cam1.rotation.to_rotation_matrix();
            candidates.push((rotation.into_inner(), direction));
        }
    }
    candidates
}

/// Returns the motion with the most support, the first of equals, and another one with nearly as
/// much, if any.
///
/// * `pose`: rotation and direction of each motion, by index in `scores`
pub(super) fn best_and_rival(
    scores: &[usize],
    pose: impl Fn(usize) -> (Matrix3<f64>, Vector3<f64>),
) -> [Option<usize>; 2] {
    let best = (0..scores.len()).rev().max_by_key(|&i| scores[i]);
    let other = best.and_then(|best| {
        let (rotation, direction) = pose(best);
        let rival = |&i: &usize| {
            let difference = pose(i).0 * rotation.transpose();
            let angle_rad = Rotation3::from_matrix_unchecked(difference).angle();
            let apart = (pose(i).1 - direction).norm();
            scores[i] as f64 >= AS_WELL * scores[best] as f64
                && (angle_rad > SAME_MOTION || apart > SAME_MOTION)
        };
        (0..scores.len()).filter(rival).max_by_key(|&i| scores[i])
    });
    [best, other]
}

pub(super) fn median_angle(
    pairs: &Pairs<'_>,
    k1: &Intrinsics,
    k2: &Intrinsics,
    motion: &RigidTransform,
    inliers: &[bool],
) -> Option<f64> {
    let mut angles: Vec<f64> = pairs
        .among(inliers)
        .map(|(p1, p2)| {
            // Normalize: products of the long rays of short lenses could overflow.
            let (r1, r2) = (k1.ray(p1).normalize(), k2.ray(p2).normalize());
            let r1 = motion.rotation * r1;
            libm::atan2(r1.cross(&r2).norm(), r1.dot(&r2))
        })
        .filter(|angle: &f64| angle.is_finite())
        .collect();
    let middle = angles.len() / 2;
    (!angles.is_empty()).then(|| at_rank(&mut angles, middle))
}
