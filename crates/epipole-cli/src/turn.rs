//! Cameras that only turned, or hardly moved: E and F mean nothing then, though they fit.

use epipole::camera::Intrinsics;
use epipole::homography::estimate_homography;
use epipole::robust::RansacOptions;
use epipole::two_view::{ExplainingTurn, TwoViewOptions, find_explaining_turn};
use nalgebra::Point2;

/// Samples of four matches, at most: where a homography explains nearly all, a tenth is plenty.
const MAX_SAMPLES: usize = 500;

/// The turn that explains the inliers of another model as well, if there is one.
///
/// * `ransac`: those that the model was found with
pub(crate) fn find_turn(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    [k1, k2]: &[Intrinsics; 2],
    inliers: &[bool],
    ransac: &RansacOptions,
) -> epipole::Result<Option<ExplainingTurn>> {
    let options = TwoViewOptions {
        ransac: *ransac,
        ..TwoViewOptions::default()
    };
    find_explaining_turn(pixels1, pixels2, k1, k2, inliers, &options)
}

/// What there is to warn of.
pub(crate) fn sentence(turn: &ExplainingTurn) -> String {
    format!(
        "a camera that only turned explains {} of the {} inliers: whether and in which direction it \
         moved cannot be told",
        turn.num_explained, turn.num_inliers
    )
}

/// A homography has to fit in two dimensions, in an image with the noise of both; so many times the threshold
/// holds as many of the right matches as that of an epipolar line.
const IN_TWO_DIMENSIONS: f64 = 1.25 * core::f64::consts::SQRT_2;

/// What the inliers of a model leave open, as a sentence, where they do.
///
/// * `is_epipolar`: whether the model is F, which neither a plane nor a turn determines
pub(crate) fn left_open(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
    is_epipolar: bool,
    ransac: &RansacOptions,
) -> Option<String> {
    let share = TwoViewOptions::default().max_homography_share;
    let (in1, in2): (Vec<_>, Vec<_>) = (pixels1.iter().zip(pixels2).zip(inliers))
        .filter(|(_, is)| **is)
        .map(|((p1, p2), _)| (*p1, *p2))
        .unzip();
    let count = in1.len();
    let nearly_all = |part: usize| count > 0 && part as f64 >= share * count as f64;
    let reach_px = IN_TWO_DIMENSIONS * ransac.max_error_px;
    let moved = |(p1, p2): &(&Point2<f64>, &Point2<f64>)| (*p1 - *p2).norm() >= reach_px;
    let still = count - in1.iter().zip(&in2).filter(moved).count();
    if nearly_all(still) {
        return Some(format!(
            "{still} of the {count} inliers are where they were in image 1, but for noise: the \
             camera hardly moved, or the matches are of something that moves with it"
        ));
    }
    if !is_epipolar {
        return None;
    }
    let options = RansacOptions {
        max_error_px: IN_TWO_DIMENSIONS * ransac.max_error_px,
        max_iterations: ransac.max_iterations.min(MAX_SAMPLES),
        ..*ransac
    };
    let num_explained = estimate_homography(&in1, &in2, &options).ok()?.num_inliers;
    nearly_all(num_explained).then(|| {
        format!(
            "a homography explains {num_explained} of the {count} inliers: they show a plane, or the camera \
             only turned, and the fundamental matrix is not determined"
        )
    })
}
