//! `epipole fit`: a model fitted to matches or points with outliers.

use crate::context::Context;
use crate::failure::Failure;
use crate::match_file;
use crate::matrices::{Motion, direction, intrinsics, row_major};
use crate::report::Report;
use crate::robust::{RobustArguments, stop_word, threshold_words};
use crate::rotation_only::{
    self, find_rotation_only, if_unmoved, left_open, left_open_by_homography,
};
use crate::units::{warn_of_fractions, warn_of_units};
use clap::{Args, ValueEnum};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{
    FundamentalEstimator, GravityEstimator, estimate_relative_pose, sampson_px,
};
use epipole::homography::{HomographyEstimator, transfer_error_px};
use epipole::robust::{
    FARTHEST_PX, LineEstimator, MatchSet, RansacReport, SimilarityEstimator, StopReason,
};
use nalgebra::{Matrix3, Point2, Vector3};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Model {
    /// a u + b v + c = 0 through points: the first two columns.
    Line,
    /// x2 ∝ H x1.
    Homography,
    /// x2ᵀ F x1 = 0.
    Fundamental,
    /// x2ᵀ E x1 = 0 for known intrinsics; also gives the motion.
    Essential,
    /// Rotation, scale and translation.
    Similarity,
}

/// Fit a model to matches with outliers.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole fit --model fundamental matches.txt --max-error-px 1\n\n\
    A file of matches, as epipole match writes it, has one match per line, u1 v1 u2 v2; further columns are\n\
    ignored, # begins a comment. A header may name the columns: u1 v1 u2 v2 or x1 y1 x2 y2 (points: u v or x y).\n\
    Numbers are separated by commas, semicolons, tabs or spaces; decimal commas work only with semicolons or tabs.\n\n\
    JSON: model (9 numbers row by row; for a line 3: a, b, c), inliers (1 or 0 for each row),\n\
    num_inliers, iterations (samples drawn), required_iterations (samples required for this inlier\n\
    ratio; null if no number is enough), stop (confident; exhausted: by --max-iterations; canceled: by\n\
    Ctrl-C), could_be_random (whether random data would have as many inliers), max_error_px (as given,\n\
    or as found by auto), mean_error_px (of the inliers), num_left_out (rows beyond 10⁹ pixels), for\n\
    homography and fundamental not_determined (a sentence if the inliers show no motion, or for\n\
    fundamental a plane or a rotation; else null), and for essential cam2_from_cam1 (rotation and\n\
    translation of length 1) and could_be_rotation (whether a rotation alone explains nearly all inliers,\n\
    so that the translation is meaningless).\n\n\
    Errors: distance of a point from a line; distance in image 2 for homography and similarity; Sampson\n\
    error for fundamental and essential."
)]
pub(crate) struct Arguments {
    /// Model to fit.
    #[arg(long, value_enum)]
    model: Model,
    /// Text file with one match per line; - for standard input.
    matches: PathBuf,
    /// Write the inliers (comma-separated if the name ends in .csv; -: standard output).
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Intrinsics of camera 1 (for the essential matrix).
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k: Option<Intrinsics>,
    /// Intrinsics of camera 2 [default: those of --k].
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k2: Option<Intrinsics>,
    /// Direction of gravity in the frame of camera 1 (y down, z forward); reduces a sample from
    /// five matches to three.
    #[arg(long, value_name = "x,y,z", value_parser = direction, allow_hyphen_values = true, requires = "gravity2")]
    gravity: Option<Vector3<f64>>,
    /// Direction of gravity in the frame of camera 2.
    #[arg(long, value_name = "x,y,z", value_parser = direction, allow_hyphen_values = true, requires = "gravity")]
    gravity2: Option<Vector3<f64>>,
    #[command(flatten)]
    robust: RobustArguments,
}

