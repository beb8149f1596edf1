//! The searches of `epipole two-view`, and what they found.

use super::focal::intrinsics;
use super::{Arguments, Model};
use crate::context::Context;
use crate::failure::Failure;
use crate::photo::Photo;
use crate::progress::Progress;
use crate::turn::{self, left_open, left_open_by_homography};
use epipole::camera::RigidTransform;
use epipole::epipolar::{FundamentalEstimator, estimate_relative_pose, sampson_px};
use epipole::homography::{HomographyEstimator, homography_sampson_px};
use epipole::progress::Stage;
use epipole::robust::{MatchSet, RansacReport};
use epipole::two_view::{
    Configuration, ExplainingTurn, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view,
    estimate_two_view_calibrated, find_explaining_turn,
};
use nalgebra::{Matrix3, Point2};

/// What was found, whatever the model.
pub(super) struct Found {
    pub(super) kind: &'static str,
    pub(super) model: Matrix3<f64>,
    pub(super) inliers: Vec<bool>,
    pub(super) cam2_from_cam1: Option<RigidTransform>,
    pub(super) other_cam2_from_cam1: Option<RigidTransform>,
    pub(super) configuration: &'static str,
    pub(super) errors_px: Vec<f64>,
    pub(super) max_error_px: f64,
    /// Of both cameras, where E was searched for.
    pub(super) focals_px: Option<[f64; 2]>,
}

