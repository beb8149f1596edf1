//! The range of focal lengths in which unknown ones are sought.

use crate::math::order::at_rank;
use core::ops::Range;

/// The least focal length, in third quartiles of the distances of pixels from the principal point,
/// of which a few wrong pixels far outside of the image move none.
const LEAST_QUARTILES: f64 = 0.2;

/// The greatest focal length, in distances of the farthest pixel: where three of four are in the
/// middle of the image, the quartile would leave out long lenses.
const MOST_REACHES: f64 = 20.0;

/// Focal lengths that are plausible for pixels, in pixels.
///
/// * `distances_px`: of the pixels from their principal points, one at least; comes back in another
///   order
pub(crate) fn plausible_focals_px(distances_px: &mut [f64]) -> Range<f64> {
    let rank = distances_px.len() * 3 / 4;
    let quartile_px = at_rank(distances_px, rank);
    let reach_px = distances_px.iter().copied().fold(0.0, f64::max);
    LEAST_QUARTILES * quartile_px..MOST_REACHES * reach_px
}
