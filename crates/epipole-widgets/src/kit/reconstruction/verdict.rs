//! What the matches of two photographs say about how the camera moved.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::robust::RansacOptions;
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view_calibrated,
    find_turn_and_focal,
};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Fewer matches than this tell nothing.
pub(crate) const MIN_NUM_MATCHES: usize = 15;
/// Half of the inliers should have rays that meet at a larger angle.
const MIN_MEDIAN_ANGLE_DEG: f64 = 0.75;
/// Another focal length is worth telling if a turn then explains so many times the matches.
const MIN_GAIN: f64 = 1.05;

/// What the pair turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Verdict {
    /// A motion and a scene with depth.
    Good,
    /// A motion, but a plane explains most matches.
    Plane,
    /// A motion, but without the focal length more matches could be explained.
    Lens,
    /// Fewer matches than anything can be told from.
    TooFew,
    /// Matches that agree on nothing.
    NoConsensus,
    /// The camera only turned, by this angle in degrees.
    Turned(f64),
    /// The camera only turned, if its focal length is another one.
    TurnedOtherwise {
        /// By this angle, degrees.
        angle_deg: f64,
        /// The focal length is so many times the one given.
        focal_factor: f64,
    },
    /// The camera moved, but so little that rays meet at this angle in degrees.
    Narrow(f64),
}

/// A verdict with what it rests on.
pub(super) struct Judged {
    pub(super) verdict: Verdict,
    /// For each match, whether it agrees with what was found.
    pub(super) inliers: Vec<bool>,
    /// There if points can be triangulated.
    pub(super) cam2_from_cam1: Option<RigidTransform>,
    pub(super) median_angle_deg: f64,
}

/// Cameras of any image size, which no estimator asks for.
fn pinholes(intrinsics: &[Intrinsics; 2]) -> [Camera; 2] {
    intrinsics.map(|k| Camera::pinhole(k, 0, 0))
}

/// Judges matches, of which inliers are at most `max_error_px` from their epipolar lines.
///
/// # Errors
/// For numbers that are no numbers; matches that agree on nothing have a verdict.
pub(super) fn judge(
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    lenses: &[Intrinsics; 2],
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
    let report: TwoViewReport = match estimate_two_view_calibrated(
        pixels1,
        pixels2,
        pinholes(lenses).each_ref(),
        &options,
        &mut (),
    ) {
        Ok(report) => report,
        // Wrong matches agree on nothing, and matches at one place determine nothing.
        Err(Error::NoConsensus { .. } | Error::Degenerate { .. } | Error::TooFew { .. }) => {
            return Ok(nothing(Verdict::NoConsensus));
        }
        Err(error) => return Err(error),
    };
    let median_angle_deg = (report.median_triangulation_angle_rad).map_or(0.0, f64::to_degrees);
    let turn_deg =
        (report.cam2_from_cam1).map_or(0.0, |motion| motion.rotation.angle().to_degrees());
    let fundamental_won = matches!(report.model, TwoViewModel::Fundamental(_));
    let seen = match report.configuration {
        // A model that next to nobody supports has no inliers worth showing.
        Configuration::Degenerate => return Ok(nothing(Verdict::NoConsensus)),
        Configuration::Panoramic => Verdict::Turned(turn_deg),
        _ if median_angle_deg < MIN_MEDIAN_ANGLE_DEG => Verdict::Narrow(median_angle_deg),
        Configuration::Planar => Verdict::Plane,
        Configuration::General if fundamental_won => Verdict::Lens,
        Configuration::General => Verdict::Good,
    };
    let otherwise = turned_otherwise([pixels1, pixels2], lenses, &report, &options)?;
    let (verdict, inliers) = otherwise.unwrap_or((seen, report.inliers));
    let has_depth = matches!(verdict, Verdict::Good | Verdict::Plane | Verdict::Lens);
    Ok(Judged {
        verdict,
        inliers,
        cam2_from_cam1: report.cam2_from_cam1.filter(|_| has_depth),
        median_angle_deg,
    })
}

/// What is said of a camera that only turned, with the inliers, if that goes better with another focal length: under
/// a wrong one a turn passes for a plane, or for another turn that explains less.
fn turned_otherwise(
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    lenses: &[Intrinsics; 2],
    report: &TwoViewReport,
    options: &TwoViewOptions,
) -> Result<Option<(Verdict, Vec<bool>)>, Error> {
    let is_turn = match report.configuration {
        Configuration::Planar => false,
        Configuration::Panoramic => true,
        Configuration::General | Configuration::Degenerate => return Ok(None),
    };
    let [k1, k2] = lenses;
    let found = find_turn_and_focal(pixels1, pixels2, k1, k2, &report.inliers, options)?;
    let Some(turn) = found else {
        return Ok(None);
    };
    let verdict = |motion: &RigidTransform| Verdict::TurnedOtherwise {
        angle_deg: motion.rotation.angle().to_degrees(),
        focal_factor: turn.focal_factor,
    };
    if !is_turn {
        return Ok(Some((
            verdict(&turn.cam2_from_cam1),
            report.inliers.clone(),
        )));
    }
    let [k1, k2] = [k1.zoomed(turn.focal_factor)?, k2.zoomed(turn.focal_factor)?];
    let cameras = pinholes(&[k1, k2]);
    let better =
        estimate_two_view_calibrated(pixels1, pixels2, cameras.each_ref(), options, &mut ())?;
    let count = |inliers: &[bool]| inliers.iter().filter(|inlier| **inlier).count() as f64;
    let gain = count(&better.inliers) / count(&report.inliers);
    let motion = better.cam2_from_cam1.filter(|_| gain > MIN_GAIN);
    Ok(motion.map(|motion| (verdict(&motion), better.inliers)))
}
