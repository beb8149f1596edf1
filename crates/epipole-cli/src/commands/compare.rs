//! `epipole compare`: errors of an estimated trajectory.

mod associate;
mod errors;
mod plot;
mod poses;

use self::associate::{Association, associate};
use self::errors::{PoseErrors, Statistics, absolute_errors, relative_errors};
use self::plot::Plot;
use self::poses::Poses;
use crate::context::Context;
use crate::failure::Failure;
use crate::matrices::{Motion, positive};
use crate::report::Report;
use crate::{files, listing};
use clap::{Args, ValueEnum};
use epipole::camera::RigidTransform;
use epipole::sfm::{AlignmentKind, align_points};
use nalgebra::{Point3, Similarity3, Vector3};
use serde_json::json;
use std::path::PathBuf;

/// Alignment of the estimate before errors are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Align {
    /// Position and orientation.
    Se3,
    /// Position, orientation and scale, for one moving camera.
    Sim3,
    /// None: both are in one frame.
    None,
}

/// Ratio of sizes beyond which the units of length differ.
const OTHER_UNIT: f64 = 1.2;

/// Compare an estimated trajectory with ground truth.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole compare groundtruth.txt estimate.txt --align sim3 --plot errors.svg\n\n\
    Reads TUM (t tx ty tz qx qy qz qw), KITTI (12 numbers) and EuRoC (CSV in nanoseconds), recognized by content,\n\
    and the images of models (COLMAP, Bundler, nerfstudio, openMVG). Each pose of the trajectory with fewer poses\n\
    is compared with the nearest in time of the other; images of two models are paired by name; all others by\n\
    index, images in the order of their names. Errors are those of evo: APE after alignment, RPE over all pairs\n\
    --step poses apart.\n\n\
    JSON: ate_rmse_m, rpe_rmse (translation), scale and truth_from_estimate of the alignment, ape and rpe\n\
    (translation_m and rotation_deg with rmse, mean, median, std, min, max, sse), num_pairs, num_poses (of both),\n\
    associated_by (time, name or index), formats."
)]
pub(crate) struct Arguments {
    /// Ground-truth trajectory, or a model.
    truth: PathBuf,
    /// Estimated trajectory, or a model.
    estimate: PathBuf,
    /// Alignment of the estimate.
    #[arg(long, value_enum, default_value = "se3")]
    align: Align,
    /// Maximum time difference (of paired poses, seconds).
    #[arg(long, default_value_t = 0.01, value_name = "S", value_parser = positive)]
    max_difference_s: f64,
    /// Pair poses by index, ignoring their times.
    #[arg(long)]
    by_index: bool,
    /// Step of the RPE, poses.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    step: u32,
    /// Plot both paths from above, and the error over time.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    if let Some(path) = &arguments.plot
        && !files::is_standard(path)
        && !(path.extension()).is_some_and(|ending| ending.eq_ignore_ascii_case("svg"))
    {
        return Err(Failure::usage(format!(
            "--plot writes SVG: the name of {} must end in .svg",
            path.display()
        )));
    }
    let paths = [&arguments.truth, &arguments.estimate];
    let both = [Poses::read(paths[0])?, Poses::read(paths[1])?];
    for (poses, path) in both.iter().zip(paths) {
        for note in &poses.trajectory.notes {
            context.warn(&format!("{}: {note}", path.display()));
        }
    }
    let max_difference_s = (!arguments.by_index).then_some(arguments.max_difference_s);
    let Association { pairs, by } = associate(&both, max_difference_s)?;
    let [truth, estimate] = both.each_ref().map(|poses| &poses.trajectory);
    let fewer = truth
        .world_from_cam
        .len()
        .min(estimate.world_from_cam.len());
    if pairs.len() < fewer {
        let lacking = match by {
            "name" => "image of their name".to_owned(),
            _ => format!("other within {} s", arguments.max_difference_s),
        };
        let count = fewer - pairs.len();
        context.warn(&format!(
            "{count} of {fewer} poses have no {lacking}, and are left out"
        ));
    }
    let truths: Vec<RigidTransform> = pairs
        .iter()
        .map(|&(i, _)| truth.world_from_cam[i])
        .collect();
    let estimates: Vec<RigidTransform> =
        (pairs.iter().map(|&(_, j)| estimate.world_from_cam[j])).collect();
    let alignment = align(&estimates, &truths, arguments.align)?;
    warn_of_scale(&estimates, &truths, arguments.align, context);
    let aligned: Vec<RigidTransform> = (estimates.iter())
        .map(|pose| {
            let center = alignment * Point3::from(pose.translation.vector);
            let rotation = alignment.isometry.rotation * pose.rotation;
            RigidTransform::from_parts(center.coords.into(), rotation)
        })
        .collect();
    let ape = absolute_errors(&truths, &aligned);
    let step = arguments.step as usize;
    let rpe = relative_errors(&truths, &aligned, step).ok_or_else(|| epipole::Error::TooFew {
        what: "a relative pose error from poses",
        needed: step.saturating_add(1),
        got: pairs.len(),
    })?;
    let mut report = Report::default();
    if let Some(path) = &arguments.plot {
        let stamps: Option<Vec<i64>> = (truth.stamps_ns.as_ref())
            .map(|stamps| pairs.iter().map(|&(i, _)| stamps[i]).collect());
        let at: Vec<f64> = match &stamps {
            Some(stamps) => (stamps.iter())
                .map(|&stamp| (i128::from(stamp) - i128::from(stamps[0])) as f64 / 1e9)
                .collect(),
            None => (0..pairs.len()).map(|n| n as f64).collect(),
        };
        let plot = Plot {
            names: paths.map(|path| listing::file_name(path)),
            truth: &centers(&truths),
            estimate: &centers(&aligned),
            at: &at,
            at_label: if stamps.is_some() { "time (s)" } else { "pose" },
            rmse_m: ape.translation_m.rmse,
        };
        report = report.file(path, plot.svg().into_bytes())?;
    }
    report = report
        .field("ate_rmse_m", ape.translation_m.rmse)
        .field("rpe_rmse", rpe.translation_m.rmse)
        .field("scale", alignment.scaling())
        .field("truth_from_estimate", Motion::from(&alignment.isometry))
        .field("ape", ape)
        .field("rpe", rpe)
        .field("num_pairs", pairs.len())
        .field(
            "num_poses",
            [truth.world_from_cam.len(), estimate.world_from_cam.len()],
        )
        .field("associated_by", by)
        .field("formats", json!(both.each_ref().map(|poses| poses.format)))
        .row(
            "compared",
            format!(
                "{} poses by {by}: {} of {}, {} of {}",
                pairs.len(),
                truth.world_from_cam.len(),
                listing::file_name(paths[0]),
                estimate.world_from_cam.len(),
                listing::file_name(paths[1])
            ),
        )
        .row("scale", format!("{:.6}", alignment.scaling()));
    Ok(rows(rows(report, "APE", &ape), "RPE", &rpe))
}

