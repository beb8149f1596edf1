//! Support of models by random data.

use crate::math::order::at_rank;

/// Probability that an unrelated data point fits a model, for estimators that do not provide it.
pub(super) const UNKNOWN_PROBABILITY: f64 = 0.05;

/// Returns the expected number of models with at least this support among unrelated data: a bound
/// on the number of false alarms, as its decimal logarithm.
///
/// * `num_inliers`, `num_data`: number of different data points that fit the model, and in total
/// * `sample_size`: data points that determine a model; they always fit it
/// * `max_models`: maximum number of models per sample
/// * `random_inlier_probability`: probability that an unrelated data point fits, in \[0, 1\]
///
/// Every sample is a trial, `max_models · C(n, s)` in total, and each other data point fits at
/// random; the tail of that binomial distribution is bounded by `exp(−m KL(k/m ‖ p))`, where p is
/// `random_inlier_probability`. Near or above 0, the support is not significant; at −10, one in
/// 10¹⁰ data sets of this kind would show it.
///
/// Source: Moisan & Stival 2004, "A probabilistic criterion to detect rigid point matches between
/// two images and estimate the fundamental matrix" (the number of false alarms); Hoeffding 1963
/// (the bound).
///
/// ```
/// use epipole::robust::log10_false_alarms;
/// // A band of two pixels along a line covers 1/200 of an image. Of 300 unrelated matches one or
/// // two fit, and the best of all samples easily finds a few more; 100 inliers are no accident.
/// assert!(log10_false_alarms(13, 300, 7, 3, 0.005) > 0.0);
/// assert!(log10_false_alarms(100, 300, 7, 3, 0.005) < -100.0);
/// ```
pub fn log10_false_alarms(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
    max_models: usize,
    random_inlier_probability: f64,
) -> f64 {
    let log_tries = (0..sample_size.min(num_data)).fold(libm::log(max_models as f64), |sum, i| {
        sum + libm::log((num_data - i) as f64 / (i + 1) as f64)
    });
    let others = num_data.saturating_sub(sample_size) as f64;
    let ratio = num_inliers.min(num_data).saturating_sub(sample_size) as f64 / others.max(1.0);
    // Avoid infinities for probabilities that underflow.
    let random_inlier_probability = random_inlier_probability.clamp(1e-300, 1.0);
    if ratio <= random_inlier_probability {
        return log_tries / core::f64::consts::LN_10;
    }
    let misses = if ratio < 1.0 {
        (1.0 - ratio) * libm::log((1.0 - ratio) / (1.0 - random_inlier_probability))
    } else {
        0.0
    };
    let divergence = ratio * libm::log(ratio / random_inlier_probability) + misses;
    (log_tries - others * divergence) / core::f64::consts::LN_10
}

/// Fraction of the data at either end that is ignored for the extent: otherwise one outlier a
/// million pixels away would make chance fits look impossible.
const STRAY: f64 = 0.05;

/// Minimum aspect ratio of a box: points in a row also come from an image.
const THINNEST: f64 = 0.1;

/// Returns the range of the values without the outliers at either end.
fn reach(mut values: Vec<f64>) -> f64 {
    let count = values.len();
    if count < 2 {
        return 0.0;
    }
    let strays = (STRAY * (count - 1) as f64) as usize;
    let between = at_rank(&mut values, count - 1 - strays) - at_rank(&mut values, strays);
    between * (count - 1) as f64 / (count - 1 - 2 * strays) as f64
}

/// Returns width and height of the box around points, from the lists of their coordinates.
fn extent([u, v]: [Vec<f64>; 2]) -> (f64, f64) {
    let (width, height) = (reach(u), reach(v));
    (width.max(THINNEST * height), height.max(THINNEST * width))
}

fn fraction_of_box(area: f64, (width, height): (f64, f64)) -> f64 {
    if width > 0.0 {
        (area / (width * height)).min(1.0)
    } else {
        // Equal data, or none, carry no information.
        1.0
    }
}

