//! Range of unknown focal lengths.

use crate::math::order::at_rank;
use core::ops::Range;

/// Minimum focal length, relative to the third quartile of the pixels' distances from the principal
/// point, which is robust to a few outliers far outside the image.
const LEAST_QUARTILES: f64 = 0.2;

/// Maximum focal length, relative to the distance of the farthest pixel: if three quarters of the
/// pixels are in the middle of the image, the quartile would exclude long lenses.
const MOST_REACHES: f64 = 20.0;

/// Returns the range of plausible focal lengths for pixels, in pixels.
///
/// * `distances_px`: distances of the pixels from their principal points, at least one; reordered
pub(crate) fn plausible_focals_px(distances_px: &mut [f64]) -> Range<f64> {
    let rank = distances_px.len() * 3 / 4;
    let quartile_px = at_rank(distances_px, rank);
    let reach_px = distances_px.iter().copied().fold(0.0, f64::max);
    LEAST_QUARTILES * quartile_px..MOST_REACHES * reach_px
}
