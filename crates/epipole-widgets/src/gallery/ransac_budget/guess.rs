//! The reader's guess for the curve of the largest samples.

use crate::contract::format_number;
use crate::kit::guess::Curve;

/// Panel of the curves.
pub(super) const PLOT: &str = "plot";
/// Initial guess, decades.
pub(super) const START: f64 = 2.0;

/// Numbers of samples at five inlier ratios.
pub(super) const CURVE: Curve<5> = Curve {
    panel: PLOT,
    ids: ["guess30", "guess45", "guess60", "guess75", "guess90"],
    at: [0.3, 0.45, 0.6, 0.75, 0.9],
    range: [0.0, 6.0],
    label: |ratio| format!("Guess at {}% inliers", format_number(100.0 * ratio, 0)),
    told: |count| format!("{} samples", format_number(count, 0)),
};
