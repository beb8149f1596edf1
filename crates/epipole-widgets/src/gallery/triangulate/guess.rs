//! The reader's guess of the uncertainty over the distance.

use super::uncertainty::Curves;
use crate::contract::format_number;
use crate::kit::guess::Curve;

/// Initial guess, decades of a centimeter.
pub(super) const START: f64 = 0.0;

/// Standard deviations along the rays at five distances; both axes are logarithmic, in meters and
/// centimeters.
pub(super) const CURVE: Curve<5> = Curve {
    panel: "plot",
    ids: ["guess1", "guess3", "guess10", "guess30", "guess80"],
    at: [
        0.0,
        0.477_121_254_719_662_4,
        1.0,
        1.477_121_254_719_662_4,
        1.903_089_986_991_943_5,
    ],
    range: [-1.0, 4.0],
    label: |at| format!("Guess at {} m", format_number(libm::exp10(at), 0)),
    told: |cm| format!("{} cm", format_number(cm, 1)),
};

/// Returns the true values at the guess's points, decades of a centimeter.
pub(super) fn truth(curves: &Curves) -> Option<[f64; 5]> {
    let mut truth = [0.0; 5];
    for (value, at) in truth.iter_mut().zip(CURVE.at) {
        *value = libm::log10(100.0 * curves.long_m_at(libm::exp10(at))?);
    }
    Some(truth)
}
