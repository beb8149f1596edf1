//! Robust losses, which bound the influence of residuals.

use crate::{Error, Result};

/// A loss ρ applied to the squared length `s = ‖r‖²` of a residual; the cost is `½ Σ ρ(s)`.
///
/// Every loss behaves as `ρ(s) = s` for small residuals. The width is the limit of this range, in
/// the unit of the residual (pixels for reprojection errors, and so on).
///
/// Source: Triggs, McLauchlan, Hartley & Fitzgibbon 2000, "Bundle adjustment — a modern
/// synthesis", §3.3; Huber 1964.
///
/// ```
/// use epipole::optim::RobustLoss;
/// let huber = RobustLoss::Huber { width: 2.0 };
/// assert_eq!(huber.rho(1.0), 1.0);
/// // A residual of length 10: 2 · 2 · 10 − 2².
/// assert_eq!(huber.rho(100.0), 36.0);
/// assert_eq!(huber.weight(100.0), 0.2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum RobustLoss {
    /// `ρ(s) = s`: plain least squares.
    #[default]
    Trivial,
    /// `ρ(s) = s` up to the width `w`, then `2 w √s − w²`: grows with the residual, not its square.
    Huber {
        /// Residuals up to this length count in full.
        width: f64,
    },
    /// `ρ(s) = w² ln(1 + s/w²)`: the influence of outliers decreases with distance.
    Cauchy {
        /// Residual length with half the weight.
        width: f64,
    },
    /// `ρ(s) = min(s, w²)`: outliers have a constant cost and no influence. Its cost is MSAC's.
    Truncated {
        /// Residuals longer than this are outliers.
        width: f64,
    },
}

impl RobustLoss {
    /// Returns the loss ρ(s) of a residual with squared length `s`.
    #[inline]
    pub fn rho(&self, s: f64) -> f64 {
        match *self {
            RobustLoss::Trivial => s,
            RobustLoss::Huber { width } => {
                if s <= width * width {
                    s
                } else {
                    2.0 * width * s.sqrt() - width * width
                }
            }
            RobustLoss::Cauchy { width } => {
                let width_sq = width * width;
                width_sq * libm::log1p(s / width_sq)
            }
            RobustLoss::Truncated { width } => {
                // Preserves NaN.
                if s > width * width { width * width } else { s }
            }
        }
    }

    /// Returns the derivative ρ'(s): the weight of this residual in `JᵀJ` and `Jᵀr`.
    #[inline]
    pub fn weight(&self, s: f64) -> f64 {
        match *self {
            RobustLoss::Trivial => 1.0,
            RobustLoss::Huber { width } => {
                if s <= width * width {
                    1.0
                } else {
                    width / s.sqrt()
                }
            }
            RobustLoss::Cauchy { width } => 1.0 / (1.0 + s / (width * width)),
            RobustLoss::Truncated { width } => {
                if s > width * width {
                    0.0
                } else {
                    1.0
                }
            }
        }
    }

    /// Rejects an invalid width. Every function with a loss calls this first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless the width, if there is one, is greater than 0 and finite. So
    /// must be its square, which the loss uses.
    ///
    /// ```
    /// use epipole::optim::RobustLoss;
    /// assert!(RobustLoss::Huber { width: 2.0 }.check().is_ok());
    /// let error = RobustLoss::Cauchy { width: -1.0 }.check().unwrap_err();
    /// assert!(error.to_string().ends_with("but is -1"));
    /// ```
    pub fn check(&self) -> Result<()> {
        match *self {
            RobustLoss::Trivial => Ok(()),
            RobustLoss::Huber { width }
            | RobustLoss::Cauchy { width }
            | RobustLoss::Truncated { width } => {
                let width_sq = width * width;
                if width > 0.0 && width_sq.is_normal() {
                    Ok(())
                } else {
                    Err(Error::OutOfRange {
                        what: "the width of a robust loss",
                        requirement: "greater than 0 and finite, as must be its square",
                        value: width,
                    })
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOSSES: [RobustLoss; 4] = [
        RobustLoss::Trivial,
        RobustLoss::Huber { width: 1.5 },
        RobustLoss::Cauchy { width: 1.5 },
        RobustLoss::Truncated { width: 1.5 },
    ];

    #[test]
    fn the_weight_is_the_derivative() {
        for loss in LOSSES {
            for s in [0.01, 0.5, 2.0, 2.5, 9.0, 1e4] {
                let h = 1e-5 * s;
                let slope = (loss.rho(s + h) - loss.rho(s - h)) / (2.0 * h);
                assert!(
                    (slope - loss.weight(s)).abs() < 1e-8,
                    "{loss:?} at {s}: {slope}"
                );
            }
        }
    }

    #[test]
    fn small_residuals_count_in_full() {
        for loss in LOSSES {
            assert_eq!(loss.rho(0.0), 0.0);
            assert!((loss.rho(1e-9) - 1e-9).abs() < 1e-17);
            assert_eq!(loss.weight(0.0), 1.0);
        }
    }

    #[test]
    fn widths_must_be_positive() {
        assert!(LOSSES.iter().all(|loss| loss.check().is_ok()));
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-200, 1e200] {
            for loss in [
                RobustLoss::Huber { width },
                RobustLoss::Cauchy { width },
                RobustLoss::Truncated { width },
            ] {
                assert!(matches!(loss.check(), Err(Error::OutOfRange { .. })));
            }
        }
    }
}
