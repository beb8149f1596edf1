//! The model that two views deserve.

use super::find_rotation;
use super::motion::{median_angle, planar_pose, pose_of_fundamental};
use crate::camera::{Intrinsics, RigidTransform};
use crate::epipolar::{RelativePose, estimate_relative_pose, find_fundamental, sampson_sq};
use crate::homography::{find_homography, transfer_error_sq};
use crate::robust::{RansacOptions, RansacReport};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion};

/// What two views show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// A moving camera and a scene with depth: F or E says all.
    General,
    /// A moving camera and a plane: H says all; F is open, and the motion may be twofold.
    Planar,
    /// A camera that only turned, or hardly moved: H says all; depth cannot be told. Without
    /// intrinsics this cannot be told from a plane and is reported as [`Planar`](Configuration::Planar).
    Panoramic,
    /// Too few matches agree on anything.
    Degenerate,
}

/// The matrix that describes the pair, unit Frobenius norm, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TwoViewModel {
    /// `x2ᵀ F x1 = 0`.
    Fundamental(Matrix3<f64>),
    /// E; the pixels' F is [`TwoViewReport::fundamental`].
    Essential(Matrix3<f64>),
    /// `x2 ∝ H x1`.
    Homography(Matrix3<f64>),
}

/// How to judge a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoViewOptions {
    /// For each of the models that are tried.
    pub ransac: RansacOptions,
    /// Fewer different inliers than this mean [`Configuration::Degenerate`]. 15.
    pub min_num_inliers: usize,
    /// A homography with at least this share of the epipolar inliers means a plane or a turn.
    /// 0.8.
    pub max_homography_share: f64,
    /// E is preferred to F if it has at least this share of F's inliers. 0.95.
    pub min_essential_share: f64,
}

impl Default for TwoViewOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default(),
            min_num_inliers: 15,
            max_homography_share: 0.8,
            min_essential_share: 0.95,
        }
    }
}

/// What was found out about two views.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewReport {
    /// What they show.
    pub configuration: Configuration,
    /// The matrix chosen.
    pub model: TwoViewModel,
    /// F, where the pair has one.
    pub fundamental: Option<Matrix3<f64>>,
    /// H, if one was found.
    pub homography: Option<Matrix3<f64>>,
    /// The motion, for calibrated views; |t| = 1, or 0 for [`Configuration::Panoramic`].
    pub cam2_from_cam1: Option<RigidTransform>,
    /// For each match given, whether it fits `model`.
    pub inliers: Vec<bool>,
    /// How many do.
    pub num_inliers: usize,
    /// Samples drawn, over all models tried.
    pub iterations: usize,
    /// The median angle at which the inliers' rays meet, radians, for a calibrated pair with motion.
    pub median_triangulation_angle_rad: Option<f64>,
}

/// Chooses between F and H for two views of unknown intrinsics.
///
/// Both are estimated; if H explains nearly as many matches as F does, the scene is a plane or the
/// camera only turned.
///
/// # Errors
/// As [`find_fundamental`] and [`find_homography`] if neither finds a model.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
pub fn estimate_two_view(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &TwoViewOptions,
) -> Result<TwoViewReport> {
    let fundamental = find_fundamental(pixels1, pixels2, &options.ransac);
    let homography = find_homography(pixels1, pixels2, &options.ransac);
    let iterations = count_iterations(&fundamental) + count_iterations(&homography);
    let homography_wins = match (&fundamental, &homography) {
        (Err(error), Err(_)) => return Err(error.clone()),
        (Err(_), Ok(_)) => true,
        (Ok(_), Err(_)) => false,
        (Ok(f), Ok(h)) => is_homography(h.num_unique_inliers, f.num_unique_inliers, options),
    };
    let f = fundamental.as_ref().ok().map(|report| report.model);
    let h = homography.as_ref().ok().map(|report| report.model);
    let (model, report, configuration) = if homography_wins {
        let report = homography?;
        (
            TwoViewModel::Homography(report.model),
            report,
            Configuration::Planar,
        )
    } else {
        let report = fundamental?;
        (
            TwoViewModel::Fundamental(report.model),
            report,
            Configuration::General,
        )
    };
    Ok(TwoViewReport {
        configuration: if report.num_unique_inliers < options.min_num_inliers {
            Configuration::Degenerate
        } else {
            configuration
        },
        model,
        fundamental: f,
        homography: h,
        cam2_from_cam1: None,
        num_inliers: report.num_inliers,
        inliers: report.inliers,
        iterations,
        median_triangulation_angle_rad: None,
    })
}

