//! Verdict on the configuration of a pair, from its matches.

use epipole::Error;
use epipole::camera::{Camera, RigidTransform};
use epipole::robust::RansacOptions;
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view_calibrated,
    find_rotation_and_focal,
};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Minimum number of matches for a verdict.
pub(crate) const MIN_NUM_MATCHES: usize = 15;
/// Minimum accepted median triangulation angle of the inliers, degrees.
const MIN_MEDIAN_ANGLE_DEG: f64 = 0.75;
/// Minimum inlier gain of a rotation-only model with another focal length for reporting it.
const MIN_GAIN: f64 = 1.05;

/// Configuration of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Verdict {
    /// A motion and a scene with depth.
    Good,
    /// A motion, but a plane explains most matches.
    Plane,
    /// A motion, but an uncalibrated model explains more matches.
    Lens,
    /// Too few matches to estimate anything.
    TooFew,
    /// No model is supported by enough matches.
    NoConsensus,
    /// Rotation only, by this angle in degrees.
    Turned(f64),
    /// Rotation only, if the focal length is a different one.
    OrientationMismatch {
        /// Rotation angle, degrees.
        angle_deg: f64,
        /// Factor on the given focal length.
        focal_factor: f64,
    },
    /// Too small a motion: rays intersect at this median angle in degrees.
    Narrow(f64),
}

/// A verdict with its evidence.
pub(super) struct Judged {
    pub(super) verdict: Verdict,
    /// Inlier mask over the matches.
    pub(super) inliers: Vec<bool>,
    /// Relative pose, if points can be triangulated.
    pub(super) cam2_from_cam1: Option<RigidTransform>,
    pub(super) median_angle_deg: f64,
}

/// Judges matches; inliers are at most `max_error_px` from their epipolar lines.
///
/// # Errors
/// For values that are not finite; a lack of consensus is a verdict, not an error.
pub(super) fn judge(
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    cameras: &[Camera; 2],
    max_error_px: f64,
) -> Result<Judged, Error> {
    let nothing = |verdict| Judged {
        verdict,
        inliers: vec![false; pixels1.len()],
        cam2_from_cam1: None,
        median_angle_deg: 0.0,
    };
    if pixels1.len() < MIN_NUM_MATCHES {
        return Ok(nothing(Verdict::TooFew));
    }
    let options = TwoViewOptions::default()
        .with_ransac(RansacOptions::default().with_max_error_px(max_error_px))
        .with_min_num_inliers(MIN_NUM_MATCHES);
    options.ransac.check()?;
    let report: TwoViewReport =
        match estimate_two_view_calibrated(pixels1, pixels2, cameras.each_ref(), &options, &mut ())
        {
            Ok(report) => report,
            // Wrong matches give no consensus, and coincident matches determine no model.
            Err(
                Error::NoConsensus { .. }
                | Error::Degenerate { .. }
                | Error::TooFew { .. }
                | Error::TooFewDistinct { .. },
            ) => {
                return Ok(nothing(Verdict::NoConsensus));
            }
            Err(error) => return Err(error),
        };
    let median_angle_deg = (report.median_triangulation_angle_rad).map_or(0.0, f64::to_degrees);
    let turn_deg =
        (report.cam2_from_cam1).map_or(0.0, |motion| motion.rotation.angle().to_degrees());
    let fundamental_won = matches!(report.model, TwoViewModel::Fundamental(_));
    let seen = match report.configuration {
        // The inliers of a degenerate model are meaningless.
        Configuration::Degenerate => return Ok(nothing(Verdict::NoConsensus)),
        Configuration::Panoramic => Verdict::Turned(turn_deg),
        _ if median_angle_deg < MIN_MEDIAN_ANGLE_DEG => Verdict::Narrow(median_angle_deg),
        Configuration::Planar => Verdict::Plane,
        Configuration::General if fundamental_won => Verdict::Lens,
        Configuration::General => Verdict::Good,
    };
    let otherwise = turned_otherwise([pixels1, pixels2], cameras, &report, &options)?;
    let (verdict, inliers) = otherwise.unwrap_or((seen, report.inliers));
    let has_depth = matches!(verdict, Verdict::Good | Verdict::Plane | Verdict::Lens);
    Ok(Judged {
        verdict,
        inliers,
        cam2_from_cam1: report.cam2_from_cam1.filter(|_| has_depth),
        median_angle_deg,
    })
}

/// Returns the verdict of a rotation with another focal length and its inliers, if it explains
/// more: with a wrong focal length, a rotation looks like a plane or like another rotation with
/// fewer inliers.
fn turned_otherwise(
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    cameras: &[Camera; 2],
    report: &TwoViewReport,
    options: &TwoViewOptions,
) -> Result<Option<(Verdict, Vec<bool>)>, Error> {
    let is_turn = match report.configuration {
        Configuration::Planar => false,
        Configuration::Panoramic => true,
        Configuration::General | Configuration::Degenerate => return Ok(None),
    };
    let found = find_rotation_and_focal(
        pixels1,
        pixels2,
        cameras.each_ref(),
        &report.inliers,
        options,
    )?;
    let Some(turn) = found else {
        return Ok(None);
    };
    let verdict = |motion: &RigidTransform| Verdict::OrientationMismatch {
        angle_deg: motion.rotation.angle().to_degrees(),
        focal_factor: turn.focal_factor,
    };
    if !is_turn {
        return Ok(Some((
            verdict(&turn.cam2_from_cam1),
            report.inliers.clone(),
        )));
    }
    let mut cameras = *cameras;
    for camera in &mut cameras {
        camera.intrinsics = camera.intrinsics.zoomed(turn.focal_factor)?;
    }
    let better =
        estimate_two_view_calibrated(pixels1, pixels2, cameras.each_ref(), options, &mut ())?;
    let count = |inliers: &[bool]| inliers.iter().filter(|inlier| **inlier).count() as f64;
    let gain = count(&better.inliers) / count(&report.inliers);
    let motion = better.cam2_from_cam1.filter(|_| gain > MIN_GAIN);
    Ok(motion.map(|motion| (verdict(&motion), better.inliers)))
}
