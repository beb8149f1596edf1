//! `epipole two-view`: the geometry of two photographs.

use crate::camera::PairArguments;
use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, MatchArguments};
use crate::matrices::{Motion, row_major};
use crate::photo::Photo;
use crate::report::Report;
use crate::robust::RobustArguments;
use crate::turn::find_turn;
use clap::{Args, ValueEnum};
use epipole::camera::RigidTransform;
use epipole::epipolar::{FundamentalEstimator, estimate_relative_pose_with, sampson_px};
use epipole::homography::{HomographyEstimator, homography_sampson_px};
use epipole::robust::{MatchSet, RansacReport};
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, TwoViewSearch, TwoViewTrial,
    estimate_two_view_calibrated_with, estimate_two_view_with,
};
use nalgebra::{Matrix3, Point2};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Model {
    /// Whichever fits best.
    Auto,
    /// Pixels only.
    Fundamental,
    /// For known intrinsics; also gives the motion.
    Essential,
    /// For a plane, or a camera that only turned; known intrinsics tell a turn.
    Homography,
}

/// Find the geometry of two photographs.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_error_px", |argument| argument.help(
        "The largest error of an inlier, pixels: Sampson error of F and E; of planes and turns 1.25 \
         times it, or with --model homography the distance in image 2"
    )),
    after_help = "Example: epipole two-view left.jpg right.jpg --focal-px 1200\n\n\
    A match can miss an epipolar line in one dimension, a plane or a turn in two. So, when auto finds\n\
    one of these, its inliers have a Sampson error of H of up to 1.25 times --max-error-px.\n\n\
    JSON: model_kind (fundamental, essential or homography), model (9 numbers row by row),\n\
    num_keypoints (of both photographs), num_matches, num_inliers, matches ([u1, v1, u2, v2, 1 for an\n\
    inlier or 0] each), cam2_from_cam1 (rotation and translation of length 1, or 0 if the camera only\n\
    turned; null if unknown), other_cam2_from_cam1 (of a plane: another motion that fits as well, or\n\
    null), mean_sampson_px (of the inliers), configuration (general; planar: a plane, or a turn if\n\
    no intrinsics are known; panoramic: a turn; degenerate: no more than chance)."
)]
pub(crate) struct Arguments {
    /// A PNG, JPEG or WebP file.
    first: PathBuf,
    /// A PNG, JPEG or WebP file.
    second: PathBuf,
    /// Which model to look for.
    #[arg(long, value_enum, default_value = "auto")]
    model: Model,
    #[command(flatten)]
    camera: PairArguments,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    matching: MatchArguments,
    #[command(flatten)]
    robust: RobustArguments,
}

/// What was found, whatever the model.
struct Found {
    kind: &'static str,
    model: Matrix3<f64>,
    inliers: Vec<bool>,
    cam2_from_cam1: Option<RigidTransform>,
    other_cam2_from_cam1: Option<RigidTransform>,
    configuration: &'static str,
    errors_px: Vec<f64>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    arguments.camera.check()?;
    let photos = [
        Photo::read(&arguments.first)?,
        Photo::read(&arguments.second)?,
    ];
    let found1 = arguments.features.detect(&photos[0], context)?;
    let found2 = arguments.features.detect(&photos[1], context)?;
    let matches = arguments.matching.run_best_first(&found1, &found2)?;
    let pixels1: Vec<Point2<f64>> = matches
        .iter()
        .map(|m| found1.keypoints[m.index1].point())
        .collect();
    let pixels2: Vec<Point2<f64>> = matches
        .iter()
        .map(|m| found2.keypoints[m.index2].point())
        .collect();
    if arguments.model == Model::Fundamental && arguments.camera.is_given() {
        context
            .warn("--k, --k2 and --focal-px make no difference here: this model needs pixels only");
    }
    let found = estimate(arguments, context, &photos, &pixels1, &pixels2)?;

    let num_inliers = found.inliers.iter().filter(|is| **is).count();
    let of_inliers = found
        .errors_px
        .iter()
        .zip(&found.inliers)
        .filter(|(_, is)| **is);
    let mean_px = of_inliers.map(|(error, _)| error).sum::<f64>() / num_inliers.max(1) as f64;
    let rows: Vec<(f64, f64, f64, f64, u8)> = pixels1
        .iter()
        .zip(&pixels2)
        .zip(&found.inliers)
        .map(|((a, b), is_inlier)| (a.x, a.y, b.x, b.y, u8::from(*is_inlier)))
        .collect();
    let counts = [found1.keypoints.len(), found2.keypoints.len()];
    Ok(Report::default()
        .row("keypoints", format!("{} and {}", counts[0], counts[1]))
        .row("matches", rows.len())
        .row("model", found.kind)
        .row("inliers", num_inliers)
        .row("mean error of inliers", format!("{mean_px:.3} px"))
        .row("configuration", found.configuration)
        .field("model_kind", found.kind)
        .field("model", row_major(&found.model))
        .field("num_keypoints", counts)
        .field("num_matches", rows.len())
        .field("num_inliers", num_inliers)
        .field("matches", rows)
        .field(
            "cam2_from_cam1",
            found.cam2_from_cam1.as_ref().map(Motion::from),
        )
        .field(
            "other_cam2_from_cam1",
            found.other_cam2_from_cam1.as_ref().map(Motion::from),
        )
        .field("mean_sampson_px", mean_px)
        .field("configuration", found.configuration))
}