/// Result of any model.
struct Found {
    model: Vec<f64>,
    inliers: Vec<bool>,
    iterations: usize,
    required_iterations: u64,
    stop: StopReason,
    could_be_random: bool,
    num_left_out: usize,
    /// For F and H: the part that the inliers do not determine, if any.
    not_determined: Option<Option<String>>,
    max_error_px: f64,
    errors_px: Vec<f64>,
    cam2_from_cam1: Option<RigidTransform>,
    could_be_rotation: Option<bool>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let of_motion = arguments.k.or(arguments.k2).is_some() || arguments.gravity.is_some();
    if arguments.model != Model::Essential && of_motion {
        return Err(Failure::usage(
            "--k, --k2 and --gravity are for --model essential only: the other models need none",
        ));
    }
    let [pixels1, pixels2] = match arguments.model {
        Model::Line => [match_file::points(&arguments.matches)?, Vec::new()],
        _ => match_file::matches(&arguments.matches)?,
    };
    if arguments.k.is_none() {
        let max_error_px = arguments.robust.options(context).max_error_px;
        warn_of_fractions(&[&pixels1, &pixels2], max_error_px, context);
    }
    let found = fit(arguments, context, &pixels1, &pixels2)
        .map_err(|failure| with_left_out(failure, arguments.model, [&pixels1, &pixels2]))?;
    let inlier_errors: Vec<f64> = found
        .errors_px
        .iter()
        .zip(&found.inliers)
        .filter(|(_, is_inlier)| **is_inlier)
        .map(|(error, _)| *error)
        .collect();
    let num_inliers = inlier_errors.len();
    let mean_error_px = inlier_errors.iter().sum::<f64>() / num_inliers.max(1) as f64;
    let mask: Vec<u8> = found
        .inliers
        .iter()
        .map(|is_inlier| u8::from(*is_inlier))
        .collect();
    let mut report = Report::default()
        .row("inliers", format!("{num_inliers} of {}", mask.len()))
        .row("iterations", found.iterations)
        .row("ended by", stop_word(found.stop))
        .row(
            "largest error of an inlier",
            threshold_words(&arguments.robust.options(context), found.max_error_px),
        )
        .row("mean error of inliers", format!("{mean_error_px:.3} px"));
    for (index, row) in found.model.chunks(3).enumerate() {
        let label = if index == 0 { "model" } else { "" };
        let words: Vec<String> = row.iter().map(|entry| format!("{entry:>14.6e}")).collect();
        report = report.row(label, words.join(" "));
    }
    report = report
        .field("model", found.model)
        .field("inliers", mask)
        .field("num_inliers", num_inliers)
        .field("iterations", found.iterations)
        .field(
            "required_iterations",
            (found.required_iterations != u64::MAX).then_some(found.required_iterations),
        )
        .field("stop", stop_word(found.stop))
        .field("could_be_random", found.could_be_random)
        .field("max_error_px", found.max_error_px)
        .field("mean_error_px", mean_error_px)
        .field("num_left_out", found.num_left_out);
    if found.num_left_out > 0 {
        let count = found.num_left_out;
        report = report.row("left out", format!("{count}, beyond 10⁹ pixels"));
    }
    if let Some(not_determined) = found.not_determined {
        report = report.field("not_determined", not_determined);
    }
    if let Some(motion) = &found.cam2_from_cam1 {
        report = report.field("cam2_from_cam1", Motion::from(motion));
    }
    if let Some(could_be_rotation) = found.could_be_rotation {
        report = report.field("could_be_rotation", could_be_rotation);
    }
    if let Some(path) = &arguments.output {
        let text = match_file::inliers(path, [&pixels1, &pixels2], &found.inliers);
        report = report.file(path, text.into_bytes())?;
    }
    Ok(report)
}

/// Adds the number of rows that the core left out to a failure for too few rows.
fn with_left_out(failure: Failure, model: Model, pixels: [&[Point2<f64>]; 2]) -> Failure {
    let farthest_px = match model {
        Model::Line => f64::MAX,
        _ => FARTHEST_PX,
    };
    let is_far = |list: &[Point2<f64>], index: usize| {
        list.get(index)
            .is_some_and(|pixel| pixel.coords.amax() > farthest_px)
    };
    let rows = 0..pixels[0].len();
    let far = rows.filter(|&index| pixels.iter().any(|list| is_far(list, index)));
    match far.count() {
        num_far @ 1.. if failure.kind == "too-few" => Failure {
            message: format!("{failure}; rows left out for being beyond 10⁹ pixels: {num_far}"),
            ..failure
        },
        _ => failure,
    }
}

