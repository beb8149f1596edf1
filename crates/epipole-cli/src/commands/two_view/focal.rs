//! Intrinsics of two photos with an unknown focal length.

use super::arguments::Arguments;
use crate::camera::centered;
use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::photo::Photo;
use epipole::camera::Intrinsics;
use epipole::epipolar::{PoseWithFocal, estimate_relative_pose_and_focal};
use epipole::robust::RansacReport;
use nalgebra::Point2;

/// Maximum number of samples of six matches; each takes as long as ten of five.
const MAX_SAMPLES: usize = 2000;

/// Returns the given intrinsics; or, if neither command line nor EXIF data have a focal length, the
/// one that the matches determine for both photos; or else a guess. Warns of the latter two.
///
/// # Errors
/// As [`PairArguments::or_guess`](crate::camera::PairArguments::or_guess).
pub(super) fn intrinsics(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<[Intrinsics; 2], Failure> {
    let (intrinsics, guess) = arguments.camera.or_guess(photos)?;
    let Some(sentence) = guess else {
        return Ok(intrinsics);
    };
    let is_silent = photos.iter().all(|photo| photo.focal_px.is_none())
        && photos[0].color.dimensions() == photos[1].color.dimensions();
    if !is_silent {
        context.warn(&sentence);
        return Ok(intrinsics);
    }
    let middle = intrinsics[0].principal_point();
    let options = arguments.options(context);
    let ransac = options
        .ransac
        .with_max_iterations(options.ransac.max_iterations.min(MAX_SAMPLES));
    let is_telling = |report: &RansacReport<PoseWithFocal>| {
        report.num_unique_inliers >= options.min_num_inliers
            && !report.could_be_random()
            && report.model.constrains_focal()
    };
    let found = estimate_relative_pose_and_focal(
        pixels1,
        pixels2,
        &middle,
        &middle,
        &ransac,
        &mut interrupt::watch,
    );
    if found == Err(epipole::Error::Canceled) {
        return Err(epipole::Error::Canceled.into());
    }
    let Some(PoseWithFocal {
        focal_px,
        focal_std_px: Some(std_px),
        ..
    }) = found.ok().filter(is_telling).map(|report| report.model)
    else {
        context.warn(&format!(
            "{sentence}; the matches do not tell it, as where the axes of the cameras are parallel or meet \
             at the same distance from both"
        ));
        return Ok(intrinsics);
    };
    context.warn(&format!(
        "no --k or --focal-px: taking {focal_px:.0} px, which the matches tell to ± {std_px:.0}"
    ));
    let k = centered(focal_px, &photos[0])?;
    Ok([k, k])
}