/// Returns the probability that a random point in the box around the points is within `radius` of a
/// given one.
pub(crate) fn probability_near_point(coordinates: [Vec<f64>; 2], radius: f64) -> f64 {
    fraction_of_box(core::f64::consts::PI * radius * radius, extent(coordinates))
}

/// Returns the probability that a random point in the box around the points is within `distance` of
/// a line across it; the longest line is the diagonal.
pub(crate) fn probability_near_line(coordinates: [Vec<f64>; 2], distance: f64) -> f64 {
    let (width, height) = extent(coordinates);
    let diagonal = (width * width + height * height).sqrt();
    fraction_of_box(2.0 * distance * diagonal, (width, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point2;

    fn lists(points: &[Point2<f64>]) -> [Vec<f64>; 2] {
        [
            points.iter().map(|p| p.x).collect(),
            points.iter().map(|p| p.y).collect(),
        ]
    }

    /// The exact expectation, from the binomial distribution.
    fn exact(num_inliers: usize, num_data: usize, sample_size: usize, probability: f64) -> f64 {
        let log_factorial = |n: usize| libm::lgamma(n as f64 + 1.0);
        let log_choose =
            |n: usize, k: usize| log_factorial(n) - log_factorial(k) - log_factorial(n - k);
        let others = num_data - sample_size;
        let tail: f64 = (num_inliers - sample_size..=others)
            .map(|k| {
                let (hits, misses) = (k as f64, (others - k) as f64);
                libm::exp(
                    log_choose(others, k)
                        + hits * libm::log(probability)
                        + misses * libm::log(1.0 - probability),
                )
            })
            .sum();
        (log_choose(num_data, sample_size) + libm::log(tail)) / core::f64::consts::LN_10
    }

    #[test]
    fn the_bound_is_above_the_binomial_tail_and_close() {
        for (k, n, s, random_inlier_probability) in [
            (20, 50, 7, 0.01),
            (15, 300, 4, 0.002),
            (165, 3000, 7, 0.02),
            (40, 200, 5, 0.05),
        ] {
            let (bound, value) = (
                log10_false_alarms(k, n, s, 1, random_inlier_probability),
                exact(k, n, s, random_inlier_probability),
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
            for random_inlier_probability in [0.0, 1e-320, 0.5, 1.0, 7.0] {
                let value = log10_false_alarms(k, n, 7, 3, random_inlier_probability);
                assert!(
                    value.is_finite(),
                    "{k} of {n}, {random_inlier_probability}: {value}"
                );
            }
        }
        // Nothing is significant if anything fits.
        assert!(log10_false_alarms(1000, 1000, 7, 3, 1.0) > 0.0);
    }

    #[test]
    fn probabilities_are_fractions_of_the_box() {
        let corners = [Point2::new(0.0, 10.0), Point2::new(300.0, 410.0)];
        assert!((probability_near_line(lists(&corners), 3.0) - 0.025).abs() < 1e-12);
        let disk = core::f64::consts::PI * 4.0 / 120_000.0;
        assert!((probability_near_point(lists(&corners), 2.0) - disk).abs() < 1e-12);
        // Equal points, or none, carry no information.
        assert_eq!(probability_near_line(lists(&[corners[0]; 5]), 3.0), 1.0);
        assert_eq!(probability_near_point(lists(&[]), 3.0), 1.0);
        // Points in a row count as from an image ten times as wide as high.
        let row: Vec<_> = (0..=200).map(|u| Point2::new(f64::from(u), 7.0)).collect();
        let expected = core::f64::consts::PI / (200.0 * 20.0);
        assert!((probability_near_point(lists(&row), 1.0) - expected).abs() < 1e-12);
    }

    #[test]
    fn strays_do_not_stretch_the_box() {
        let mut grid: Vec<_> = (0..10_000)
            .map(|i| Point2::new(f64::from(i % 100), f64::from(i / 100)))
            .collect();
        let grid_only = probability_near_line(lists(&grid), 1.0);
        grid.extend((0..100).map(|i| Point2::new(1e8, -1e7 * f64::from(i))));
        assert!((probability_near_line(lists(&grid), 1.0) / grid_only - 1.0).abs() < 0.05);
    }
}
