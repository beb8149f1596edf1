//! `epipole two-view`: the geometry of two images.

mod arguments;
mod errors;
mod focal;
mod input;
mod search;

pub(crate) use self::arguments::Arguments;

use self::arguments::Model;
use self::input::Input;
use self::search::estimate;
use crate::context::Context;
use crate::failure::Failure;
use crate::match_file;
use crate::matrices::{Motion, row_major};
use crate::report::Report;
use crate::robust::threshold_words;

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    arguments.camera.check()?;
    if arguments.known.is_set() && arguments.model == Model::Fundamental {
        return Err(Failure::usage(
            "with --camera there is no fundamental matrix, which knows no lens: give --model auto, essential or \
             homography, or what epipole undistort makes of the images",
        ));
    }
    let Input {
        photos,
        pixels: [pixels1, pixels2],
        nums_keypoints,
    } = Input::read(arguments, context)?;
    if arguments.model == Model::Fundamental && arguments.camera.is_set() {
        context
            .warn("--k, --k2 and --focal-px make no difference here: this model needs pixels only");
    }
    let found = estimate(arguments, context, &photos, [&pixels1, &pixels2])?;

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
    let mut report = Report::default();
    if let Some([first, second]) = nums_keypoints {
        report = report.row("keypoints", format!("{first} and {second}"));
    }
    if let Some(path) = &arguments.output {
        let text = match_file::inliers(path, [&pixels1, &pixels2], &found.inliers);
        report = report.file(path, text.into_bytes())?;
    }
    Ok(report
        .row("matches", rows.len())
        .row("model", found.kind)
        .row("inliers", num_inliers)
        .row(
            "largest error of an inlier",
            threshold_words(&arguments.robust.options(context), found.max_error_px),
        )
        .row("mean error of inliers", format!("{mean_px:.3} px"))
        .row("configuration", found.configuration)
        .field("model_kind", found.kind)
        .field("model", row_major(&found.model))
        .field(
            "model_of",
            match arguments.known.is_set() || found.kind == "essential" {
                true => "rays",
                false => "pixels",
            },
        )
        .field("num_keypoints", nums_keypoints)
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
        .field("focals_px", found.focals_px)
        .field("max_error_px", found.max_error_px)
        .field("mean_sampson_px", mean_px)
        .field("configuration", found.configuration))
}
