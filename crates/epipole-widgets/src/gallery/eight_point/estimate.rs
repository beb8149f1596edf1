//! F from matches by the core's eight-point algorithm, and its quality.

use crate::kit::matches::{Match, mean_distance_px};
use crate::kit::meeting::Meeting;
use epipole::epipolar::{
    EightPoint, fundamental_8point_explained, fundamental_8point_unnormalized,
};
use nalgebra::Matrix3;

/// F with and without normalization, and the quality of the selected one.
pub(super) struct Estimate {
    /// Matches used to estimate F.
    pub(super) used: Vec<Match>,
    pub(super) normalized: EightPoint,
    pub(super) raw: EightPoint,
    is_normalized: bool,
    /// F with the normalization and the rank selected by the toggles.
    pub(super) fundamental: Matrix3<f64>,
    /// Intersection of the matches' epipolar lines, exact or nearly so.
    pub(super) meeting: Option<Meeting>,
    /// Mean distance of a match from its epipolar line in photograph 2, pixels.
    pub(super) used_px: f64,
    /// The same for exact matches held out of the estimation.
    pub(super) held_out_px: f64,
}

impl Estimate {
    /// Estimates F from `used`, and evaluates it on `held_out`.
    ///
    /// # Errors
    /// As [`fundamental_8point_explained`].
    pub(super) fn new(
        used: Vec<Match>,
        held_out: &[Match],
        is_normalized: bool,
        has_rank2: bool,
    ) -> Result<Self, epipole::Error> {
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = used.iter().copied().unzip();
        let normalized = fundamental_8point_explained(&pixels1, &pixels2)?;
        let raw = fundamental_8point_unnormalized(&pixels1, &pixels2)?;
        let chosen = if is_normalized { &normalized } else { &raw };
        let fundamental = if has_rank2 {
            chosen.fundamental
        } else {
            chosen.full_rank
        };
        Ok(Self {
            fundamental,
            meeting: Meeting::of(&fundamental, &pixels1),
            used_px: mean_distance_px(&fundamental, &used),
            held_out_px: mean_distance_px(&fundamental, held_out),
            used,
            normalized,
            raw,
            is_normalized,
        })
    }

    /// Returns the singular values of the stacked rows without and with normalization, largest
    /// first.
    pub(super) fn singular_values(&self) -> [&[f64; 9]; 2] {
        [&self.raw.singular_values, &self.normalized.singular_values]
    }

    /// Returns the solution in use.
    pub(super) fn chosen(&self) -> &EightPoint {
        if self.is_normalized {
            &self.normalized
        } else {
            &self.raw
        }
    }
}
