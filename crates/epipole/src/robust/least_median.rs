//! Least median of squares: the model with the smallest median error.

use super::sampler::Sampler;
use super::{Estimator, SamplerKind};
use crate::math::order::at_rank;
use crate::math::random::Random;
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;

/// Number of rounds of finding and fitting inliers after the sampling.
const ROUNDS: usize = 4;
/// Ratio of the standard deviation of Gaussian noise to its median absolute deviation.
const SIGMA_PER_MEDIAN: f64 = 1.4826;
/// Inlier threshold in standard deviations.
const REACH: f64 = 2.5;
/// Minimum threshold, pixels: the median of exact data is 0.
const SMALLEST_REACH_PX: f64 = 1e-9;

/// Options of [`least_median`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct LeastMedianOptions {
    /// Number of samples, ≥ 1. 500.
    pub num_samples: usize,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
}

impl Default for LeastMedianOptions {
    fn default() -> Self {
        Self {
            num_samples: 500,
            seed: 0,
        }
    }
}

/// Result of [`least_median`].
#[derive(Debug, Clone, PartialEq)]
pub struct LeastMedian<M> {
    /// The model, refitted to its inliers.
    pub model: M,
    /// Median error of the best sample's model, pixels.
    pub median_px: f64,
    /// Standard deviation of the noise, from the median, pixels.
    pub sigma_px: f64,
    /// Number of unique data points within 2.5 standard deviations of the model.
    pub num_inliers: usize,
}

/// Finds the model with the smallest median error among those of random samples, then refits it to
/// its inliers.
///
/// Needs no threshold: the median determines the noise, `σ = 1.4826 (1 + 5/(n − s)) median`, and
/// data within 2.5 σ are inliers. In return it fails if half of the data or more are outliers.
///
/// * `estimator`: as for [`ransac`](super::ransac)
///
/// The only stage is [`Stage::RobustEstimation`].
///
/// # Errors
/// [`Error::TooFew`] unless there are more data points than in a sample, [`Error::OutOfRange`] for
/// zero samples, [`Error::Degenerate`] if no sample gave a model, [`Error::Canceled`].
///
/// Source: Rousseeuw 1984, "Least median of squares regression"; Rousseeuw & Leroy 1987, "Robust
/// regression and outlier detection", ch. 5 (the scale).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{LeastMedianOptions, LineEstimator, least_median};
/// use nalgebra::Point2;
/// // Nine points of the row v = 2, and six outliers; no threshold is given.
/// let mut points: Vec<_> = (0..9).map(|i| Point2::new(f64::from(i) * 5.0, 2.0)).collect();
/// points.extend((0..6).map(|i| Point2::new(f64::from(i) * 3.0, 40.0 + f64::from(i * i))));
/// let options = LeastMedianOptions::default();
/// let found = least_median(LineEstimator::new(&points)?, &options, &mut ())?;
/// assert!(found.model.signed_distance(&Point2::new(100.0, 2.0)).abs() < 1e-9);
/// assert_eq!(found.num_inliers, 9);
/// # Ok(()) }
/// ```
pub fn least_median<E: Estimator>(
    mut estimator: E,
    options: &LeastMedianOptions,
    monitor: &mut dyn Monitor,
) -> Result<LeastMedian<E::Model>> {
    let problem = estimator.problem();
    let (num_data, size, name) = (problem.data.len(), problem.sample_size, problem.name);
    problem.data.at_least(size + 1, name)?;
    if options.num_samples == 0 {
        return Err(Error::OutOfRange {
            what: "the number of samples",
            requirement: "at least 1",
            value: 0.0,
        });
    }
    let mut random = Random::new(options.seed);
    let mut sampler = Sampler::new(SamplerKind::Uniform, num_data, size, options.num_samples);
    let mut sample = Vec::with_capacity(size);
    let mut models = Vec::with_capacity(problem.max_models);
    let mut errors_sq = vec![0.0; num_data];
    let mut best: Option<(f64, E::Model)> = None;
    for k in 0..options.num_samples {
        let fraction = k as f32 / options.num_samples as f32;
        report(monitor, Stage::RobustEstimation, fraction)?;
        sampler.draw(&mut random, &mut sample);
        models.clear();
        estimator.fit_sample(&sample, &mut models);
        for model in models.drain(..) {
            for (index, error_sq) in errors_sq.iter_mut().enumerate() {
                *error_sq = estimator.error_sq(&model, index);
            }
            let median_sq = middle(&mut errors_sq, size);
            if best.as_ref().is_none_or(|(least, _)| median_sq < *least) && median_sq.is_finite() {
                best = Some((median_sq, model));
            }
        }
    }
    let (median_sq, mut model) = best.ok_or(Error::Degenerate {
        what: name,
        why: "no sample gives a model",
    })?;
    let median_px = median_sq.sqrt();
    let few_data = 1.0 + 5.0 / (num_data - size) as f64;
    let sigma_px = SIGMA_PER_MEDIAN * few_data * median_px;
    let reach_px = (REACH * sigma_px).max(SMALLEST_REACH_PX);
    let mut inliers = Vec::with_capacity(num_data);
    let mut before = Vec::new();
    estimator.inliers(&model, reach_px, &mut inliers);
    for _ in 0..ROUNDS {
        if inliers == before {
            break;
        }
        let Some(refined) = estimator.refine(&model, &inliers, reach_px) else {
            break;
        };
        before.clone_from(&inliers);
        estimator.inliers(&refined, reach_px, &mut inliers);
        model = refined;
    }
    Ok(LeastMedian {
        model,
        median_px,
        sigma_px,
        num_inliers: inliers.len(),
    })
}

