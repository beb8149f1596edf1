//! The searches of `epipole pnp`.

use super::arguments::Arguments;
use super::causes::{ADVICE, MIN_POINTS, NO_FOCAL};
use crate::context::Context;
use crate::failure::Failure;
use epipole::absolute_pose::{
    estimate_absolute_pose, estimate_absolute_pose_and_focal, find_flipped_pose, fit_absolute_pose,
    pose_p4pf, reprojection_error_px,
};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use nalgebra::{Point2, Point3};

/// Minimum number of points for RANSAC; fewer leave too few to confirm a sample.
const MIN_VOTERS: usize = 6;

/// Lower bound of the pixel noise when poses are compared.
const LEAST_NOISE_PX: f64 = 0.1;

/// Maximum excess of another pose's sum of squared errors, in squared noise: three standard
/// deviations.
const FITS_AS_WELL: f64 = 9.0;

/// Mean error, in thresholds, above which there is no pose.
const NO_FIT: f64 = 10.0;

/// A fitted pose.
pub(super) struct Pose {
    pub(super) cam_from_world: RigidTransform,
    pub(super) focal_px: Option<f64>,
    /// Mean error of the inliers.
    pub(super) mean_error_px: f64,
}

/// The best pose, others that fit equally well, and the inliers.
pub(super) struct Found {
    pub(super) best: Pose,
    pub(super) others: Vec<Pose>,
    pub(super) inliers: Vec<bool>,
    pub(super) max_error_px: f64,
    pub(super) focal_std_px: Option<f64>,
}

/// Returns the errors of all points.
fn errors_px(
    camera: &Camera,
    cam_from_world: &RigidTransform,
    points: &[Point3<f64>],
    pixels: &[Point2<f64>],
) -> Vec<f64> {
    let posed = PosedCamera {
        camera: *camera,
        cam_from_world: *cam_from_world,
    };
    let pairs = points.iter().zip(pixels);
    pairs
        .map(|(x, pixel)| reprojection_error_px(&posed, x, pixel))
        .collect()
}

fn sum_sq(errors: &[f64]) -> f64 {
    errors.iter().map(|error| error * error).sum()
}

fn mean(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len().max(1) as f64
}

/// Judges the pose of few points: refuses one that misses all pixels, and warns of large errors.
fn judge_few(
    arguments: &Arguments,
    context: &Context,
    errors_px: &[f64],
) -> Result<(Vec<bool>, f64), Failure> {
    let max_error_px = arguments.robust.options(context).max_error_px;
    let mean_px = mean(errors_px);
    // The error of a point behind the camera is infinite.
    if mean_px > NO_FIT * max_error_px {
        return Err(Failure::new(
            "no-consensus",
            format!("the best pose misses the pixels by {mean_px:.1} px on average"),
        ));
    }
    if mean_px > max_error_px {
        context.warn(&format!(
            "the pixels are {mean_px:.1} px on average from where the points would be seen, and {} points are too few to \
             tell which are wrong; {ADVICE}",
            errors_px.len()
        ));
    }
    let is_inlier = |error: &f64| *error <= max_error_px.max(mean_px);
    Ok((errors_px.iter().map(is_inlier).collect(), max_error_px))
}

/// Estimates the pose of a known camera, and the second pose of a plane.
///
/// # Errors
/// As [`estimate_absolute_pose`] and [`fit_absolute_pose`].
pub(super) fn with_camera(
    arguments: &Arguments,
    context: &Context,
    points: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
) -> Result<Found, Failure> {
    let (inliers, max_error_px) = if points.len() < MIN_VOTERS {
        let pose = fit_absolute_pose(points, pixels, camera)?;
        judge_few(
            arguments,
            context,
            &errors_px(camera, &pose, points, pixels),
        )?
    } else {
        let report = arguments.robust.watched(context, |options, monitor| {
            estimate_absolute_pose(points, pixels, camera, options, monitor)
        })?;
        if report.num_inliers < MIN_POINTS {
            let (count, all) = (report.num_inliers, points.len());
            let message = format!("no pose fits more than {count} of {all} points");
            return Err(Failure::new("no-consensus", message));
        }
        if report.could_be_random() {
            context.warn(ADVICE);
        }
        (report.inliers, report.max_error_px)
    };
    let is_inlier = |n: &usize| inliers[*n];
    let points: Vec<_> = (0..points.len())
        .filter(is_inlier)
        .map(|n| points[n])
        .collect();
    let pixels: Vec<_> = (0..pixels.len())
        .filter(is_inlier)
        .map(|n| pixels[n])
        .collect();
    let judged = |cam_from_world: RigidTransform| {
        let errors = errors_px(camera, &cam_from_world, &points, &pixels);
        let pose = Pose {
            cam_from_world,
            focal_px: None,
            mean_error_px: mean(&errors),
        };
        (sum_sq(&errors), pose)
    };
    let (least, best) = judged(fit_absolute_pose(&points, &pixels, camera)?);
    let most = as_well(least, 2 * points.len(), 6);
    let flipped = find_flipped_pose(&best.cam_from_world, &points, &pixels, camera)?;
    let flipped = flipped.map(judged).filter(|(sum_sq, _)| *sum_sq <= most);
    let others: Vec<Pose> = flipped.into_iter().map(|(_, pose)| pose).collect();
    if !others.is_empty() {
        context.warn(
            "the points lie near a plane that is small or distant, and two poses fit them equally: the second is among \
             the alternatives",
        );
    }
    Ok(Found {
        best,
        others,
        inliers,
        max_error_px,
        focal_std_px: None,
    })
}