impl Found {
    /// Of a search for one model.
    ///
    /// * `kind`, `otherwise`: its name, and the configuration that it means unless it is degenerate
    pub(super) fn of_search<M>(
        [kind, otherwise]: [&'static str; 2],
        model: Matrix3<f64>,
        errors_px: Vec<f64>,
        report: RansacReport<M>,
        options: &TwoViewOptions,
    ) -> Self {
        Self {
            kind,
            model,
            errors_px,
            configuration: configuration(&report, otherwise, options),
            max_error_px: report.max_error_px,
            inliers: report.inliers,
            cam2_from_cam1: None,
            other_cam2_from_cam1: None,
            focals_px: None,
        }
    }

    /// Where a camera that only turned explains it all.
    pub(super) fn turned(&mut self, turn: &ExplainingTurn) {
        self.configuration = "panoramic";
        self.cam2_from_cam1 = Some(turn.cam2_from_cam1);
    }
}

/// Looks for the model that was asked for.
///
/// # Errors
/// As the core's searches, and as [`PairArguments::given`](crate::camera::PairArguments::given).
pub(super) fn estimate(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Found, Failure> {
    let options = arguments.options(context);
    let set = || MatchSet::new(pixels1, pixels2);
    let errors = |f: &Matrix3<f64>| -> Vec<f64> {
        pixels1
            .iter()
            .zip(pixels2)
            .map(|(a, b)| sampson_px(f, a, b))
            .collect()
    };
    match arguments.model {
        Model::Auto => {
            let given = arguments.camera.given(photos)?;
            let progress = Progress::new(context, Stage::RobustEstimation.words());
            let mut monitor = |status| progress.show(status);
            let report = match given {
                Some([k1, k2]) => {
                    estimate_two_view_calibrated(pixels1, pixels2, &k1, &k2, &options, &mut monitor)
                }
                None => estimate_two_view(pixels1, pixels2, &options, &mut monitor),
            }?;
            drop(progress);
            arguments.robust.warn_of_stop(
                report.stop,
                options.ransac.max_iterations,
                report.required_iterations,
                context,
            );
            let found = of_report(report, pixels1, pixels2);
            warn_of_turn(arguments, context, photos, [pixels1, pixels2], &found)?;
            Ok(found)
        }
        Model::Fundamental => {
            let estimator = FundamentalEstimator::new(set()?)?;
            let report = arguments.robust.run(estimator, context)?;
            let (f, judging) = (report.model, options.ransac.within(report.max_error_px));
            let words = ["fundamental", "general"];
            let found = Found::of_search(words, f, errors(&f), report, &options);
            if found.configuration != "degenerate"
                && let Some(open) = left_open(pixels1, pixels2, &found.inliers, &judging)?
            {
                context.warn(&open);
            }
            Ok(found)
        }
        Model::Essential => {
            let [k1, k2] = intrinsics(arguments, context, photos, pixels1, pixels2)?;
            let report = arguments.robust.watched(context, |options, monitor| {
                estimate_relative_pose(pixels1, pixels2, &k1, &k2, options, monitor)
            })?;
            let pose = report.model;
            let judging = options.within(report.max_error_px);
            let (model, errors_px) = (pose.essential(), errors(&pose.fundamental));
            let words = ["essential", "general"];
            let mut found = Found::of_search(words, model, errors_px, report, &options);
            found.focals_px = Some([k1.fu_px(), k2.fu_px()]);
            if found.configuration == "degenerate" {
                return Ok(found);
            }
            found.cam2_from_cam1 = Some(pose.cam2_from_cam1());
            if let Some(turn) =
                find_explaining_turn(pixels1, pixels2, &k1, &k2, &found.inliers, &judging)?
            {
                context.warn(&turn::sentence(&turn));
                found.turned(&turn);
            }
            Ok(found)
        }
        Model::Homography => {
            let given = arguments.camera.given(photos)?;
            let estimator = HomographyEstimator::new(set()?)?;
            let report = arguments.robust.run(estimator, context)?;
            let judging = options.within(report.max_error_px);
            let h = report.model;
            let error = |(a, b)| homography_sampson_px(&h, a, b);
            let errors_px = pixels1.iter().zip(pixels2).map(error).collect();
            let words = ["homography", "planar"];
            let mut found = Found::of_search(words, h, errors_px, report, &options);
            // Pixels alone do not tell a turn from a plane.
            if let (Some([k1, k2]), "planar") = (given, found.configuration)
                && let Some(turn) =
                    find_explaining_turn(pixels1, pixels2, &k1, &k2, &found.inliers, &judging)?
            {
                found.turned(&turn);
            }
            warn_of_turn(arguments, context, photos, [pixels1, pixels2], &found)?;
            Ok(found)
        }
    }
}

/// Of a plane that did not move, or may be a turn by another focal length than the one given, read or guessed.
fn warn_of_turn(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    [pixels1, pixels2]: [&[Point2<f64>]; 2],
    found: &Found,
) -> Result<(), Failure> {
    if found.configuration != "planar" {
        return Ok(());
    }
    let (intrinsics, _) = arguments.camera.or_guess(photos)?;
    let options = arguments.options(context).within(found.max_error_px);
    let inliers = &found.inliers;
    let unmoved = left_open_by_homography(pixels1, pixels2, inliers, &options.ransac)?;
    let sentence = match unmoved {
        None => turn::sentence_of_other_focal(pixels1, pixels2, &intrinsics, inliers, &options)?,
        unmoved => unmoved,
    };
    if let Some(sentence) = sentence {
        context.warn(&sentence);
    }
    Ok(())
}

/// The word for what two views show.
pub(super) fn word(configuration: Configuration) -> &'static str {
    match configuration {
        Configuration::General => "general",
        Configuration::Planar => "planar",
        Configuration::Panoramic => "panoramic",
        Configuration::Degenerate => "degenerate",
    }
}

/// Whether no more matches agree than wrong ones might.
fn is_degenerate<M>(report: &RansacReport<M>, options: &TwoViewOptions) -> bool {
    report.could_be_chance() || report.num_unique_inliers < options.min_num_inliers
}

/// What the views show, if it is enough to be anything.
fn configuration<M>(
    report: &RansacReport<M>,
    otherwise: &'static str,
    options: &TwoViewOptions,
) -> &'static str {
    if is_degenerate(report, options) {
        "degenerate"
    } else {
        otherwise
    }
}

fn of_report(report: TwoViewReport, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Found {
    let pairs = || pixels1.iter().zip(pixels2);
    let (kind, model) = match report.model {
        TwoViewModel::Fundamental(f) => ("fundamental", f),
        TwoViewModel::Essential(e) => ("essential", e),
        TwoViewModel::Homography(h) => ("homography", h),
    };
    let errors_px = match (report.model, &report.fundamental) {
        (TwoViewModel::Homography(h), _) => pairs()
            .map(|(a, b)| homography_sampson_px(&h, a, b))
            .collect(),
        (_, Some(f)) => pairs().map(|(a, b)| sampson_px(f, a, b)).collect(),
        (_, None) => vec![0.0; pixels1.len()],
    };
    Found {
        kind,
        model,
        errors_px,
        max_error_px: report.max_error_px,
        focals_px: None,
        inliers: report.inliers,
        cam2_from_cam1: report.cam2_from_cam1,
        other_cam2_from_cam1: report.other_cam2_from_cam1,
        configuration: word(report.configuration),
    }
}
