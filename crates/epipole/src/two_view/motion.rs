//! Motions from models.

use crate::camera::{Intrinsics, RigidTransform};
use crate::epipolar::{RelativePose, decompose_essential, sampson_sq, select_pose, signed_depths};
use crate::homography::decompose_homography;
use crate::robust::RansacReport;
use nalgebra::{Matrix3, Point2};

fn chosen(pixels: &[Point2<f64>], inliers: &[bool]) -> Vec<Point2<f64>> {
    pixels
        .iter()
        .zip(inliers)
        .filter(|(_, inlier)| **inlier)
        .map(|(p, _)| *p)
        .collect()
}

pub(super) fn pose_of_fundamental(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    report: &RansacReport<Matrix3<f64>>,
) -> Option<RigidTransform> {
    let essential = k2.matrix().transpose() * report.model * k1.matrix();
    let motions = decompose_essential(&essential).ok()?;
    let (in1, in2) = (
        chosen(pixels1, &report.inliers),
        chosen(pixels2, &report.inliers),
    );
    select_pose(&motions, &in1, &in2, k1, k2)
        .ok()
        .map(|selected| selected.cam2_from_cam1)
}

/// The motion past a plane with the most matches that fit and lie in front of both cameras.
pub(super) fn planar_pose(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    homography: &RansacReport<Matrix3<f64>>,
    essential: Option<&RansacReport<RelativePose>>,
    max_error_px: f64,
) -> Option<RelativePose> {
    let max_error_sq = max_error_px * max_error_px;
    let score = |pose: &RelativePose| {
        pixels1
            .iter()
            .zip(pixels2)
            .filter(|(p1, p2)| {
                let (d1, d2) =
                    signed_depths(&pose.rotation, &pose.direction, &k1.ray(p1), &k2.ray(p2));
                sampson_sq(&pose.fundamental, p1, p2) < max_error_sq && d1 > 0.0 && d2 > 0.0
            })
            .count()
    };
    let mut best: Option<(usize, RelativePose)> = None;
    let mut offer = |pose: RelativePose| {
        let count = score(&pose);
        if best.is_none_or(|(most, _)| count > most) {
            best = Some((count, pose));
        }
    };
    if let Some(report) = essential {
        offer(report.model);
    }
    for motion in decompose_homography(&homography.model, k1, k2).ok()? {
        // Points of the plane must be in front of camera 1: n · x < 0 for the inliers' rays.
        let in_front = pixels1
            .iter()
            .zip(&homography.inliers)
            .filter(|(_, inlier)| **inlier)
            .all(|(p, _)| motion.normal_in_cam1.dot(&k1.ray(p)) < 0.0);
        let t = motion.cam2_from_cam1.translation.vector;
        if let (true, Some(direction)) = (in_front, t.try_normalize(1e-12)) {
            let rotation = motion.cam2_from_cam1.rotation.to_rotation_matrix();
            offer(RelativePose::new(rotation.into_inner(), direction, k1, k2));
        }
    }
    best.map(|(_, pose)| pose)
}

pub(super) fn median_angle(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    motion: &RigidTransform,
    inliers: &[bool],
) -> Option<f64> {
    let mut angles: Vec<f64> = pixels1
        .iter()
        .zip(pixels2)
        .zip(inliers)
        .filter(|(_, inlier)| **inlier)
        .map(|((p1, p2), _)| {
            let (r1, r2) = (motion.rotation * k1.ray(p1), k2.ray(p2));
            libm::atan2(r1.cross(&r2).norm(), r1.dot(&r2))
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    angles.get(angles.len() / 2).copied()
}
