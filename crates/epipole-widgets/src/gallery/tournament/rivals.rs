//! Rivals that estimate a line or F, and their errors on the same data.

use crate::kit::line_points::{angle_between_deg, scatter};
use crate::kit::matches::{MAX_USED, Match, Matches, distance_px};
use crate::kit::samples::{Rules, inliers_of};
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::Error;
use epipole::epipolar::{FundamentalEstimator, fundamental_8point, refine_fundamental};
use epipole::math::{Line2, random::Random};
use epipole::optim::RobustLoss;
use epipole::robust::{
    Estimator, LeastMedianOptions, LineEstimator, MatchSet, fit_line_huber,
    fit_line_total_least_squares, least_median,
};
use nalgebra::{Matrix3, Point2};
use std::rc::Rc;

/// Number of rivals.
pub(super) const NUM_RIVALS: usize = 6;
/// Names for permalinks and for readers, and whether their readouts are always visible.
pub(super) const RIVALS: [(&str, &str, bool); NUM_RIVALS] = [
    ("least-squares", "Least squares", true),
    ("huber", "Huber", false),
    ("least-median", "Least median", true),
    ("ransac", "RANSAC", true),
    ("msac", "MSAC", false),
    ("msac-lo", "MSAC + LO", true),
];
/// Maximum angle from the hidden line for a success, degrees.
pub(super) const WITHIN_DEG: f64 = 2.0;
/// Maximum mean epipolar distance of held-out matches for a success with F, pixels.
pub(super) const WITHIN_PX: f64 = 2.0;
/// Standard deviations of the points' distance from the line, and of a match's coordinates, pixels.
const LINE_SIGMA_PX: f64 = 4.0;
const MATCH_SIGMA_PX: f64 = 0.5;
/// Number of points.
const NUM_POINTS: usize = 60;
/// Maximum number of samples per rival.
const MAX_SAMPLES: usize = 500;
/// Tuning constant of Huber's loss, in standard deviations, for 95% efficiency.
const HUBER: f64 = 1.345;

/// Success of each rival.
pub(super) type Successes = [bool; NUM_RIVALS];

/// Returns the models of the sampling rivals: least median and the three voting ones.
fn sampled<E: Estimator>(
    estimator: impl Fn() -> Result<E, Error>,
    refit: impl Fn(&[bool]) -> Result<E::Model, Error>,
    epsilon_px: f64,
    seed: u64,
) -> [Result<E::Model, Error>; 4] {
    let num_samples = MAX_SAMPLES;
    let options = LeastMedianOptions::default()
        .with_num_samples(num_samples)
        .with_seed(seed);
    let vote = |msac, local_optimization| {
        let rules = Rules {
            epsilon_px,
            seed,
            max_samples: MAX_SAMPLES,
            msac,
            local_optimization,
        };
        Ok(rules.run(estimator()?, &refit)?.0)
    };
    let median = estimator().and_then(|estimator| least_median(estimator, &options, &mut ()));
    [
        median.map(|found| found.model),
        vote(false, false),
        vote(true, false),
        vote(true, true),
    ]
}

/// Fits all rivals to a hidden line with points and outliers of this seed.
///
/// * `threshold`: threshold of the voting rivals, in standard deviations of the noise
pub(super) fn fit_lines(seed: u64, outlier_ratio: f64, threshold: f64) -> Successes {
    let scattered = scatter(seed, NUM_POINTS, outlier_ratio);
    let points = &scattered.points;
    let estimator = || LineEstimator::new(points);
    let refit = |is: &[bool]| fit_line_total_least_squares(&inliers_of(points, is));
    let [median, plain, msac, local] = sampled(estimator, refit, threshold * LINE_SIGMA_PX, seed);
    let squares = fit_line_total_least_squares(points);
    let huber = fit_line_huber(points, HUBER * LINE_SIGMA_PX);
    let is_near = |line: Line2| angle_between_deg(&line, &scattered.truth) <= WITHIN_DEG;
    [squares, huber, median, plain, msac, local].map(|line| line.is_ok_and(is_near))
}

/// Matches of the still life's pair with outliers, and F by all rivals.
pub(super) struct Pair {
    matches: Rc<Matches>,
    seed: u64,
}

