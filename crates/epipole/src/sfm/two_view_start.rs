//! Which matches of two photographs belong together, and how the cameras moved between them.

use super::options::{SfmOptions, lenses, pair_ransac};
use super::reconstruction::SfmImage;
use super::tracks::PairMatches;
use super::verify_rays::verify_rays;
use super::views::Views;
use crate::camera::{Intrinsics, Lens, RigidTransform};
use crate::epipolar::estimate_relative_pose;
use crate::homography::estimate_homography;
use crate::progress::{Monitor, Stage, report};
use crate::robust::RansacOptions;
use crate::two_view::{TwoViewOptions, find_explaining_turn, find_turn_and_focal};
use crate::{Error, Result};
use nalgebra::Point2;

/// A pair of images whose matches passed the test of epipolar geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct VerifiedPair {
    /// The matches that passed.
    pub pair: PairMatches,
    /// How the camera moved; |t| = 1.
    pub cam2_from_cam1: RigidTransform,
    /// Median angle between the two rays of a match, radians: small for pure rotations and far
    /// scenes, where the start of a reconstruction would be ill-conditioned. 0 if they show a plane and a pure
    /// rotation explains them, by the focal length given or by another one.
    pub median_angle_rad: f64,
    /// A homography explains most matches: the scene is flat or the camera only turned. A pair
    /// that shows depth makes the safer start.
    pub is_flat: bool,
}

/// The matches of two photographs that agree with one motion of the camera; `None` if too few do.
///
/// * `pair`: matches of the photographs' keypoints
/// * `images`, `intrinsics`: of the two photographs that the pair names
/// * `options`: [`SfmOptions::ransac`], [`SfmOptions::min_num_inliers`], [`SfmOptions::lenses`] and the
///   seed
///
/// # Errors
/// [`Error::OutOfRange`] if a match refers to a keypoint that is not there.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
pub fn verify_matches(
    pair: &PairMatches,
    images: [&SfmImage; 2],
    intrinsics: [&Intrinsics; 2],
    options: &SfmOptions,
) -> Result<Option<VerifiedPair>> {
    let counts = images.map(|image| image.keypoints.len());
    if let Some(&(i, j)) =
        (pair.matches.iter()).find(|(i, j)| *i as usize >= counts[0] || *j as usize >= counts[1])
    {
        return Err(Error::OutOfRange {
            what: "the keypoint of a match",
            requirement: "the index of one that its image has",
            value: f64::from(if i as usize >= counts[0] { i } else { j }),
        });
    }
    let images = images.map(Clone::clone);
    let intrinsics = intrinsics.map(|k| *k);
    let of_each = lenses(&images, options);
    of_each.iter().try_for_each(Lens::check)?;
    let views = Views::new(&images, &intrinsics, &of_each);
    // The two are all the images that there are.
    let here = PairMatches {
        image1: 0,
        image2: 1,
        matches: pair.matches.clone(),
    };
    let found = verify_pair(
        &here,
        &views,
        &intrinsics,
        &pair_ransac(options),
        options.min_num_inliers,
    );
    Ok(found.map(|found| VerifiedPair {
        pair: PairMatches {
            matches: found.pair.matches,
            ..*pair
        },
        ..found
    }))
}

/// Tests all pairs; shares are of the pairs, in the one stage [`Stage::PairVerification`].
///
/// * `views`, `intrinsics`: of all images
pub(super) fn verify_pairs(
    pairs: &[PairMatches],
    views: &Views,
    intrinsics: &[Intrinsics],
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<VerifiedPair>> {
    let ransac = pair_ransac(options);
    let mut verified = Vec::new();
    let mut done = 0;
    for group in pairs.chunks(VERIFIED_AT_ONCE) {
        let mut found: Vec<Option<VerifiedPair>> = vec![None; group.len()];
        crate::optim::parallel::for_each_chunk(&mut found, 1, |n, found| {
            let needed = options.min_num_inliers;
            found[0] = verify_pair(&group[n], views, intrinsics, &ransac, needed);
        });
        verified.extend(found.into_iter().flatten());
        done += group.len();
        let share = done as f32 / pairs.len() as f32;
        report(monitor, Stage::PairVerification, share)?;
    }
    Ok(verified)
}

/// Pairs between two reports of progress.
const VERIFIED_AT_ONCE: usize = 8;

/// Keeps the matches that agree with one motion of the camera; `None` if too few do.
///
/// * `views`, `intrinsics`: of all images
pub(super) fn verify_pair(
    pair: &PairMatches,
    views: &Views,
    intrinsics: &[Intrinsics],
    options: &RansacOptions,
    min_num_inliers: usize,
) -> Option<VerifiedPair> {
    let both = [pair.image1, pair.image2];
    let intrinsics = both.map(|image| &intrinsics[image]);
    let pixels = match views {
        Views::Pinhole(pixels) => both.map(|image| &pixels[image][..]),
        Views::Rays(seen) => {
            let seen = both.map(|image| &seen[image][..]);
            return verify_rays(pair, seen, intrinsics, options, min_num_inliers);
        }
    };
    if pair.matches.len() < min_num_inliers.max(5) {
        return None;
    }
    let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
    for &(i, j) in &pair.matches {
        pixels1.push(pixels[0][i as usize]);
        pixels2.push(pixels[1][j as usize]);
    }
    // Without consensus the two photographs simply do not overlap.
    let report = estimate_relative_pose(
        &pixels1,
        &pixels2,
        intrinsics[0],
        intrinsics[1],
        options,
        &mut (),
    )
    .ok()?;
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
        // Head on is as bad as parallel.
        angles.push(libm::acos(ray1.dot(&ray2).abs().min(1.0)));
        matches.push(pair.matches[n]);
    }
    angles.sort_by(f64::total_cmp);
    let chosen = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        let inlier = |n: &usize| report.inliers[*n];
        (0..pixels.len())
            .filter(inlier)
            .map(|n| pixels[n])
            .collect()
    };
    let (pixels1, pixels2) = (chosen(&pixels1), chosen(&pixels2));
    let few = RansacOptions {
        max_iterations: 500,
        ..options.within(report.max_error_px)
    };
    // The share that makes two views planar makes a pair flat.
    let judging = TwoViewOptions {
        ransac: few,
        ..TwoViewOptions::default()
    };
    let flat = estimate_homography(&pixels1, &pixels2, &few, &mut ()).ok();
    let flat = flat.filter(|flat| {
        flat.num_inliers as f64 > judging.max_homography_share * matches.len() as f64
    });
    // What a turn explains has no depth, and by a wrong focal length a turn passes for a plane.
    let only_turned = flat.as_ref().is_some_and(|flat| {
        let ([k1, k2], inliers) = (intrinsics, &flat.inliers);
        find_explaining_turn(&pixels1, &pixels2, k1, k2, inliers, &judging)
            .is_ok_and(|turn| turn.is_some())
            || find_turn_and_focal(&pixels1, &pixels2, k1, k2, inliers, &judging)
                .is_ok_and(|turn| turn.is_some())
    });
    let median_angle_rad = match only_turned {
        true => 0.0,
        false => angles.get(angles.len() / 2).copied().unwrap_or(0.0),
    };
    Some(VerifiedPair {
        pair: PairMatches { matches, ..*pair },
        cam2_from_cam1,
        median_angle_rad,
        is_flat: flat.is_some(),
    })
}