/// Chooses among E, F and H for two views of known intrinsics, and finds the motion.
///
/// * `k1`, `k2`: intrinsics of the cameras. If they are wrong, F explains more matches than E and
///   is chosen
///
/// A camera that only turned is recognized by a rotation that explains as many matches as the best
/// other model. Where F is chosen, the motion is still that of E, if enough matches support it: it is
/// the best that agrees with the intrinsics. For a plane the motion is taken from E or from the decomposition of H, whichever
/// fits more matches with the points in front of both cameras.
///
/// # Errors
/// As [`estimate_relative_pose`] and [`find_homography`] if no model is found.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
pub fn estimate_two_view_calibrated(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &TwoViewOptions,
) -> Result<TwoViewReport> {
    let essential = estimate_relative_pose(pixels1, pixels2, k1, k2, &options.ransac);
    let fundamental = find_fundamental(pixels1, pixels2, &options.ransac);
    let homography = find_homography(pixels1, pixels2, &options.ransac);
    let rotation = find_rotation(pixels1, pixels2, k1, k2, &options.ransac);
    let iterations = count_iterations(&essential)
        + count_iterations(&fundamental)
        + count_iterations(&homography)
        + count_iterations(&rotation);

    let (num_e, num_f, num_h, num_r) = (
        support(&essential),
        support(&fundamental),
        support(&homography),
        support(&rotation),
    );
    let num_epipolar = num_e.max(num_f);
    let best = num_epipolar.max(num_h).max(num_r);
    let h = homography.as_ref().ok().map(|report| report.model);
    let mut found = TwoViewReport {
        configuration: Configuration::Degenerate,
        model: TwoViewModel::Homography(Matrix3::identity() / 3.0_f64.sqrt()),
        fundamental: None,
        homography: h,
        cam2_from_cam1: None,
        inliers: Vec::new(),
        num_inliers: 0,
        iterations,
        median_triangulation_angle_rad: None,
    };
    let share = |num: usize| num as f64 >= options.max_homography_share * best as f64;
    if let Ok(turn) = &rotation
        && num_r >= 3
        && share(num_r)
    {
        let matrix = k2.matrix() * turn.model * k1.inverse_matrix();
        found.model = TwoViewModel::Homography(matrix / matrix.norm());
        found.configuration = Configuration::Panoramic;
        found.cam2_from_cam1 = Some(RigidTransform::from_parts(
            nalgebra::Translation3::identity(),
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn.model)),
        ));
        take_inliers(&mut found, turn, options);
        return Ok(found);
    }
    let planar = is_homography(num_h, num_epipolar, options);
    if planar && let Ok(report) = &homography {
        found.model = TwoViewModel::Homography(report.model);
        found.configuration = Configuration::Planar;
        take_inliers(&mut found, report, options);
        let pose = planar_pose(
            pixels1,
            pixels2,
            k1,
            k2,
            report,
            essential.as_ref().ok(),
            options.ransac.max_error_px,
        );
        found.cam2_from_cam1 = pose.as_ref().map(RelativePose::cam2_from_cam1);
        found.fundamental = pose.map(|pose| pose.fundamental);
    } else if num_e as f64 >= options.min_essential_share * num_f as f64
        && let Ok(report) = &essential
    {
        found.model = TwoViewModel::Essential(report.model.essential());
        found.configuration = Configuration::General;
        take_inliers(&mut found, report, options);
        found.cam2_from_cam1 = Some(report.model.cam2_from_cam1());
        found.fundamental = Some(report.model.fundamental);
    } else {
        let report = fundamental?;
        found.model = TwoViewModel::Fundamental(report.model);
        found.configuration = Configuration::General;
        take_inliers(&mut found, &report, options);
        found.fundamental = Some(report.model);
        // E's motion was fitted with the intrinsics. F's, made to respect them afterwards, is far
        // less exact, all the more where F has bent to wrong matches that E refused.
        found.cam2_from_cam1 = match &essential {
            Ok(report) if num_e >= options.min_num_inliers => Some(report.model.cam2_from_cam1()),
            _ => pose_of_fundamental(pixels1, pixels2, k1, k2, &report),
        };
    }
    if let Some(motion) = &found.cam2_from_cam1 {
        found.median_triangulation_angle_rad =
            median_angle(pixels1, pixels2, k1, k2, motion, &found.inliers);
    }
    Ok(found)
}

fn count_iterations<M>(report: &Result<RansacReport<M>>) -> usize {
    match report {
        Ok(report) => report.iterations,
        Err(Error::NoConsensus { iterations, .. }) => *iterations,
        Err(_) => 0,
    }
}

fn support<M>(report: &Result<RansacReport<M>>) -> usize {
    report
        .as_ref()
        .map_or(0, |report| report.num_unique_inliers)
}

fn is_homography(num_homography: usize, num_epipolar: usize, options: &TwoViewOptions) -> bool {
    num_homography as f64 >= options.max_homography_share * num_epipolar as f64
}

fn take_inliers<M>(found: &mut TwoViewReport, report: &RansacReport<M>, options: &TwoViewOptions) {
    found.inliers = report.inliers.clone();
    found.num_inliers = report.num_inliers;
    if report.num_unique_inliers < options.min_num_inliers {
        found.configuration = Configuration::Degenerate;
    }
}

impl TwoViewReport {
    /// The mean error of the inliers, pixels: Sampson for F and E, transfer for H. `None` without
    /// inliers, or if the pair has no F to measure by.
    pub fn mean_error_px(&self, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Option<f64> {
        let (mut total, mut count) = (0.0, 0);
        for ((p1, p2), inlier) in pixels1.iter().zip(pixels2).zip(&self.inliers) {
            if *inlier {
                total += match &self.model {
                    TwoViewModel::Homography(h) => transfer_error_sq(h, p1, p2).sqrt(),
                    _ => sampson_sq(self.fundamental.as_ref()?, p1, p2).sqrt(),
                };
                count += 1;
            }
        }
        (count > 0).then(|| total / f64::from(count))
    }
}
