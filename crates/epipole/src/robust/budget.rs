//! Number of RANSAC samples.

use crate::{Error, Result};

/// Returns the number of samples so that at least one is free of outliers with probability
/// `confidence`: the smallest k with `1 − (1 − wˢ)ᵏ ≥ p`.
///
/// * `inlier_ratio`: w, in [0, 1]
/// * `sample_size`: s ≥ 1, data points per sample
/// * `confidence`: p, in (0, 1)
///
/// Assumes that each data point of a sample is an inlier with probability w, independently of the
/// others. Returns at least 1, and `u64::MAX` if no number is enough.
///
/// # Errors
/// [`Error::OutOfRange`] if an argument is outside its range or NaN.
///
/// Source: Hartley & Zisserman 2004, §4.7.1 and Table 4.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::num_trials_with_replacement;
/// // log 0.01 / log (1 − 0.5²) = 16.008, so 16 samples fall just short.
/// assert_eq!(num_trials_with_replacement(0.5, 2, 0.99)?, 17);
/// # Ok(()) }
/// ```
pub fn num_trials_with_replacement(
    inlier_ratio: f64,
    sample_size: usize,
    confidence: f64,
) -> Result<u64> {
    if !(0.0..=1.0).contains(&inlier_ratio) {
        return Err(Error::OutOfRange {
            what: "the inlier ratio",
            requirement: "between 0 and 1",
            value: inlier_ratio,
        });
    }
    check(sample_size, confidence)?;
    Ok(trials(
        ratio_to_the(inlier_ratio, sample_size),
        libm::log1p(-confidence),
    ))
}

/// Returns the number of samples so that at least one is free of outliers with probability
/// `confidence`, for sampling without replacement: the smallest k with `1 − (1 − P)ᵏ ≥ p`,
/// `P = Π (m − i)/(n − i)` for i = 0 … s − 1.
///
/// * `num_inliers`: m ≤ n
/// * `num_data`: n ≥ s
/// * `sample_size`: s ≥ 1, data points per sample
/// * `confidence`: p, in (0, 1)
///
/// This is RANSAC's actual sampling; for few data points it requires many more samples than
/// [`num_trials_with_replacement`]. Returns at least 1, and `u64::MAX` if no number is enough.
///
/// # Errors
/// [`Error::TooFew`] if there are fewer data points than a sample needs, [`Error::OutOfRange`] if
/// another argument is outside its range.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::num_trials_without_replacement;
/// assert_eq!(num_trials_without_replacement(10, 100, 3, 0.99)?, 6204);
/// # Ok(()) }
/// ```
pub fn num_trials_without_replacement(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
    confidence: f64,
) -> Result<u64> {
    check(sample_size, confidence)?;
    if num_data < sample_size {
        return Err(Error::TooFew {
            what: "a sample",
            needed: sample_size,
            got: num_data,
        });
    }
    if num_inliers > num_data {
        return Err(Error::OutOfRange {
            what: "the number of inliers",
            requirement: "at most the number of data",
            value: num_inliers as f64,
        });
    }
    Ok(trials(
        all_inlier_probability(num_inliers, num_data, sample_size),
        libm::log1p(-confidence),
    ))
}

/// Computes wˢ by repeated multiplication, which rounds identically on all platforms.
pub(super) fn ratio_to_the(inlier_ratio: f64, sample_size: usize) -> f64 {
    (0..sample_size).fold(1.0, |product, _| product * inlier_ratio)
}

/// Returns the probability that a sample drawn without replacement has only inliers.
pub(super) fn all_inlier_probability(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
) -> f64 {
    (0..sample_size).fold(1.0, |product, i| {
        if num_inliers > i && num_data > i {
            product * ((num_inliers - i) as f64 / (num_data - i) as f64)
        } else {
            0.0
        }
    })
}

/// Returns the smallest k ≥ 1 with `(1 − probability)ᵏ ≤ exp(log_miss)`.
pub(super) fn trials(probability: f64, log_miss: f64) -> u64 {
    if probability >= 1.0 {
        return 1;
    }
    // log1p keeps a probability far below the spacing of numbers near 1. The cast saturates.
    let count = (log_miss / libm::log1p(-probability)).ceil();
    if count.is_nan() {
        u64::MAX
    } else {
        (count as u64).max(1)
    }
}

fn check(sample_size: usize, confidence: f64) -> Result<()> {
    if sample_size == 0 {
        return Err(Error::OutOfRange {
            what: "the size of a sample",
            requirement: "at least 1",
            value: 0.0,
        });
    }
    if !(confidence > 0.0 && confidence < 1.0) {
        return Err(Error::OutOfRange {
            what: "the confidence",
            requirement: "greater than 0 and less than 1",
            value: confidence,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hartley & Zisserman 2004, Table 4.3, as in skimage/measure/tests/test_fit.py of scikit-image
    /// (dynamic_max_trials).
    #[test]
    fn published_counts_with_replacement() {
        for (sample_size, counts) in [(2, [2, 3, 7, 17]), (8, [5, 9, 78, 1177])] {
            for (inlier_ratio, count) in [0.95, 0.90, 0.70, 0.50].into_iter().zip(counts) {
                assert_eq!(
                    num_trials_with_replacement(inlier_ratio, sample_size, 0.99),
                    Ok(count)
                );
            }
        }
    }

    /// COLMAP's src/colmap/optim/ransac_test.cc.
    #[test]
    fn published_counts_without_replacement() {
        for (num_inliers, confidence, count) in [
            (10, 0.99, 6204),
            (10, 0.999, 9305),
            (50, 0.99, 36),
            (50, 0.999, 54),
        ] {
            assert_eq!(
                num_trials_without_replacement(num_inliers, 100, 3, confidence),
                Ok(count)
            );
        }
    }

    #[test]
    fn extremes_saturate() {
        assert_eq!(num_trials_with_replacement(1.0, 8, 0.99), Ok(1));
        assert_eq!(num_trials_with_replacement(0.0, 8, 0.99), Ok(u64::MAX));
        assert_eq!(num_trials_with_replacement(1e-300, 8, 0.99), Ok(u64::MAX));
        assert_eq!(
            num_trials_without_replacement(2, 100, 3, 0.99),
            Ok(u64::MAX)
        );
        assert_eq!(num_trials_without_replacement(100, 100, 3, 0.99), Ok(1));
        // A ratio so small that 1 − wˢ rounds to 1 still gives the right number.
        let count = num_trials_with_replacement(1e-3, 6, 0.99).unwrap() as f64;
        assert!((count / 4.605_170_186e18 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn bad_arguments_are_refused() {
        for (ratio, sample_size, confidence) in [
            (-0.1, 2, 0.99),
            (1.1, 2, 0.99),
            (f64::NAN, 2, 0.99),
            (0.5, 0, 0.99),
            (0.5, 2, 0.0),
            (0.5, 2, 1.0),
            (0.5, 2, f64::NAN),
        ] {
            assert!(num_trials_with_replacement(ratio, sample_size, confidence).is_err());
        }
        assert!(num_trials_without_replacement(1, 2, 3, 0.9).is_err());
        assert!(num_trials_without_replacement(5, 4, 3, 0.9).is_err());
    }
}
