//! The searches of `epipole two-view` where the camera is known with its lens: from rays.

use super::search::{Found, word};
use super::{Arguments, Model};
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::SeenMatches;
use crate::photo::Photo;
use crate::progress::Progress;
use crate::turn;
use epipole::camera::{Observation, RigidTransform, cross_matrix};
use epipole::epipolar::{decompose_essential, estimate_relative_pose_of_rays, sampson_px_of_rays};
use epipole::homography::estimate_homography_of_rays;
use epipole::progress::Stage;
use epipole::two_view::{
    TwoViewModel, TwoViewOptions, estimate_two_view_of_rays, find_explaining_turn_of_rays,
};
use nalgebra::{Matrix3, Point2};

impl SeenMatches {
    /// A list of all matches, from one of those that are seen.
    fn of_all<T: Clone>(&self, values: &[T], unseen: &T) -> Vec<T> {
        let mut values = values.iter();
        let place = |is_seen: &bool| match is_seen {
            true => values.next().unwrap_or(unseen).clone(),
            false => unseen.clone(),
        };
        self.is_seen.iter().map(place).collect()
    }

    /// As the core found it among the matches that are seen, for all of them.
    fn told(&self, found: Found) -> Found {
        Found {
            inliers: self.of_all(&found.inliers, &false),
            errors_px: self.of_all(&found.errors_px, &f64::INFINITY),
            ..found
        }
    }

    fn motion_errors_px(&self, motion: &RigidTransform) -> Vec<f64> {
        self.pairs()
            .map(|(a, b)| sampson_px_of_rays(motion, a, b))
            .collect()
    }

    /// Of that motion of E which a match agrees with best: where the configuration is degenerate none is chosen.
    fn essential_errors_px(&self, essential: &Matrix3<f64>) -> epipole::Result<Vec<f64>> {
        let mut least = vec![f64::INFINITY; self.rays[0].len()];
        for motion in decompose_essential(essential)? {
            for (least, error) in least.iter_mut().zip(self.motion_errors_px(&motion)) {
                *least = least.min(error);
            }
        }
        Ok(least)
    }

    /// In image 2.
    fn homography_errors_px(&self, homography: &Matrix3<f64>) -> Vec<f64> {
        let error = |(a, b): (&Observation, &Observation)| {
            let off = b.offset_px(&(homography * a.ray()));
            off.map_or(f64::INFINITY, |off| off.norm())
        };
        self.pairs().map(error).collect()
    }
}

/// Looks for the model that was asked for.
///
/// # Errors
/// As the core's searches.
pub(super) fn estimate(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels: [&[Point2<f64>]; 2],
) -> Result<Found, Failure> {
    let (seen, _) = SeenMatches::of(&arguments.camera, context, photos, pixels)?;
    let options = arguments.options(context);
    let found = match arguments.model {
        Model::Homography => homography(arguments, context, &seen, &options)?,
        Model::Essential => essential(arguments, context, &seen, &options)?,
        Model::Auto | Model::Fundamental => auto(arguments, context, &seen, &options)?,
    };
    Ok(seen.told(found))
}

fn auto(
    arguments: &Arguments,
    context: &Context,
    seen: &SeenMatches,
    options: &TwoViewOptions,
) -> Result<Found, Failure> {
    let progress = Progress::new(context, Stage::RobustEstimation.words());
    let [rays1, rays2] = &seen.rays;
    let mut monitor = |status| progress.show(status);
    let report = estimate_two_view_of_rays(rays1, rays2, options, &mut monitor)?;
    drop(progress);
    arguments.robust.warn_of_stop(
        report.stop,
        options.ransac.max_iterations,
        report.required_iterations,
        context,
    );
    let (kind, model, errors_px) = match report.model {
        TwoViewModel::Homography(h) => ("homography", h, seen.homography_errors_px(&h)),
        TwoViewModel::Essential(e) | TwoViewModel::Fundamental(e) => {
            ("essential", e, seen.essential_errors_px(&e)?)
        }
    };
    Ok(Found {
        kind,
        model,
        errors_px,
        max_error_px: report.max_error_px,
        focals_px: None,
        inliers: report.inliers,
        cam2_from_cam1: report.cam2_from_cam1,
        other_cam2_from_cam1: report.other_cam2_from_cam1,
        configuration: word(report.configuration),
    })
}

fn essential(
    arguments: &Arguments,
    context: &Context,
    seen: &SeenMatches,
    options: &TwoViewOptions,
) -> Result<Found, Failure> {
    let [rays1, rays2] = &seen.rays;
    let report = arguments.robust.watched(context, |options, monitor| {
        estimate_relative_pose_of_rays(rays1, rays2, options, monitor)
    })?;
    let motion = report.model;
    let rotation = motion.rotation.to_rotation_matrix().into_inner();
    let model = cross_matrix(&motion.translation.vector) * rotation;
    let judging = options.within(report.max_error_px);
    let (model, errors_px) = (model / model.norm(), seen.motion_errors_px(&motion));
    let words = ["essential", "general"];
    let mut found = Found::of_search(words, model, errors_px, report, options);
    if found.configuration == "degenerate" {
        return Ok(found);
    }
    found.cam2_from_cam1 = Some(motion);
    if let Some(turn) = find_explaining_turn_of_rays(&seen.inliers(&found.inliers), &judging) {
        context.warn(&turn::sentence(&turn));
        found.turned(&turn);
    }
    Ok(found)
}

fn homography(
    arguments: &Arguments,
    context: &Context,
    seen: &SeenMatches,
    options: &TwoViewOptions,
) -> Result<Found, Failure> {
    let [rays1, rays2] = &seen.rays;
    let report = arguments.robust.watched(context, |options, monitor| {
        estimate_homography_of_rays(rays1, rays2, options, monitor)
    })?;
    let judging = options.within(report.max_error_px);
    let (h, errors_px) = (report.model, seen.homography_errors_px(&report.model));
    let words = ["homography", "planar"];
    let mut found = Found::of_search(words, h, errors_px, report, options);
    if found.configuration == "planar"
        && let Some(turn) = find_explaining_turn_of_rays(&seen.inliers(&found.inliers), &judging)
    {
        found.turned(&turn);
    }
    Ok(found)
}
