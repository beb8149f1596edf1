//! `epipole fit`: a model through matches or points of which some are wrong.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::matrices::{Motion, intrinsics, row_major};
use crate::report::Report;
use crate::robust::RobustArguments;
use clap::{Args, ValueEnum};
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::epipolar::{estimate_relative_pose, find_fundamental, sampson_px};
use epipole::homography::{find_homography, transfer_error_px};
use epipole::robust::{LineEstimator, MatchSet, RansacReport, SimilarityEstimator, ransac};
use nalgebra::{Matrix3, Point2, Translation3, UnitQuaternion};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Model {
    /// a u + b v + c = 0 through points: the first two columns.
    Line,
    /// x2 ∝ H x1.
    Homography,
    /// x2ᵀ F x1 = 0.
    Fundamental,
    /// The same for known intrinsics; also gives the motion.
    Essential,
    /// Turn, scale and shift.
    Similarity,
}

/// Fit a model to matches of which some are wrong.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole fit --model fundamental matches.txt --max-error-px 1\n\n\
    A file of matches has one a line, u1 v1 u2 v2; further columns are ignored, # begins a comment."
)]
pub(crate) struct Arguments {
    /// What to fit.
    #[arg(long, value_enum)]
    model: Model,
    /// A text file with one match a line.
    matches: PathBuf,
    #[command(flatten)]
    robust: RobustArguments,
    /// Intrinsics of the first camera, for the essential matrix.
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k: Option<Intrinsics>,
    /// Intrinsics of the second camera; those of the first if not given.
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k2: Option<Intrinsics>,
}

/// What was found, whatever the model.
struct Found {
    model: Vec<f64>,
    inliers: Vec<bool>,
    iterations: usize,
    errors_px: Vec<f64>,
    cam2_from_cam1: Option<RigidTransform>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let columns = if arguments.model == Model::Line { 2 } else { 4 };
    let rows = read(arguments, columns)?;
    let at = |row: &Vec<f64>, column: usize| Point2::new(row[column], row[column + 1]);
    let pixels1: Vec<Point2<f64>> = rows.iter().map(|row| at(row, 0)).collect();
    let pixels2: Vec<Point2<f64>> = match columns {
        2 => Vec::new(),
        _ => rows.iter().map(|row| at(row, 2)).collect(),
    if arguments.model != Model::Essential && (arguments.k.is_some() || arguments.k2.is_some()) {
        return Err(Failure::usage(
            "--k and --k2 are for --model essential only: the other models need no intrinsics",
        ));
    }
    };
    let found = fit(arguments, context, &pixels1, &pixels2)?;
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
        .field("mean_error_px", mean_error_px);
    if let Some(motion) = &found.cam2_from_cam1 {
        report = report.field("cam2_from_cam1", Motion::from(motion));
    }
    Ok(report)
}

fn fit(
    arguments: &Arguments,
    context: &Context,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Found, Failure> {
    let options = arguments.robust.options(context);
    let pairs = || pixels1.iter().zip(pixels2);
    match arguments.model {
        Model::Line => {
            let found = ransac(LineEstimator::new(pixels1)?, &options)?;
            let line = found.model;
            let error = |point: &Point2<f64>| line.signed_distance(point).abs();
            Ok(Found {
                model: vec![line.a, line.b, line.c],
                errors_px: pixels1.iter().map(error).collect(),
                iterations: found.iterations,
                inliers: found.inliers,
                cam2_from_cam1: None,
            })
        }
        Model::Homography => {
            let found = find_homography(pixels1, pixels2, &options)?;
            let errors = pairs()
                .map(|(a, b)| transfer_error_px(&found.model, a, b))
                .collect();
            Ok(of_matrix(&found, &found.model, errors, None))
        }
        Model::Fundamental => {
            let found = find_fundamental(pixels1, pixels2, &options)?;
            let errors = pairs()
                .map(|(a, b)| sampson_px(&found.model, a, b))
                .collect();
            Ok(of_matrix(&found, &found.model, errors, None))
        }
        Model::Essential => {
            let k1 = arguments
                .k
                .ok_or_else(|| Failure::usage("an essential matrix needs --k fx,fy,cx,cy"))?;
            let k2 = arguments.k2.unwrap_or(k1);
            let found = estimate_relative_pose(pixels1, pixels2, &k1, &k2, &options)?;
            let pose = &found.model;
            let errors = pairs()
                .map(|(a, b)| sampson_px(&pose.fundamental, a, b))
                .collect();
            let rotation = UnitQuaternion::from_matrix(&pose.rotation);
            let motion = RigidTransform::from_parts(Translation3::from(pose.direction), rotation);
            Ok(of_matrix(&found, &pose.essential(), errors, Some(motion)))
        }
        Model::Similarity => {
            let estimator = SimilarityEstimator::new(MatchSet::new(pixels1, pixels2)?);
            let found = ransac(estimator, &options)?;
            let matrix = found.model.matrix();
            let error = |(a, b): (&Point2<f64>, &Point2<f64>)| (found.model.apply(a) - b).norm();
            let errors = pairs().map(error).collect();
            Ok(of_matrix(&found, &matrix, errors, None))
        }
    }
}

fn of_matrix<M>(
    report: &RansacReport<M>,
    matrix: &Matrix3<f64>,
    errors_px: Vec<f64>,
    cam2_from_cam1: Option<RigidTransform>,
) -> Found {
    Found {
        model: row_major(matrix).to_vec(),
        inliers: report.inliers.clone(),
        iterations: report.iterations,
        errors_px,
        cam2_from_cam1,
    }
}

fn read(arguments: &Arguments, columns: usize) -> Result<Vec<Vec<f64>>, Failure> {
    let text = files::read_text(&arguments.matches)?;
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        let numbers: Vec<f64> = line
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|word| !word.is_empty())
            .take(columns)
            .map_while(|word| word.parse().ok())
            .collect();
        if numbers.len() < columns || !numbers.iter().all(|number| number.is_finite()) {
            let place = format!("{}:{}", arguments.matches.display(), index + 1);
            let message = format!("{place}: here should be {columns} numbers, not \"{line}\"");
            return Err(Failure::new("malformed", message));
        }
        rows.push(numbers);
    }
    Ok(rows)
}
