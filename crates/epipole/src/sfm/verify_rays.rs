//! Verification of matches seen through lenses beyond Brown's model: by rays.

use super::tracks::PairMatches;
use super::two_view_start::VerifiedPair;
use crate::camera::{Intrinsics, Observation};
use crate::epipolar::estimate_relative_pose_of_rays;
use crate::robust::RansacOptions;
use crate::two_view::{
    TwoViewOptions, find_explaining_turn_of_rays, find_turn_and_focal, plane_of_rays,
};
use nalgebra::Point2;

/// The cosine of 50°: a lens that sees no farther off its axis is near enough to a pinhole camera.
const NARROW: f64 = 0.642_787_609_686_539_3;

/// As [`verify_pair`](super::two_view_start::verify_pair), from rays.
pub(super) fn verify_rays(
    pair: &PairMatches,
    seen: [&[Option<Observation>]; 2],
    intrinsics: [&Intrinsics; 2],
    options: &RansacOptions,
    min_num_inliers: usize,
) -> Option<VerifiedPair> {
    let (mut matches, mut seen1, mut seen2) = (Vec::new(), Vec::new(), Vec::new());
    for &(i, j) in &pair.matches {
        if let (Some(ray1), Some(ray2)) = (seen[0][i as usize], seen[1][j as usize]) {
            matches.push((i, j));
            seen1.push(ray1);
            seen2.push(ray2);
        }
    }
    if matches.len() < min_num_inliers.max(5) {
        return None;
    }
    // Without consensus the two photographs simply do not overlap.
    let report = estimate_relative_pose_of_rays(&seen1, &seen2, options, &mut ()).ok()?;
    if report.num_unique_inliers < min_num_inliers {
        return None;
    }
    let cam2_from_cam1 = report.model;
    let (mut kept, mut inliers, mut angles) = (Vec::new(), Vec::new(), Vec::new());
    for (n, _) in (report.inliers.iter().enumerate()).filter(|(_, inlier)| **inlier) {
        let turned = cam2_from_cam1.rotation * seen1[n].ray();
        // Head on is as bad as parallel.
        angles.push(libm::acos(turned.dot(&seen2[n].ray()).abs().min(1.0)));
        inliers.push([seen1[n], seen2[n]]);
        kept.push(matches[n]);
    }
    angles.sort_by(f64::total_cmp);
    let judging = TwoViewOptions::default().within(report.max_error_px);
    let flat = plane_of_rays(&inliers, &judging);
    let has_turned = find_explaining_turn_of_rays(&inliers, &judging).is_some()
        || (flat.as_ref())
            .is_some_and(|flat| turned_otherwise(&inliers, intrinsics, &flat.inliers, &judging));
    let median_angle_rad = match has_turned {
        true => 0.0,
        false => angles.get(angles.len() / 2).copied().unwrap_or(0.0),
    };
    Some(VerifiedPair {
        pair: PairMatches {
            matches: kept,
            ..*pair
        },
        cam2_from_cam1,
        median_angle_rad,
        is_flat: has_turned || flat.is_some(),
    })
}

/// Whether a turn by another focal length explains what lies on a plane. Of matches seen far to the side nothing is said:
/// [`find_turn_and_focal`] knows pinhole cameras.
fn turned_otherwise(
    inliers: &[[Observation; 2]],
    intrinsics: [&Intrinsics; 2],
    on_plane: &[bool],
    judging: &TwoViewOptions,
) -> bool {
    let straight = |side: usize| -> Option<Vec<Point2<f64>>> {
        let pixel = |pair: &[Observation; 2]| {
            let ray = pair[side].ray();
            let k = (ray.z > NARROW).then_some(intrinsics[side])?;
            k.project(&ray.into()).ok()
        };
        inliers.iter().map(pixel).collect()
    };
    let (Some(pixels1), Some(pixels2)) = (straight(0), straight(1)) else {
        return false;
    };
    let [k1, k2] = intrinsics;
    find_turn_and_focal(&pixels1, &pixels2, k1, k2, on_plane, judging)
        .is_ok_and(|turn| turn.is_some())
}
