//! What data without any structure would show.

use nalgebra::Point2;

/// How many models with so much support are to be expected among data that have nothing to do with
/// one another: a bound on the number of false alarms, as its decimal logarithm.
///
/// * `num_inliers` of `num_data` different data fit the model
/// * `sample_size`: data that determine a model; these fit it anyway
/// * `max_models`: models that one sample can give
/// * `chance`: the probability that a datum which has nothing to do with a model fits it, in \[0, 1\]
///
/// Every sample is one try, `max_models · C(n, s)` in all, and each of the other data fits by chance;
/// the tail of that binomial distribution is bounded by `exp(−m KL(k/m ‖ chance))`. Near or above 0,
/// the support says nothing; at −10 it would come about once in 10¹⁰ such sets of data.
///
/// Source: Moisan & Stival 2004, "A probabilistic criterion to detect rigid point matches between two
/// images and estimate the fundamental matrix" (the number of false alarms); Hoeffding 1963 (the
/// bound).
///
/// ```
/// use epipole::robust::log10_false_alarms;
/// // A band of two pixels along a line covers 1/200 of an image. Of 300 unrelated matches one or two
/// // fit, and the best of all samples easily finds a few more; 100 inliers are no accident.
/// assert!(log10_false_alarms(13, 300, 7, 3, 0.005) > 0.0);
/// assert!(log10_false_alarms(100, 300, 7, 3, 0.005) < -100.0);
/// ```
pub fn log10_false_alarms(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
    max_models: usize,
    chance: f64,
) -> f64 {
    let log_tries = (0..sample_size.min(num_data)).fold(libm::log(max_models as f64), |sum, i| {
        sum + libm::log((num_data - i) as f64 / (i + 1) as f64)
    });
    let others = num_data.saturating_sub(sample_size) as f64;
    let share = num_inliers.min(num_data).saturating_sub(sample_size) as f64 / others.max(1.0);
    // Probabilities below the smallest numbers would give infinities.
    let chance = chance.clamp(1e-300, 1.0);
    if share <= chance {
        return log_tries / core::f64::consts::LN_10;
    }
    let misses = if share < 1.0 {
        (1.0 - share) * libm::log((1.0 - share) / (1.0 - chance))
    } else {
        0.0
    };
    let divergence = share * libm::log(share / chance) + misses;
    (log_tries - others * divergence) / core::f64::consts::LN_10
}

/// Width and height of the box around points.
fn extent<'a>(points: impl IntoIterator<Item = &'a Point2<f64>>) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in points {
        for (axis, value) in [p.x, p.y].into_iter().enumerate() {
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
    (high[0] - low[0], high[1] - low[1])
}

fn share_of_box(area: f64, (width, height): (f64, f64)) -> f64 {
    if width > 0.0 && height > 0.0 {
        (area / (width * height)).min(1.0)
    } else {
        // Data on one line, or none, tell nothing.
        1.0
    }
}

/// The probability that a point anywhere in the box around `points` is nearer than `radius` to a
/// given one.
pub(crate) fn chance_near_point<'a>(
    points: impl IntoIterator<Item = &'a Point2<f64>>,
    radius: f64,
) -> f64 {
    share_of_box(core::f64::consts::PI * radius * radius, extent(points))
}

/// The probability that a point anywhere in the box around `points` is nearer than `distance` to a
/// line across it; the longest line is the diagonal.
pub(crate) fn chance_near_line<'a>(
    points: impl IntoIterator<Item = &'a Point2<f64>>,
    distance: f64,
) -> f64 {
    let (width, height) = extent(points);
    let diagonal = (width * width + height * height).sqrt();
    share_of_box(2.0 * distance * diagonal, (width, height))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact expectation, from the binomial distribution.
    fn exact(num_inliers: usize, num_data: usize, sample_size: usize, chance: f64) -> f64 {
        let log_factorial = |n: usize| libm::lgamma(n as f64 + 1.0);
        let log_choose =
            |n: usize, k: usize| log_factorial(n) - log_factorial(k) - log_factorial(n - k);
        let others = num_data - sample_size;
        let tail: f64 = (num_inliers - sample_size..=others)
            .map(|k| {
                let (hits, misses) = (k as f64, (others - k) as f64);
                libm::exp(
                    log_choose(others, k)
                        + hits * libm::log(chance)
                        + misses * libm::log(1.0 - chance),
                )
            })
            .sum();
        (log_choose(num_data, sample_size) + libm::log(tail)) / core::f64::consts::LN_10
    }

    #[test]
    fn the_bound_is_above_the_binomial_tail_and_close() {
        for (k, n, s, chance) in [
            (20, 50, 7, 0.01),
            (15, 300, 4, 0.002),
            (165, 3000, 7, 0.02),
            (40, 200, 5, 0.05),
        ] {
            let (bound, value) = (
                log10_false_alarms(k, n, s, 1, chance),
                exact(k, n, s, chance),
            );
            assert!(
                bound >= value && bound < value + 2.5,
                "{k} of {n}: {bound} {value}"
            );
        }
    }

    #[test]
    fn extremes_stay_finite() {
        for (k, n) in [(0, 0), (3, 3), (10, 10), (10, 5), (7, 1000), (1000, 1000)] {
            for chance in [0.0, 1e-320, 0.5, 1.0, 7.0] {
                let value = log10_false_alarms(k, n, 7, 3, chance);
                assert!(value.is_finite(), "{k} of {n}, {chance}: {value}");
            }
        }
        // Where anything fits, nothing is told.
        assert!(log10_false_alarms(1000, 1000, 7, 3, 1.0) > 0.0);
    }

    #[test]
    fn chances_are_shares_of_the_box() {
        let corners = [Point2::new(0.0, 10.0), Point2::new(300.0, 410.0)];
        assert!((chance_near_line(&corners, 3.0) - 0.025).abs() < 1e-12);
        let disk = core::f64::consts::PI * 4.0 / 120_000.0;
        assert!((chance_near_point(&corners, 2.0) - disk).abs() < 1e-12);
        // Points on one line, or none at all, say nothing.
        assert_eq!(chance_near_line(&corners[..1], 3.0), 1.0);
        assert_eq!(chance_near_point(&[], 3.0), 1.0);
    }
}