/// Returns the median error, at a rank shifted by the data of the sample, whose error is 0.
fn middle(errors_sq: &mut [f64], sample_size: usize) -> f64 {
    let rank = (errors_sq.len() + sample_size)
        .div_ceil(2)
        .min(errors_sq.len())
        - 1;
    // NaN sorts last.
    at_rank(errors_sq, rank)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robust::LineEstimator;
    use nalgebra::Point2;

    const OPTIONS: LeastMedianOptions = LeastMedianOptions {
        num_samples: 300,
        seed: 1,
    };

    /// Points with noise around v = 0.5 u + 20, the first ones moved anywhere.
    fn cloud(seed: u64, num_outliers: usize, noise_px: f64) -> Vec<Point2<f64>> {
        let mut random = Random::new(seed);
        (0..60)
            .map(|i| {
                let u = random.uniform(0.0, 600.0);
                match i < num_outliers {
                    true => Point2::new(u, random.uniform(0.0, 400.0)),
                    false => Point2::new(u, 0.5 * u + 20.0 + noise_px * random.normal()),
                }
            })
            .collect()
    }

    #[test]
    fn forty_percent_outliers_do_no_harm_and_the_noise_is_found() {
        for seed in 0..30 {
            let points = cloud(seed, 24, 3.0);
            let found =
                least_median(LineEstimator::new(&points).unwrap(), &OPTIONS, &mut ()).unwrap();
            let off = (found.model.angle_rad() - libm::atan(0.5)).to_degrees();
            assert!(off.abs() < 1.5, "{seed}: {off}");
            assert!((1.5..7.0).contains(&found.sigma_px), "{}", found.sigma_px);
            assert!(found.num_inliers >= 30, "{}", found.num_inliers);
        }
    }

    #[test]
    fn three_quarters_of_outliers_break_it() {
        let off = |seed| {
            let points = cloud(seed, 45, 3.0);
            let found =
                least_median(LineEstimator::new(&points).unwrap(), &OPTIONS, &mut ()).unwrap();
            (found.model.angle_rad() - libm::atan(0.5))
                .to_degrees()
                .abs()
        };
        assert!((0..30).filter(|&seed| off(seed) > 2.0).count() > 10);
    }

    #[test]
    fn equal_seeds_agree_and_hopeless_data_are_refused() {
        let points = cloud(4, 20, 3.0);
        let run = |options: &LeastMedianOptions, count: usize| {
            least_median(
                LineEstimator::new(&points[..count]).unwrap(),
                options,
                &mut (),
            )
        };
        assert_eq!(run(&OPTIONS, 60), run(&OPTIONS, 60));
        assert!(matches!(
            run(&OPTIONS, 2),
            Err(Error::TooFew { needed: 3, .. })
        ));
        let none = LeastMedianOptions {
            num_samples: 0,
            ..OPTIONS
        };
        assert!(matches!(run(&none, 60), Err(Error::OutOfRange { .. })));
    }
}
