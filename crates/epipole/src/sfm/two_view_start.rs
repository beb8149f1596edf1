//! Two-view geometric verification of matches.

use super::options::{SfmOptions, pair_ransac};
use super::reconstruction::SfmImage;
use super::tracks::PairMatches;
use super::views::Views;
use crate::camera::{Camera, RigidTransform};
use crate::epipolar::estimate_relative_pose;
use crate::feature::Match;
use crate::homography::estimate_homography;
use crate::progress::{Monitor, Part, Stage, report};
use crate::robust::{RansacOptions, RansacReport};
use crate::two_view::{
    TwoViewOptions, find_explaining_rotation, find_plane_through_lenses, find_rotation_and_focal,
};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// A geometrically verified pair of images.
#[derive(Debug, Clone, PartialEq)]
pub struct VerifiedPair {
    /// Matches that agree with the motion.
    pub pair: PairMatches,
    /// Motion of the camera; |t| = 1.
    pub cam2_from_cam1: RigidTransform,
    /// Median angle between the two rays of a match, radians: small for pure rotations and far
    /// scenes, where an initialization would be ill-conditioned. 0 if the matches fit a plane and a
    /// pure rotation explains them, with the given focal length or another one.
    pub median_angle_rad: f64,
    /// A homography explains most matches: the scene is flat or the camera only rotated. A pair
    /// with depth is a safer start.
    pub is_flat: bool,
}

