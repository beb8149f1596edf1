//! How likely a datum is an inlier, given its error.

use crate::imaging::approx::exp_negative;

/// Only data this many thresholds near to the model are looked at.
const WINDOW: f64 = 3.0;

/// Errors of inliers are normal with standard deviation σ in each coordinate, those of outliers
/// uniform within a window; σ and the share of inliers are found by expectation maximization.
///
/// The threshold is a guess of the caller's. Errors a tenth as large deserve a sharper weight, and
/// those that reach beyond it must not be cut off.
///
/// Source: Torr & Zisserman 2000, "MLESAC: a new robust estimator with application to estimating
/// image geometry"; Dempster, Laird & Rubin 1977 (the steps).
#[derive(Debug, Clone)]
pub(super) struct Mixture {
    /// Coordinates that an error has: 1 or 2.
    dimensions: usize,
    /// Data that determine a model: so many have no error of their own.
    sample_size: usize,
    window_px: f64,
    /// Bounds of σ².
    sigma_sq_range: [f64; 2],
    sigma_sq: f64,
    /// The share of inliers in the window.
    share: f64,
    has_converged: bool,
}

impl Mixture {
    pub(super) fn new(dimensions: usize, sample_size: usize, max_error_px: f64) -> Self {
        let threshold_sq = max_error_px * max_error_px;
        Self {
            dimensions,
            sample_size,
            window_px: WINDOW * max_error_px,
            sigma_sq_range: [0.01 * threshold_sq, 0.25 * WINDOW * WINDOW * threshold_sq],
            sigma_sq: threshold_sq,
            share: 0.8,
            has_converged: false,
        }
    }

    /// How far from the model the data may be, pixels.
    pub(super) fn window_px(&self) -> f64 {
        self.window_px
    }

    /// Whether the last step left σ as it was, within a two-thousandth.
    pub(super) fn has_converged(&self) -> bool {
        self.has_converged
    }

    /// One step: the weights that σ and the share give, and the σ and the share that these give.
    ///
    /// * `errors_sq`: of the data in the window
    /// * `weights`: filled with the probabilities that the data are inliers
    pub(super) fn improve(&mut self, errors_sq: &[f64], weights: &mut Vec<f64>) {
        // The density of outliers over that of inliers without error: 1/W over √(2/π)/σ for
        // distances from a line, 2e/W² over e/σ² for distances from a point.
        let ratio = self.sigma_sq / (self.window_px * self.window_px);
        let background = if self.dimensions == 1 {
            (core::f64::consts::FRAC_PI_2 * ratio).sqrt()
        } else {
            2.0 * ratio
        };
        let odds = (background * (1.0 - self.share) / self.share).max(f64::MIN_POSITIVE);
        let slope = -0.5 / self.sigma_sq;
        let (mut total, mut total_sq) = (0.0, 0.0);
        weights.clear();
        for &error_sq in errors_sq {
            let density = f64::from(exp_negative((slope * error_sq) as f32));
            let weight = density / (density + odds);
            total += weight;
            total_sq += weight * error_sq;
            weights.push(weight);
        }
        let freedom = (total - self.sample_size as f64).max(1.0) * self.dimensions as f64;
        let [least, most] = self.sigma_sq_range;
        let sigma_sq = (total_sq / freedom).clamp(least, most);
        self.has_converged = (sigma_sq - self.sigma_sq).abs() < 1e-3 * self.sigma_sq;
        self.sigma_sq = sigma_sq;
        self.share = (total / errors_sq.len().max(1) as f64).clamp(0.01, 0.999);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// σ and the share of inliers, whether errors are a tenth of the threshold or as large; then the
    /// window cuts off their tail, and both come out too small.
    #[test]
    fn the_width_of_errors_is_found() {
        for dimensions in [1, 2] {
            for (sigma, off_sigma, off_share) in [
                (0.1, 0.04, 0.03),
                (0.2, 0.04, 0.03),
                (0.6, 0.04, 0.03),
                (1.0, 0.12, 0.1),
            ] {
                let mut random = Random::new(3);
                let errors_sq: Vec<f64> = (0..4000)
                    .map(|i| {
                        if i % 4 == 0 {
                            // Uniform in the window of 3 px: on a line, or in a disk.
                            let u = random.uniform(0.0, 1.0);
                            9.0 * if dimensions == 1 { u * u } else { u }
                        } else {
                            let mut square = || {
                                let e = sigma * random.normal();
                                e * e
                            };
                            (0..dimensions).map(|_| square()).sum()
                        }
                    })
                    .filter(|e| *e < 9.0)
                    .collect();
                let mut mixture = Mixture::new(dimensions, 4, 1.0);
                let mut weights = Vec::new();
                for _ in 0..60 {
                    mixture.improve(&errors_sq, &mut weights);
                }
                assert!(mixture.has_converged());
                let (found, share) = (mixture.sigma_sq.sqrt(), mixture.share);
                assert!(
                    (found / sigma - 1.0).abs() < off_sigma && (share - 0.75).abs() < off_share,
                    "{dimensions} {sigma}: {found} {share}"
                );
                assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)));
            }
        }
    }

    #[test]
    fn exact_data_count_in_full() {
        let mut mixture = Mixture::new(1, 7, 1.0);
        let mut weights = Vec::new();
        for _ in 0..20 {
            mixture.improve(&[0.0; 50], &mut weights);
        }
        assert!(mixture.has_converged() && weights.iter().all(|w| *w > 0.999));
        mixture.improve(&[], &mut weights);
        assert!(weights.is_empty() && mixture.sigma_sq.is_finite());
    }
}