fn estimate(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Found, Failure> {
    let ransac = arguments.robust.options(context);
    let options = TwoViewOptions {
        ransac,
        ..TwoViewOptions::default()
    };
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
            let mut look = arguments.robust.look(context);
            // The last trial of each search.
            let mut ends: Vec<TwoViewTrial> = Vec::new();
            let mut observer = |trial: &TwoViewTrial| {
                match ends.last_mut() {
                    Some(end) if end.search == trial.search => *end = *trial,
                    _ => ends.push(*trial),
                }
                look(trial.iteration, trial.required_iterations)
            };
            let report = match given {
                Some([k1, k2]) => estimate_two_view_calibrated_with(
                    pixels1,
                    pixels2,
                    &k1,
                    &k2,
                    &options,
                    &mut observer,
                ),
                None => estimate_two_view_with(pixels1, pixels2, &options, &mut observer),
            }?;
            drop(look);
            let chosen = search_of(&report);
            let end = ends.iter().find(|end| end.search == chosen);
            let (drawn, required) =
                end.map_or((0, 0), |end| (end.iteration, end.required_iterations));
            arguments
                .robust
                .warn_of_stop(report.stop, drawn, required, context);
            Ok(of_report(report, pixels1, pixels2))
        }
        Model::Fundamental => {
            let estimator = FundamentalEstimator::new(set()?)?;
            let report = arguments.robust.run(estimator, context)?;
            Ok(Found {
                kind: "fundamental",
                errors_px: errors(&report.model),
                configuration: configuration(&report, "general"),
                model: report.model,
                inliers: report.inliers,
                cam2_from_cam1: None,
                other_cam2_from_cam1: None,
            })
        }
        Model::Essential => {
            let ([k1, k2], guess) = arguments.camera.or_guess(photos)?;
            if let Some(sentence) = guess {
                context.warn(&sentence);
            }
            let report = arguments.robust.watched(context, |options, watch| {
                estimate_relative_pose_with(pixels1, pixels2, &k1, &k2, options, watch)
            })?;
            let pose = report.model;
            let mut found = Found {
                kind: "essential",
                errors_px: errors(&pose.fundamental),
                model: pose.essential(),
                cam2_from_cam1: Some(pose.cam2_from_cam1()),
                other_cam2_from_cam1: None,
                configuration: configuration(&report, "general"),
                inliers: report.inliers,
            };
            if found.configuration == "degenerate" {
                found.cam2_from_cam1 = None;
            } else if let Some(turn) =
                find_turn(pixels1, pixels2, &[k1, k2], &found.inliers, &ransac)
            {
                context.warn(&turn.sentence());
                found.configuration = "panoramic";
                found.cam2_from_cam1 = Some(turn.cam2_from_cam1);
            }
            Ok(found)
        }
        Model::Homography => {
            let given = arguments.camera.given(photos)?;
            let estimator = HomographyEstimator::new(set()?)?;
            let report = arguments.robust.run(estimator, context)?;
            let error = |(a, b)| homography_sampson_px(&report.model, a, b);
            let mut found = Found {
                kind: "homography",
                errors_px: pixels1.iter().zip(pixels2).map(error).collect(),
                configuration: configuration(&report, "planar"),
                model: report.model,
                inliers: report.inliers,
                cam2_from_cam1: None,
                other_cam2_from_cam1: None,
            };
            // Pixels alone do not tell a turn from a plane.
            if let (Some(k), "planar") = (given, found.configuration)
                && let Some(turn) = find_turn(pixels1, pixels2, &k, &found.inliers, &ransac)
            {
                found.configuration = "panoramic";
                found.cam2_from_cam1 = Some(turn.cam2_from_cam1);
            }
            Ok(found)
        }
    }
}

/// Whether no more matches agree than wrong ones might.
fn is_degenerate<M>(report: &RansacReport<M>) -> bool {
    report.could_be_chance()
        || report.num_unique_inliers < TwoViewOptions::default().min_num_inliers
}

/// What the views show, if it is enough to be anything.
fn configuration<M>(report: &RansacReport<M>, otherwise: &'static str) -> &'static str {
    if is_degenerate(report) {
        "degenerate"
    } else {
        otherwise
    }
}

/// The search that gave the model.
fn search_of(report: &TwoViewReport) -> TwoViewSearch {
    match report.model {
        TwoViewModel::Fundamental(_) => TwoViewSearch::Fundamental,
        TwoViewModel::Essential(_) => TwoViewSearch::Essential,
        TwoViewModel::Homography(_) if report.configuration == Configuration::Panoramic => {
            TwoViewSearch::Rotation
        }
        TwoViewModel::Homography(_) => TwoViewSearch::Homography,
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
        inliers: report.inliers,
        cam2_from_cam1: report.cam2_from_cam1,
        other_cam2_from_cam1: report.other_cam2_from_cam1,
        configuration: match report.configuration {
            Configuration::General => "general",
            Configuration::Planar => "planar",
            Configuration::Panoramic => "panoramic",
            Configuration::Degenerate => "degenerate",
        },
    }
}