fn fit(
    arguments: &Arguments,
    context: &Context,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Found, Failure> {
    let robust = &arguments.robust;
    let pairs = || pixels1.iter().zip(pixels2);
    let set = || MatchSet::new(pixels1, pixels2);
    match arguments.model {
        Model::Line => {
            let found = robust.run(LineEstimator::new(pixels1)?, context)?;
            let line = found.model;
            let error = |point: &Point2<f64>| line.signed_distance(point).abs();
            let errors = pixels1.iter().map(error).collect();
            Ok(of_report(found, vec![line.a, line.b, line.c], errors))
        }
        Model::Homography => {
            let found = robust.run(HomographyEstimator::new(set()?)?, context)?;
            let h = found.model;
            let errors = pairs().map(|(a, b)| transfer_error_px(&h, a, b)).collect();
            let open = left_open_by_homography(
                pixels1,
                pixels2,
                &found.inliers,
                &robust.options(context).within(found.max_error_px),
            )?;
            Ok(with_degeneracy(of_matrix(found, &h, errors), open, context))
        }
        Model::Fundamental => {
            let found = robust.run(FundamentalEstimator::new(set()?)?, context)?;
            let f = found.model;
            let errors = pairs().map(|(a, b)| sampson_px(&f, a, b)).collect();
            let open = left_open(
                pixels1,
                pixels2,
                &found.inliers,
                &robust.options(context).within(found.max_error_px),
            )?;
            Ok(with_degeneracy(of_matrix(found, &f, errors), open, context))
        }
        Model::Essential => {
            let k1 = arguments
                .k
                .ok_or_else(|| Failure::usage("an essential matrix needs --k fx,fy,cx,cy"))?;
            let k2 = arguments.k2.unwrap_or(k1);
            warn_of_units(pixels1, &k1, context);
            warn_of_units(pixels2, &k2, context);
            // The size of the images is unknown, and no estimator uses it.
            let cameras = [k1, k2].map(|k| Camera::pinhole(k, 0, 0));
            let cameras = cameras.each_ref();
            let found = match (&arguments.gravity, &arguments.gravity2) {
                (Some(down1), Some(down2)) => {
                    let gravity = [down1, down2];
                    let estimator = GravityEstimator::new(pixels1, pixels2, cameras, gravity)?;
                    let found = robust.run(estimator, context).map_err(|failure| {
                        if_unmoved(failure, pixels1, pixels2, &robust.options(context))
                    })?;
                    found.map(|(pose, _)| pose)
                }
                _ => robust.watched(context, |options, monitor| {
                    estimate_relative_pose(pixels1, pixels2, cameras, options, monitor)
                })?,
            };
            let pose = found.model;
            let f = pose.fundamental(&k1, &k2)?;
            let errors = pairs().map(|(a, b)| sampson_px(&f, a, b)).collect();
            let ransac = robust.options(context).within(found.max_error_px);
            let rotation_only =
                find_rotation_only(pixels1, pixels2, cameras, &found.inliers, &ransac)?;
            if let (Some(rotation_only), false) = (&rotation_only, found.could_be_random()) {
                context.warn(&rotation_only::sentence(rotation_only));
            }
            Ok(Found {
                cam2_from_cam1: Some(pose.cam2_from_cam1()),
                could_be_rotation: Some(rotation_only.is_some()),
                ..of_matrix(found, &pose.essential(), errors)
            })
        }
        Model::Similarity => {
            let found = robust.run(SimilarityEstimator::new(set()?), context)?;
            let similarity = found.model;
            let error = |(a, b): (&Point2<f64>, &Point2<f64>)| (similarity.apply(a) - b).norm();
            let errors = pairs().map(error).collect();
            Ok(of_matrix(found, &similarity.matrix(), errors))
        }
    }
}

/// Records what the inliers do not determine, and warns of it if they are significant.
fn with_degeneracy(found: Found, open: Option<String>, context: &Context) -> Found {
    if let (Some(sentence), false) = (&open, found.could_be_random) {
        context.warn(sentence);
    }
    Found {
        not_determined: Some(open),
        ..found
    }
}

fn of_matrix<M>(report: RansacReport<M>, matrix: &Matrix3<f64>, errors_px: Vec<f64>) -> Found {
    of_report(report, row_major(matrix).to_vec(), errors_px)
}

fn of_report<M>(report: RansacReport<M>, model: Vec<f64>, errors_px: Vec<f64>) -> Found {
    Found {
        model,
        could_be_random: report.could_be_random(),
        num_left_out: report.num_left_out,
        not_determined: None,
        max_error_px: report.max_error_px,
        inliers: report.inliers,
        iterations: report.iterations,
        required_iterations: report.required_iterations,
        stop: report.stop,
        errors_px,
        cam2_from_cam1: None,
        could_be_rotation: None,
    }
}
