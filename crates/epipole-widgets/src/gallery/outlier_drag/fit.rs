//! F by the core's eight-point algorithm from matches with one outlier, and the effect on the
//! others.

use crate::kit::matches::{Match, distance_px};
use epipole::Error;
use epipole::epipolar::fundamental_8point_explained;
use nalgebra::{Matrix3, Point2, Vector2};

/// F, and the distances of the matches from their epipolar lines.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    pub(super) fundamental: Matrix3<f64>,
    /// Singular values of the stacked normalized rows, largest first.
    pub(super) singular_values: [f64; 9],
    /// Mean distance of the true matches from their lines in photograph 2, pixels.
    pub(super) mean_px: f64,
    /// Maximum of these distances, pixels.
    pub(super) worst_px: f64,
    /// Distance of the wrong match from its line, pixels.
    pub(super) wrong_px: f64,
    /// Number of true matches farther from their lines than the wrong one.
    pub(super) num_farther: usize,
}

impl Fit {
    /// Estimates F from the true matches and, if `is_heard`, the wrong one.
    ///
    /// # Errors
    /// As [`fundamental_8point_explained`].
    pub(super) fn new(truth: &[Match], wrong: &Match, is_heard: bool) -> Result<Self, Error> {
        let used = truth.iter().chain(is_heard.then_some(wrong));
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = used.copied().unzip();
        let found = fundamental_8point_explained(&pixels1, &pixels2)?;
        let fundamental = found.fundamental;
        let distance = |pair: &Match| distance_px(&fundamental, pair).unwrap_or(0.0);
        let distances: Vec<f64> = truth.iter().map(distance).collect();
        let wrong_px = distance(wrong);
        Ok(Self {
            fundamental,
            singular_values: found.singular_values,
            mean_px: distances.iter().sum::<f64>() / distances.len().max(1) as f64,
            worst_px: distances.iter().copied().fold(0.0, f64::max),
            num_farther: distances.iter().filter(|other| **other > wrong_px).count(),
            wrong_px,
        })
    }
}

/// Maximum displacement of the wrong match on the curve, pixels.
pub(super) const REACH_PX: f64 = 300.0;
/// Number of steps of the curve.
const NUM_STEPS: usize = 30;

/// Fits F while the wrong match moves from its true position in the direction of `wrong`: pairs of
/// displacement, pixels, and F.
pub(super) fn led_away(truth: &[Match], right: &Match, wrong: &Point2<f64>) -> Vec<(f64, Fit)> {
    let direction = (wrong - right.1)
        .try_normalize(1e-9)
        .unwrap_or(Vector2::y());
    let step = |index: usize| {
        let away_px = REACH_PX * index as f64 / NUM_STEPS as f64;
        let fit = Fit::new(truth, &(right.0, right.1 + direction * away_px), true).ok()?;
        Some((away_px, fit))
    };
    (0..=NUM_STEPS).filter_map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::matches::Matches;

    #[test]
    fn one_wrong_match_among_exact_ones_moves_all_lines() {
        let mut exact = Matches::draw(1).noisy(16, 0.0);
        let right = exact.remove(0);
        let good = Fit::new(&exact, &right, true).unwrap();
        assert!(good.worst_px < 1e-6 && good.wrong_px < 1e-6);
        let wrong = (right.0, right.1 + Vector2::new(0.0, 120.0));
        let bad = Fit::new(&exact, &wrong, true).unwrap();
        assert!(bad.mean_px > 1.0 && bad.worst_px > bad.mean_px);
        // Without the wrong match the others are unaffected, and its residual is large.
        let without = Fit::new(&exact, &wrong, false).unwrap();
        assert!(without.worst_px < 1e-6 && without.wrong_px > 20.0);
        assert_eq!(without.num_farther, 0);
        let led = led_away(&exact, &right, &wrong.1);
        assert_eq!(led.len(), NUM_STEPS + 1);
        assert!((led[12].0 - 120.0).abs() < 1e-9);
        assert!((led[12].1.mean_px - bad.mean_px).abs() < 1e-6);
    }
}
