//! What reconstruction needs of lenses beyond Brown's model. It is reached through [`WIDE`] alone, which a lens of such
//! a model brings along: without one it is no part of a program.

use super::bundle::{Bundle, BundleOptions, adjust_wide};
use super::lens::SfmLens;
use super::reconstruction::SfmImage;
use super::tracks::PairMatches;
use super::two_view_start::VerifiedPair;
use crate::Result;
use crate::absolute_pose::estimate_absolute_pose_of_rays;
use crate::camera::{Intrinsics, Lens, LensKind, MAX_COEFFICIENTS, RigidTransform, SeenRay};
use crate::epipolar::estimate_relative_pose_of_rays;
use crate::optim::{Iteration, LmReport};
use crate::robust::{RansacOptions, RansacReport};
use crate::two_view::{
    TwoViewOptions, find_explaining_turn_of_rays, find_turn_and_focal, plane_of_rays,
};
use nalgebra::{Matrix2x3, Point2, Point3, Vector3};
use std::ops::ControlFlow;

type Numbers = [f64; MAX_COEFFICIENTS];
/// The rays of the keypoints of each image; `None` where its lens sees none.
pub(super) type SeenRays = Vec<Vec<Option<SeenRay>>>;
type Derivatives = fn(LensKind, &Numbers, &Vector3<f64>) -> (Matrix2x3<f64>, [Numbers; 2]);
type Adjust = fn(
    &mut Bundle,
    &BundleOptions,
    &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<LmReport>;
type Verify = fn(
    &PairMatches,
    [&[Option<SeenRay>]; 2],
    [&Intrinsics; 2],
    &RansacOptions,
    usize,
) -> Option<VerifiedPair>;
type Register =
    fn(&[Point3<f64>], &[SeenRay], &RansacOptions) -> Result<RansacReport<RigidTransform>>;

/// Functions that only lenses beyond Brown's model call.
pub(super) struct Wide {
    /// As [`SfmLens::shown`].
    pub(super) shown: fn(LensKind, &Numbers, &Vector3<f64>) -> Point2<f64>,
    /// The derivatives of it by the point and by the coefficients.
    pub(super) derivatives: Derivatives,
    pub(super) rays: fn(&[SfmImage], &[Intrinsics], &[SfmLens]) -> SeenRays,
    pub(super) verify: Verify,
    pub(super) register: Register,
    /// Bundle adjustment with room for the coefficients of every model.
    pub(super) adjust: Adjust,
}

pub(super) static WIDE: Wide = Wide {
    shown,
    derivatives: |kind, numbers, p| Lens::of(kind, *numbers).derivatives(p),
    rays,
    verify,
    register: estimate_absolute_pose_of_rays,
    adjust: adjust_wide,
};

/// The cosine of 50°: a lens that sees no farther off its axis is near enough to a pinhole camera.
const NARROW: f64 = 0.642_787_609_686_539_3;

fn shown(kind: LensKind, numbers: &Numbers, p: &Vector3<f64>) -> Point2<f64> {
    let flat = || Point2::new(p.x / p.z, p.y / p.z);
    match Lens::of(kind, *numbers) {
        Lens::Brown(lens) => lens.distort(&flat()),
        Lens::Rational(lens) => lens.distort(&flat()),
        Lens::Division(lens) => lens.distort(&flat()),
        Lens::Fisheye(lens) => (lens.project(p)).unwrap_or(Point2::new(f64::NAN, f64::NAN)),
    }
}

/// The rays of all keypoints. Keypoints beyond what a lens model bends rays to have none.
fn rays(images: &[SfmImage], intrinsics: &[Intrinsics], lenses: &[SfmLens]) -> SeenRays {
    let mut rays: SeenRays = vec![Vec::new(); images.len()];
    crate::optim::parallel::for_each_chunk(&mut rays, 1, |index, rays| {
        let (k, lens) = (&intrinsics[index], lenses[index].to_lens());
        let seen = |pixel| SeenRay::through(&lens, k, pixel).ok();
        rays[0] = images[index].keypoints.iter().map(seen).collect();
    });
    rays
}

/// As `verify_pair`, from rays.
fn verify(
    pair: &PairMatches,
    seen: [&[Option<SeenRay>]; 2],
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
    let report = estimate_relative_pose_of_rays(&seen1, &seen2, options).ok()?;
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
    inliers: &[[SeenRay; 2]],
    intrinsics: [&Intrinsics; 2],
    on_plane: &[bool],
    judging: &TwoViewOptions,
) -> bool {
    let straight = |side: usize| -> Option<Vec<Point2<f64>>> {
        let pixel = |pair: &[SeenRay; 2]| {
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
