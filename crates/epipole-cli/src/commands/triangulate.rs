//! `epipole triangulate`: points of the world from matches of two posed images.

mod cameras;
mod judge;
mod output;

use self::judge::{Point, Summary};
use crate::context::Context;
use crate::failure::Failure;
use crate::match_file;
use crate::report::Report;
use crate::units::warn_of_units;
use clap::Args;
use std::path::PathBuf;

const EXAMPLE: &str =
    "Example: epipole triangulate matches.txt reconstruction/ --images a.jpg,b.jpg -o points.ply";

/// Triangulate matches of two images with known poses.
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLE,
    after_long_help = "Example: epipole triangulate matches.txt reconstruction/ --images a.jpg,b.jpg -o points.ply\n\n\
    Cameras are a model of COLMAP (text, binary), Bundler, nerfstudio (transforms.json) or openMVG (sfm_data.json), a\n\
    file of a stereo rig (epipole calibrate, OpenCV, Kalibr, MATLAB), whose world is the left camera, or two files\n\
    with a pose each, as epipole pnp --json prints them.\n\n\
    A file of matches has one match per line, u1 v1 u2 v2, in pixels of the two images in the order of the cameras;\n\
    epipole match -o writes one. Each point minimizes the reprojection error.\n\n\
    JSON: points ([x, y, z, error_px, angle_deg] for each match: coordinates in the unit of the cameras, root mean\n\
    square of both reprojection errors, angle at which the rays meet; null where there is no point), num_points,\n\
    mean_error_px, median_angle_deg (both null without points), baseline (distance of the cameras), images (names of\n\
    the model, or null), num_parallel (matches whose rays do not meet), num_behind (matches that meet behind a\n\
    camera), files."
)]
pub(crate) struct Arguments {
    /// Text file with u1 v1 u2 v2 per line; - for standard input.
    matches: PathBuf,
    /// Model, rig, or camera 1 with its pose (any supported format).
    #[arg(value_name = "MODEL|CAMERA1")]
    cameras: PathBuf,
    /// File of camera 2 with its pose.
    #[arg(value_name = "CAMERA2")]
    second: Option<PathBuf>,
    /// Names of the two images (of the model; optional if it has only two).
    #[arg(long, value_name = "NAME1,NAME2")]
    images: Option<String>,
    /// Write the points (.ply, or .csv with the columns of the JSON; -: CSV on standard output).
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let writer = arguments
        .output
        .as_deref()
        .map(output::writer)
        .transpose()?;
    let (cameras, names) = cameras::read(
        &arguments.cameras,
        arguments.second.as_deref(),
        arguments.images.as_deref(),
    )?;
    let pixels = match_file::matches(&arguments.matches)?;
    for (pixels, camera) in pixels.iter().zip(&cameras) {
        warn_of_units(pixels, &camera.camera.intrinsics, context);
    }
    let found = judge::triangulate(&cameras, &pixels)
        .map_err(|failure| failure.about(&arguments.matches))?;
    let summary = Summary::new(&cameras, &found);
    judge::warn(&summary, &cameras, &pixels, context);
    let points: Vec<Option<Point>> = found.into_iter().map(Result::ok).collect();
    let mut files = Vec::new();
    let mut report = Report::default();
    if let (Some(path), Some(writer)) = (&arguments.output, writer) {
        report = report.file(path, writer(&points))?;
        files.push(path.display().to_string());
    }
    report = report
        .row(
            "points",
            format!("{} of {} matches", summary.num_points, points.len()),
        )
        .row(
            "baseline",
            format!("{:.6}, in the unit of the cameras", summary.baseline),
        );
    if let (Some(error_px), Some(angle_deg)) = (summary.mean_error_px, summary.median_angle_deg) {
        report = report
            .row("mean error", format!("{error_px:.3} px"))
            .row("rays meet at", format!("{angle_deg:.2}° in the median"));
    }
    for file in &files {
        report = report.row("written", file);
    }
    let rows: Vec<Option<[f64; 5]>> = points.iter().map(|point| point.map(Point::row)).collect();
    Ok(report
        .field("points", rows)
        .field("num_points", summary.num_points)
        .field("mean_error_px", summary.mean_error_px)
        .field("median_angle_deg", summary.median_angle_deg)
        .field("baseline", summary.baseline)
        .field("images", names)
        .field("num_parallel", summary.num_parallel)
        .field("num_behind", summary.num_behind)
        .field("files", files))
}