/// Returns the camera with another focal length.
///
/// # Errors
/// As [`Intrinsics::new`].
pub(super) fn with_focal_length(camera: &Camera, focal_px: f64) -> Result<Camera, Failure> {
    let center = camera.intrinsics.principal_point();
    let k = Intrinsics::new(focal_px, focal_px, center.x, center.y)?;
    Ok(Camera {
        intrinsics: k,
        ..*camera
    })
}

/// Returns the largest sum of squared errors that fits as well as the least.
fn as_well(least: f64, num_errors: usize, num_parameters: usize) -> f64 {
    let freedom = num_errors.saturating_sub(num_parameters).max(1);
    least + FITS_AS_WELL * (least / freedom as f64).max(LEAST_NOISE_PX * LEAST_NOISE_PX)
}

/// Estimates the pose and the focal length of a camera with a known principal point.
///
/// # Errors
/// As [`estimate_absolute_pose_and_focal`].
pub(super) fn with_focal(
    arguments: &Arguments,
    context: &Context,
    points: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
) -> Result<Found, Failure> {
    let center = &camera.intrinsics.principal_point();
    let camera = |focal_px| with_focal_length(camera, focal_px);
    if let (Ok(pixels4), Ok(points4)) = (
        <&[_; MIN_POINTS]>::try_from(pixels),
        <&[_; MIN_POINTS]>::try_from(points),
    ) {
        let mut found: Vec<(f64, Pose)> = Vec::new();
        for pose in &pose_p4pf(pixels4, points4, center) {
            let errors = errors_px(
                &camera(pose.focal_px)?,
                &pose.cam_from_world,
                points,
                pixels,
            );
            let pose = Pose {
                cam_from_world: pose.cam_from_world,
                focal_px: Some(pose.focal_px),
                mean_error_px: mean(&errors),
            };
            found.push((sum_sq(&errors), pose));
        }
        found.retain(|(sum_sq, _)| sum_sq.is_finite());
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found = found.into_iter();
        let Some((least, best)) = found.next() else {
            return Err(Failure::new("degenerate", NO_FOCAL));
        };
        let most = as_well(least, 8, 7);
        let others = found
            .filter(|(sum_sq, _)| *sum_sq <= most)
            .map(|(_, pose)| pose)
            .collect();
        let camera = camera(best.focal_px.unwrap_or(1.0))?;
        let errors = errors_px(&camera, &best.cam_from_world, points, pixels);
        let (inliers, max_error_px) = judge_few(arguments, context, &errors)?;
        return Ok(Found {
            best,
            others,
            inliers,
            max_error_px,
            focal_std_px: None,
        });
    }
    let report = arguments.robust.watched(context, |options, monitor| {
        estimate_absolute_pose_and_focal(points, pixels, center, options, monitor)
    })?;
    let pose = report.model;
    if report.could_be_random() {
        context.warn(ADVICE);
    }
    if !pose.constrains_focal() {
        context.warn(
            "these points hardly determine the focal length: their depths differ too little, or their plane faces the camera",
        );
    }
    let errors = errors_px(
        &camera(pose.focal_px)?,
        &pose.cam_from_world,
        points,
        pixels,
    );
    let of_inliers = errors.iter().zip(&report.inliers).filter(|(_, is)| **is);
    let of_inliers: Vec<f64> = of_inliers.map(|(error, _)| *error).collect();
    Ok(Found {
        best: Pose {
            cam_from_world: pose.cam_from_world,
            focal_px: Some(pose.focal_px),
            mean_error_px: mean(&of_inliers),
        },
        others: Vec::new(),
        inliers: report.inliers,
        max_error_px: report.max_error_px,
        focal_std_px: pose.focal_std_px,
    })
}
