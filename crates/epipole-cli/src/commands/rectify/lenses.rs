//! `epipole rectify` where the camera is known with its lens: the motion from rays, the maps through the lens.

use super::{Arguments, Found};
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::SeenMatches;
use crate::photo::Photo;
use crate::turn;
use epipole::camera::RigidTransform;
use epipole::epipolar::estimate_relative_pose_of_rays;
use epipole::stereo::rectify_calibrated;
use epipole::two_view::{TwoViewOptions, find_explaining_turn_of_rays};
use nalgebra::Point2;

/// * `pixels`: of the matches, in both photographs
///
/// # Errors
/// As the core's search for the motion and its rectification.
pub(super) fn rectify(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels: [&[Point2<f64>]; 2],
) -> Result<Found, Failure> {
    let (seen, intrinsics) = SeenMatches::of(&arguments.camera, context, photos, pixels)?;
    let [rays1, rays2] = &seen.rays;
    let report = arguments.robust.watched(context, |options, monitor| {
        estimate_relative_pose_of_rays(rays1, rays2, options, monitor)
    })?;
    let judging = TwoViewOptions {
        ransac: (arguments.robust.options(context)).within(report.max_error_px),
        ..TwoViewOptions::default()
    };
    if let Some(turn) = find_explaining_turn_of_rays(&seen.inliers(&report.inliers), &judging) {
        context.warn(&turn::sentence(&turn));
    }

    let motion = report.model;
    let cam2_from_cam1 = RigidTransform::from_parts(
        (motion.translation.vector.normalize() * arguments.baseline_m).into(),
        motion.rotation,
    );
    let cameras = [0, 1].map(|n| photos[n].camera(intrinsics[n]));
    let options = arguments.shape();
    let rectification = rectify_calibrated(&cameras, &cam2_from_cam1, &options)?;
    Ok(Found {
        homographies: rectification.homographies,
        maps: [rectification.map(0)?, rectification.map(1)?],
        q: Some(rectification.q),
        num_inliers: Some(report.num_inliers),
    })
}