impl Pair {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            matches: Matches::draw(seed),
            seed,
        }
    }

    fn disturbed(&self, outlier_ratio: f64) -> (Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let matches = self.matches.noisy(MAX_USED, MATCH_SIGMA_PX);
        let num_wrong = (outlier_ratio * matches.len() as f64).round() as usize;
        let mut random = Random::new(self.seed ^ 0x5eed);
        let placed = |(index, (pixel1, pixel2)): (usize, Match)| {
            let anywhere = Point2::new(
                random.uniform(0.0, f64::from(PHOTO_WIDTH)),
                random.uniform(0.0, f64::from(PHOTO_HEIGHT)),
            );
            (pixel1, if index < num_wrong { anywhere } else { pixel2 })
        };
        matches.into_iter().enumerate().map(placed).unzip()
    }

    /// Fits all rivals, as [`fit_lines`] does.
    pub(super) fn fit(&self, outlier_ratio: f64, threshold: f64) -> Successes {
        let (first, second) = self.disturbed(outlier_ratio);
        let estimator = || FundamentalEstimator::new(MatchSet::new(&first, &second)?);
        let refit =
            |is: &[bool]| fundamental_8point(&inliers_of(&first, is), &inliers_of(&second, is));
        let epsilon_px = threshold * MATCH_SIGMA_PX;
        let [median, plain, msac, local] = sampled(estimator, refit, epsilon_px, self.seed);
        let squares = fundamental_8point(&first, &second);
        let width = HUBER * MATCH_SIGMA_PX;
        let huber = RobustLoss::Huber { width };
        let huber = (squares.clone()).and_then(|f| refine_fundamental(&f, &first, &second, huber));
        let found = [squares, huber, median, plain, msac, local];
        found.map(|f| f.is_ok_and(|f| self.mean_px(&f) <= WITHIN_PX))
    }

    /// Returns the mean distance of held-out exact matches from their epipolar lines, pixels.
    fn mean_px(&self, fundamental: &Matrix3<f64>) -> f64 {
        let held_out = &self.matches.held_out;
        let distance = |found| distance_px(fundamental, found).unwrap_or(f64::INFINITY);
        held_out.iter().map(distance).sum::<f64>() / held_out.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_outliers_everybody_finds_f_and_with_some_only_the_robust_do() {
        let pair = Pair::new(3);
        assert_eq!(pair.fit(0.0, 2.5), [true; NUM_RIVALS]);
        assert_eq!(pair.fit(0.3, 2.5), [false, false, true, true, true, true]);
    }

    #[test]
    fn with_six_of_ten_points_wrong_voting_still_finds_the_line() {
        let mut wins = [0; NUM_RIVALS];
        for seed in 0..1000 {
            let successes = fit_lines(seed, 0.6, 2.5);
            for (count, success) in wins.iter_mut().zip(successes) {
                *count += usize::from(success);
            }
        }
        // Least squares fails; every voting rival succeeds in at least 95% of the runs.
        assert!(wins[0] < 50, "{wins:?}");
        assert!(wins[3..].iter().all(|&count| count >= 950), "{wins:?}");
    }

    /// Compares with the success rates of `tests/peers/tournament.py`, an independent NumPy
    /// implementation with other points of the same distribution; they agree within statistical
    /// error.
    #[test]
    fn shares_are_those_of_an_independent_tournament_in_numpy() {
        const NUM_RUNS: u32 = 200;
        let theirs = include_str!("../../../../../tests/peers/fixtures/tournament.txt");
        let mut num_cases = 0;
        for row in theirs.lines().filter(|row| !row.starts_with('#')) {
            let numbers: Vec<f64> = row.split(' ').map(|word| word.parse().unwrap()).collect();
            let [ratio, threshold, num_theirs, theirs @ ..] = &numbers[..] else {
                panic!("{row}");
            };
            let mut wins = [0_u32; NUM_RIVALS];
            for seed in 0..NUM_RUNS {
                let successes = fit_lines(u64::from(seed), *ratio, *threshold);
                for (count, success) in wins.iter_mut().zip(successes) {
                    *count += u32::from(success);
                }
            }
            assert_eq!(theirs.len(), NUM_RIVALS);
            for (((_, name, _), ours), theirs) in RIVALS.iter().zip(wins).zip(theirs) {
                let num_ours = f64::from(NUM_RUNS);
                let (ours, sum) = (f64::from(ours), f64::from(ours) + theirs);
                let share = sum / (num_ours + num_theirs);
                let by_chance =
                    (share * (1.0 - share) * (1.0 / num_ours + 1.0 / num_theirs)).sqrt();
                let apart = (ours / num_ours - theirs / num_theirs).abs();
                assert!(
                    apart <= 3.5 * by_chance,
                    "{name} at {ratio}, {threshold} sigma: {ours} of {num_ours}, {theirs} of {num_theirs}"
                );
            }
            num_cases += 1;
        }
        assert_eq!(num_cases, 8);
    }

    #[test]
    fn a_threshold_that_is_no_number_is_no_success() {
        assert!(!fit_lines(1, 0.2, f64::NAN)[3]);
        assert!(!Pair::new(1).fit(0.2, -1.0)[5]);
    }
}