fn rows(report: Report, name: &str, errors: &PoseErrors) -> Report {
    let row = |s: &Statistics, unit: &str| {
        format!(
            "rmse {:.6} {unit}, mean {:.6}, median {:.6}, std {:.6}, {:.6} to {:.6}",
            s.rmse, s.mean, s.median, s.std, s.min, s.max
        )
    };
    report
        .row(name, row(&errors.translation_m, "m"))
        .row(&format!("{name} rotation"), row(&errors.rotation_deg, "°"))
}

fn centers(poses: &[RigidTransform]) -> Vec<Point3<f64>> {
    (poses.iter().map(|pose| pose.translation.vector.into())).collect()
}

/// Warns of an estimate in another unit, which a rigid alignment cannot correct.
fn warn_of_scale(
    estimates: &[RigidTransform],
    truths: &[RigidTransform],
    how: Align,
    context: &Context,
) {
    if how == Align::Sim3 {
        return;
    }
    let Ok(similar) = align(estimates, truths, Align::Sim3) else {
        return;
    };
    let size = |poses: &[RigidTransform]| -> f64 {
        let all = centers(poses);
        let sum = all.iter().fold(Vector3::zeros(), |sum, at| sum + at.coords);
        let middle = Point3::from(sum / all.len() as f64);
        all.iter().map(|at| (at - middle).norm()).sum()
    };
    // Errors change the ratio of sizes too, so both must agree.
    let (scale, ratio) = (similar.scaling(), size(truths) / size(estimates));
    let is_other = |x: f64| x.is_finite() && !(1.0 / OTHER_UNIT..OTHER_UNIT).contains(&x);
    if is_other(scale) && is_other(ratio) {
        context.warn(&format!(
            "the estimate is {:.3} times as large as the truth: --align sim3 also aligns the scale",
            1.0 / ratio
        ));
    }
}

/// Returns `truth_from_estimate`.
fn align(
    estimates: &[RigidTransform],
    truths: &[RigidTransform],
    align: Align,
) -> Result<Similarity3<f64>, Failure> {
    let kind = match align {
        Align::Se3 => AlignmentKind::Rigid,
        Align::Sim3 => AlignmentKind::Similarity,
        Align::None => return Ok(Similarity3::identity()),
    };
    align_points(&centers(estimates), &centers(truths), kind).map_err(|error| {
        let failure = Failure::from(error);
        let message = format!("{}; --align none compares without", failure.message);
        Failure::new(failure.kind, message)
    })
}