/// Finds the matches of two images that agree with one motion of the camera; `None` if too few do.
///
/// * `pair`: matches between the images' keypoints
/// * `images`, `cameras`: the two images of the pair and their cameras
/// * `options`: [`SfmOptions::ransac`], [`SfmOptions::min_num_inliers`] and the seed
/// * `monitor`: notified by the searches, in the only stage, [`Stage::PairVerification`]
///
/// # Errors
/// [`Error::Canceled`]; [`Error::OutOfRange`] if a match refers to a missing keypoint,
/// [`Error::NotFinite`] for a lens coefficient that is not finite.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
pub fn verify_matches(
    pair: &PairMatches,
    images: [&SfmImage; 2],
    cameras: [&Camera; 2],
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<VerifiedPair>> {
    let counts = images.map(|image| image.keypoints.len());
    let is_absent = |found: &&Match| found.index1 >= counts[0] || found.index2 >= counts[1];
    if let Some(found) = pair.matches.iter().find(is_absent) {
        return Err(Error::OutOfRange {
            what: "the keypoint of a match",
            requirement: "the index of one that its image has",
            value: match found.index1 >= counts[0] {
                true => found.index1 as f64,
                false => found.index2 as f64,
            },
        });
    }
    let images = images.map(Clone::clone);
    (cameras.iter()).try_for_each(|camera| camera.lens.check())?;
    let views = Views::new(&images, &cameras.map(|camera| *camera));
    // The pair refers to the two images given.
    let here = PairMatches {
        image1: 0,
        image2: 1,
        matches: pair.matches.clone(),
    };
    let found = verify_pair(
        &here,
        &views,
        &pair_ransac(options),
        options.min_num_inliers,
        &mut Part::new(monitor, 0.0, 1.0).of_stage(Stage::PairVerification),
    )?;
    Ok(found.map(|found| VerifiedPair {
        pair: PairMatches {
            matches: found.pair.matches,
            ..*pair
        },
        ..found
    }))
}

/// Verifies all pairs; progress is by pairs, in the only stage, [`Stage::PairVerification`].
///
/// * `views`: views of all images
pub(super) fn verify_pairs(
    pairs: &[PairMatches],
    views: &Views,
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<VerifiedPair>> {
    let ransac = pair_ransac(options);
    let mut verified = Vec::new();
    let mut done = 0;
    for group in pairs.chunks(VERIFIED_AT_ONCE) {
        let mut found: Vec<Option<VerifiedPair>> = vec![None; group.len()];
        crate::math::parallel::for_each_chunk(&mut found, 1, |n, found| {
            let needed = options.min_num_inliers;
            // Without a monitor nothing cancels the search.
            found[0] = verify_pair(&group[n], views, &ransac, needed, &mut ()).unwrap_or(None);
        });
        verified.extend(found.into_iter().flatten());
        done += group.len();
        let fraction = done as f32 / pairs.len() as f32;
        report(monitor, Stage::PairVerification, fraction)?;
    }
    Ok(verified)
}

/// Number of pairs between two progress reports.
const VERIFIED_AT_ONCE: usize = 8;

/// Keeps the matches that agree with one motion of the camera; `None` if too few do.
///
/// * `views`: views of all images
pub(super) fn verify_pair(
    pair: &PairMatches,
    views: &Views,
    options: &RansacOptions,
    min_num_inliers: usize,
    monitor: &mut dyn Monitor,
) -> Result<Option<VerifiedPair>> {
    let both = [pair.image1, pair.image2];
    let cameras = both.map(|image| &views.cameras[image]);
    if pair.matches.len() < min_num_inliers.max(5) {
        return Ok(None);
    }
    let pixels = both.map(|image| &views.pixels[image][..]);
    let pixels1: Vec<_> = (pair.matches.iter())
        .map(|found| pixels[0][found.index1])
        .collect();
    let pixels2: Vec<_> = (pair.matches.iter())
        .map(|found| pixels[1][found.index2])
        .collect();
    // Without consensus the two images simply do not overlap.
    let search = &mut Part::new(monitor, 0.0, 0.6);
    let report = unless_canceled(estimate_relative_pose(
        &pixels1, &pixels2, cameras, options, search,
    ))?;
    let Some(report) = report.filter(|found| found.num_unique_inliers >= min_num_inliers) else {
        return Ok(None);
    };
    let cam2_from_cam1 = report.model.cam2_from_cam1();
    let inliers = (0..pixels1.len()).filter(|&n| report.inliers[n]);
    let matches: Vec<_> = inliers.clone().map(|n| pair.matches[n]).collect();
    let pixels1: Vec<_> = inliers.clone().map(|n| pixels1[n]).collect();
    let pixels2: Vec<_> = inliers.map(|n| pixels2[n]).collect();
    let mut angles = Vec::new();
    for (p1, p2) in pixels1.iter().zip(&pixels2) {
        let (Ok(ray1), Ok(ray2)) = (cameras[0].unproject(p1), cameras[1].unproject(p2)) else {
            return Ok(None);
        };
        let ray1 = cam2_from_cam1.rotation * ray1;
        // Opposite rays are as bad as parallel ones.
        angles.push(libm::acos(ray1.dot(&ray2).abs().min(1.0)));
    }
    angles.sort_by(f64::total_cmp);
    // The ratio that makes two views planar makes a pair flat.
    let judging = TwoViewOptions {
        ransac: RansacOptions {
            max_iterations: MAX_SAMPLES,
            ..options.within(report.max_error_px)
        },
        ..TwoViewOptions::default()
    };
    let rest = &mut Part::new(monitor, 0.6, 1.0);
    let flat = find_plane(&pixels1, &pixels2, cameras, &judging, rest)?;
    // A rotation gives no depth, and with a wrong focal length it passes for a plane.
    let rotation_only = flat.as_ref().is_some_and(|flat| {
        find_explaining_rotation(&pixels1, &pixels2, cameras, &flat.inliers, &judging)
            .is_ok_and(|rotation| rotation.is_some())
            || is_rotation_with_other_focal([&pixels1, &pixels2], cameras, &flat.inliers, &judging)
    });
    let median_angle_rad = match rotation_only {
        true => 0.0,
        false => angles.get(angles.len() / 2).copied().unwrap_or(0.0),
    };
    Ok(Some(VerifiedPair {
        pair: PairMatches { matches, ..*pair },
        cam2_from_cam1,
        median_angle_rad,
        is_flat: flat.is_some(),
    }))
}

/// Converts any error except cancellation to `None`.
fn unless_canceled<T>(found: Result<T>) -> Result<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Error::Canceled) => Err(Error::Canceled),
        Err(_) => Ok(None),
    }
}

/// Maximum number of samples in the search for a plane or rotation among inliers.
const MAX_SAMPLES: usize = 500;

/// Finds the homography that explains nearly all inliers of a motion, if any.
fn find_plane(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    judging: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<RansacReport<Matrix3<f64>>>> {
    if !Camera::are_pinholes(cameras) {
        return Ok(find_plane_through_lenses(
            pixels1, pixels2, cameras, judging,
        ));
    }
    let search = estimate_homography(pixels1, pixels2, &judging.ransac, monitor);
    let needed = judging.max_homography_ratio * pixels1.len() as f64;
    Ok(unless_canceled(search)?.filter(|flat| flat.num_inliers as f64 > needed))
}

/// Returns whether a rotation with another focal length explains matches on a plane.
fn is_rotation_with_other_focal(
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    cameras: [&Camera; 2],
    on_plane: &[bool],
    judging: &TwoViewOptions,
) -> bool {
    find_rotation_and_focal(pixels1, pixels2, cameras, on_plane, judging)
        .is_ok_and(|rotation| rotation.is_some())
}
