//! Cameras that only turned: E and F mean nothing then, though they fit.

use epipole::camera::Intrinsics;
use epipole::robust::RansacOptions;
use epipole::two_view::{ExplainingTurn, TwoViewOptions, find_explaining_turn};
use nalgebra::Point2;

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
