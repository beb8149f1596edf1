//! Choice of the model for two views.

use super::explaining_rotation::{ExplainingRotation, homography_of_rotation};
use super::motion::{median_angle, planar_motions, pose_of_fundamental};
use super::pairs::Pairs;
use super::report::{Configuration, TwoViewModel, TwoViewReport};
use super::search::Searches;
use super::through_lenses::estimate_through_lenses;
use super::{RotationEstimator, TwoViewOptions};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::Camera;
#[cfg(doc)]
use crate::epipolar::estimate_fundamental;
use crate::epipolar::{FundamentalEstimator, RelativePose, estimate_relative_pose};
use crate::homography::HomographyEstimator;
#[cfg(doc)]
use crate::homography::estimate_homography;
use crate::progress::Monitor;
#[cfg(doc)]
use crate::robust::RansacOptions;
use crate::robust::{MatchSet, RansacReport};
use nalgebra::{Matrix3, Point2};

/// Chooses between F and H for two views of unknown intrinsics.
///
/// Estimates both; if H explains nearly all matches that F does, the scene is a plane or the camera
/// only rotated.
///
/// # Errors
/// As [`TwoViewOptions::check`], and as [`estimate_fundamental`] and [`estimate_homography`] if
/// neither finds a model.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view};
/// use nalgebra::Point2;
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// // A step to the right past a frontal wall: everything moves by 12 pixels.
/// let wall: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 12.0, p.y)).collect();
/// let report = estimate_two_view(&p1, &wall, &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::Planar);
/// // With depth, near objects move more than far ones.
/// let depth: Vec<_> = (0..60).map(|i| Point2::new(p1[i].x - (5 + i * 13 % 31) as f64, p1[i].y)).collect();
/// let report = estimate_two_view(&p1, &depth, &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::General);
/// # Ok(()) }
/// ```
pub fn estimate_two_view(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    options.check()?;
    let set = MatchSet::new(pixels1, pixels2)?;
    let pairs = Pairs::new(pixels1, pixels2, &set);
    let mut searches = Searches::new(monitor);
    let options = &searches.with_threshold(options, &set);
    let fundamental = searches.ransac(FundamentalEstimator::new(set.clone()), &options.ransac);
    let homography = searches.ransac(
        HomographyEstimator::new(set.clone()),
        &options.in_two_dimensions(),
    );
    let homography_wins = match (&fundamental, &homography) {
        // H needs fewer matches than F, so an error of H also applies to F.
        (Err(_), Err(error)) => return Err(error.clone()),
        (Err(_), Ok(_)) => true,
        (Ok(_), Err(_)) => false,
        (Ok(f), Ok(h)) => {
            f.could_be_random() && !h.could_be_random()
                || pairs.explained_ratio(&h.model, &f.inliers, options)
                    >= options.max_homography_ratio
        }
    };
    searches.check()?;
    let mut found = TwoViewReport::nothing(searches.iterations, options);
    found.homography = homography.as_ref().ok().map(|report| report.model);
    if homography_wins {
        let report = homography?;
        found.model = TwoViewModel::Homography(report.model);
        found.configuration = Configuration::Planar;
        found.take_homography(&pairs, &report, options);
    } else {
        let report = fundamental?;
        found.model = TwoViewModel::Fundamental(report.model);
        found.configuration = Configuration::General;
        found.fundamental = Some(report.model);
        found.take(report.inliers.clone(), &report, options);
    }
    Ok(found)
}

/// Chooses among E, F and H for two views of known intrinsics, and estimates the motion.
///
/// * `cameras`: the two cameras, with any lens. If the intrinsics of pinhole cameras are wrong, F
///   explains more matches than E and is chosen
///
/// The camera only rotated if a rotation explains nearly all matches of the best other model. If F
/// is chosen, the motion is still that of E, if enough matches support it: it is the best motion
/// that agrees with the intrinsics. For a plane the motion comes from E or from the decomposition
/// of H, whichever fits more matches with the points in front of both cameras; often two motions
/// fit equally well.
///
/// Lenses other than pinholes have no F: [`TwoViewReport::model`] and [`TwoViewReport::homography`]
/// then apply to rays ([`TwoViewReport::is_of_rays`]), `x2ᵀ E x1 = 0` and `x2 ∝ H x1`, and errors
/// are in pixels of the distorted images.
///
/// # Errors
/// As [`TwoViewOptions::check`], and as [`estimate_relative_pose`] and [`estimate_homography`] if
/// no model is found.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_calibrated};
/// use nalgebra::{Point2, Rotation3, Vector3};
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// let rotation = Rotation3::from_scaled_axis(Vector3::new(0.0, 0.1, 0.0));
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| {
///     let x = k.matrix() * (rotation * k.ray(p));
///     Point2::new(x.x / x.z, x.y / x.z)
/// }).collect();
/// let camera = Camera::pinhole(k, 640, 480);
/// let report = estimate_two_view_calibrated(&p1, &p2, [&camera; 2], &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::Panoramic);
/// assert!((report.cam2_from_cam1.unwrap().rotation.angle() - 0.1).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_two_view_calibrated(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    options.check()?;
    if !Camera::are_pinholes(cameras) {
        return estimate_through_lenses(pixels1, pixels2, cameras, options, monitor);
    }
    let [k1, k2] = cameras.map(|camera| &camera.intrinsics);
    let set = MatchSet::new(pixels1, pixels2)?;
    let pairs = Pairs::new(pixels1, pixels2, &set);
    let mut searches = Searches::new(monitor);
    let options = &searches.with_threshold(options, &set);
    let in_two_dimensions = options.in_two_dimensions();
    let essential = searches
        .run(|monitor| estimate_relative_pose(pixels1, pixels2, cameras, &options.ransac, monitor));
    let fundamental = searches.ransac(FundamentalEstimator::new(set.clone()), &options.ransac);
    let homography = searches.ransac(HomographyEstimator::new(set.clone()), &in_two_dimensions);
    let rotation = searches.ransac(
        RotationEstimator::new(set.clone(), cameras),
        &in_two_dimensions,
    );
    searches.check()?;
    let mut found = TwoViewReport::nothing(searches.iterations, options);
    found.homography = homography.as_ref().ok().map(|report| report.model);
    let (num_e, num_f) = (support(&essential), support(&fundamental));
    let epipolar = if num_e > num_f {
        essential.as_ref().ok().map(|report| &report.inliers)
    } else {
        fundamental.as_ref().ok().map(|report| &report.inliers)
    };
    let explains = |matrix: &Matrix3<f64>| {
        epipolar.is_none_or(|inliers| {
            pairs.explained_ratio(matrix, inliers, options) >= options.max_homography_ratio
        })
    };
    // A homography may explain more than a rotation, even if no epipolar geometry was found.
    let num_needed = options.max_homography_ratio * support(&homography) as f64;
    if let Ok(report) = &rotation
        && report.num_unique_inliers as f64 >= num_needed
        && let Some(explaining) = ExplainingRotation::new(
            report,
            [k1, k2],
            epipolar.iter().flat_map(|mask| pairs.different_among(mask)),
            options,
        )
    {
        let matrix = homography_of_rotation(&report.model, [k1, k2]);
        found.model = TwoViewModel::Homography(matrix / matrix.norm());
        found.configuration = Configuration::Panoramic;
        found.cam2_from_cam1 = Some(explaining.cam2_from_cam1);
        found.take_homography(&pairs, report, options);
        return Ok(found);
    }
    if let Ok(report) = &homography
        && explains(&report.model)
    {
        found.model = TwoViewModel::Homography(report.model);
        found.configuration = Configuration::Planar;
        let [best, other] = planar_motions(
            &pairs,
            k1,
            k2,
            report,
            essential.as_ref().ok(),
            options.ransac.max_error_px,
        );
        found.cam2_from_cam1 = best.as_ref().map(RelativePose::cam2_from_cam1);
        found.other_cam2_from_cam1 = other.as_ref().map(RelativePose::cam2_from_cam1);
        found.fundamental = best.and_then(|pose| pose.fundamental(k1, k2).ok());
        found.take_homography(&pairs, report, options);
    } else if num_e as f64 >= options.min_essential_ratio * num_f as f64
        && let Ok(report) = &essential
    {
        found.model = TwoViewModel::Essential(report.model.essential());
        found.configuration = Configuration::General;
        found.cam2_from_cam1 = Some(report.model.cam2_from_cam1());
        found.fundamental = report.model.fundamental(k1, k2).ok();
        found.take(report.inliers.clone(), report, options);
    } else {
        // H needs fewer matches than F, so an error of H also applies to F.
        let report = fundamental.map_err(|error| homography.err().unwrap_or(error))?;
        found.model = TwoViewModel::Fundamental(report.model);
        found.configuration = Configuration::General;
        found.fundamental = Some(report.model);
        // E's motion was fitted with the intrinsics. F's, which must be projected onto them, is far
        // less exact, especially where F has fitted outliers that E rejected.
        found.cam2_from_cam1 = match &essential {
            Ok(essential) if num_e >= options.min_num_inliers && !essential.could_be_random() => {
                Some(essential.model.cam2_from_cam1())
            }
            _ => pose_of_fundamental(&pairs, k1, k2, &report),
        };
        found.take(report.inliers.clone(), &report, options);
    }
    if let Some(motion) = &found.cam2_from_cam1 {
        found.median_triangulation_angle_rad = median_angle(&pairs, k1, k2, motion, &found.inliers);
    }
    Ok(found)
}

fn support<M>(report: &Result<RansacReport<M>>) -> usize {
    report
        .as_ref()
        .map_or(0, |report| report.num_unique_inliers)
}
