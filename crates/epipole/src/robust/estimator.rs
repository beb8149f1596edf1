//! What a problem must tell the loop.

use super::{MatchSet, Unique};
use crate::math::random::Random;

/// How well the data support a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// `Σ min(1, e²/T²)` over the data: 0 if all fit exactly. An incomplete sum, larger than the
    /// limit, if the scoring was broken off.
    pub cost: f64,
    /// Data within the threshold, among those looked at.
    pub num_inliers: usize,
}

/// A problem that [`Ransac`](super::Ransac) can solve.
///
/// Data are addressed by index, `0..num_data()`, and are all different; errors are in pixels.
/// An estimator keeps the buffers it needs, so that no call in the loop allocates. One whose data are a
/// [`MatchSet`] names it by [`matches`](Estimator::matches), and is done with repeated matches and crowds.
///
/// ```
/// use epipole::robust::{Estimator, RansacOptions, ransac};
///
/// /// The value that most numbers agree on.
/// struct Level(Vec<f64>);
///
/// impl Estimator for Level {
///     type Model = f64;
///     fn name(&self) -> &'static str { "a level" }
///     fn sample_size(&self) -> usize { 1 }
///     fn num_data(&self) -> usize { self.0.len() }
///     fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<f64>) {
///         models.push(self.0[sample[0]]);
///     }
///     fn error_sq(&self, level: &f64, index: usize) -> f64 {
///         (self.0[index] - level) * (self.0[index] - level)
///     }
///     fn refine(&mut self, _: &f64, inliers: &[usize], _: f64) -> Option<f64> {
///         Some(inliers.iter().map(|&i| self.0[i]).sum::<f64>() / inliers.len() as f64)
///     }
/// }
///
/// # fn main() -> Result<(), epipole::Error> {
/// let report = ransac(Level(vec![4.75, 5.25, 99.0, 5.0]), &RansacOptions::default())?;
/// assert_eq!((report.model, report.num_inliers), (5.0, 3));
/// # Ok(()) }
/// ```
pub trait Estimator {
    /// What is estimated. Cloning must not allocate.
    type Model: Clone;

    /// What is estimated, in words, for error messages: "a homography from matches".
    fn name(&self) -> &'static str;

    /// Data that a minimal sample has.
    fn sample_size(&self) -> usize;

    /// Data there are.
    fn num_data(&self) -> usize;

    /// The matches that the data are, in the same order, if they are matches between two images. How likely
    /// they fit by chance, how much each of them counts and which were given twice then follows from them.
    fn matches(&self) -> Option<&MatchSet> {
        None
    }

    /// In how many dimensions a datum can miss a model: 1 where the error is the distance from a line, 2
    /// where it is that from a point.
    fn codimension(&self) -> usize {
        1
    }

    /// Models that one sample can give, at most.
    fn max_models(&self) -> usize {
        1
    }

    /// Pushes every model that fits the sample, none if the sample is degenerate.
    ///
    /// `sample` holds [`sample_size`](Estimator::sample_size) different indices.
    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>);

    /// Squared distance of a datum from a model, px².
    fn error_sq(&self, model: &Self::Model, index: usize) -> f64;

    /// Fills `errors_sq` with the [`error_sq`](Estimator::error_sq) of some data.
    fn errors_sq(&self, model: &Self::Model, indices: &[usize], errors_sq: &mut Vec<f64>) {
        errors_sq.clear();
        errors_sq.extend(indices.iter().map(|&index| self.error_sq(model, index)));
    }

    /// A better model from `model` and the data that fit it, or `None` if there is none.
    ///
    /// * `inliers`: indices of the data within the threshold
    /// * `max_error_px`: the threshold, pixels
    fn refine(
        &mut self,
        model: &Self::Model,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<Self::Model>;

    /// Weighted least squares from the best model on, for the last refinement, which may allocate;
    /// `None` if [`refine`](Estimator::refine) did all there is to do.
    ///
    /// * `near`: indices of the data not too far from the model
    /// * `weights`: how much each of them counts, in [0, 1]
    fn polish(
        &mut self,
        model: &Self::Model,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Self::Model> {
        let _ = (model, near, weights);
        None
    }

    /// A model that replaces one whose sample or inliers are degenerate, if it can be found.
    ///
    /// Called for a model that is better than all before.
    fn recover(
        &mut self,
        model: &Self::Model,
        sample: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Self::Model> {
        let _ = (model, sample, max_error_px, random);
        None
    }

    /// A model to prefer to the best one although its score may be lower, if there is such a one.
    ///
    /// Called once, at the end; may allocate.
    ///
    /// * `inliers`: indices of the data within the threshold of `model`
    fn settle(
        &mut self,
        model: &Self::Model,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Self::Model> {
        let _ = (model, inliers, max_error_px, random);
        None
    }

    /// How well the data support a model. May stop once the cost exceeds `cost_limit`.
    fn support(&self, model: &Self::Model, max_error_px: f64, cost_limit: f64) -> Support {
        if let Some(matches) = self.matches() {
            return matches.support(|i| self.error_sq(model, i), max_error_px, cost_limit);
        }
        let per_threshold_sq = 1.0 / (max_error_px * max_error_px);
        let mut support = Support {
            cost: 0.0,
            num_inliers: 0,
        };
        for index in 0..self.num_data() {
            let relative = self.error_sq(model, index) * per_threshold_sq;
            if relative < 1.0 {
                support.cost += relative;
                support.num_inliers += 1;
            } else {
                support.cost += 1.0;
                if support.cost > cost_limit {
                    break;
                }
            }
        }
        support
    }

    /// Fills `inliers` with the data within the threshold of a model.
    fn inliers(&self, model: &Self::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        let per_threshold_sq = 1.0 / (max_error_px * max_error_px);
        inliers.clear();
        inliers.extend(
            (0..self.num_data())
                .filter(|&index| self.error_sq(model, index) * per_threshold_sq < 1.0),
        );
    }

    /// The probability that a datum which has nothing to do with a model is within the threshold of it,
    /// where that is known: for [`RansacReport::log10_false_alarms`](super::RansacReport). Asked once, at
    /// the beginning.
    fn chance(&self, max_error_px: f64) -> Option<f64> {
        let matches = self.matches()?;
        Some(match self.codimension() {
            1 => matches.chance_near_lines(max_error_px),
            _ => matches.chance_near_point2(max_error_px),
        })
    }

    /// The cost of a model that nothing fits: one for each datum, unless some count less.
    fn num_votes(&self) -> f64 {
        let count = || self.num_data() as f64;
        self.matches().map_or_else(count, MatchSet::num_votes)
    }

    /// How many of these data can be right at the same time, at most; may allocate.
    fn num_distinct(&self, inliers: &[usize]) -> usize {
        let count = || inliers.len();
        (self.matches()).map_or_else(count, |matches| matches.num_distinct(inliers))
    }

    /// How the indices relate to the data that the caller gave, if repetitions were left out.
    fn unique(&self) -> Option<&Unique> {
        self.matches().map(MatchSet::unique)
    }
}

/// What is borrowed can be asked as well. Every question is passed on: where an estimator has an answer of its own,
/// that of the trait would be another one.
impl<E: Estimator + ?Sized> Estimator for &mut E {
    type Model = E::Model;

    fn name(&self) -> &'static str {
        (**self).name()
    }

    fn sample_size(&self) -> usize {
        (**self).sample_size()
    }

    fn num_data(&self) -> usize {
        (**self).num_data()
    }

    fn matches(&self) -> Option<&MatchSet> {
        (**self).matches()
    }

    fn codimension(&self) -> usize {
        (**self).codimension()
    }

    fn max_models(&self) -> usize {
        (**self).max_models()
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<E::Model>) {
        (**self).fit_sample(sample, models);
    }

    fn error_sq(&self, model: &E::Model, index: usize) -> f64 {
        (**self).error_sq(model, index)
    }

    fn errors_sq(&self, model: &E::Model, indices: &[usize], errors_sq: &mut Vec<f64>) {
        (**self).errors_sq(model, indices, errors_sq);
    }

    fn refine(
        &mut self,
        model: &E::Model,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<E::Model> {
        (**self).refine(model, inliers, max_error_px)
    }

    fn polish(&mut self, model: &E::Model, near: &[usize], weights: &[f64]) -> Option<E::Model> {
        (**self).polish(model, near, weights)
    }

    fn recover(
        &mut self,
        model: &E::Model,
        sample: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<E::Model> {
        (**self).recover(model, sample, max_error_px, random)
    }

    fn settle(
        &mut self,
        model: &E::Model,
        inliers: &[usize],
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<E::Model> {
        (**self).settle(model, inliers, max_error_px, random)
    }

    fn support(&self, model: &E::Model, max_error_px: f64, cost_limit: f64) -> Support {
        (**self).support(model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &E::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        (**self).inliers(model, max_error_px, inliers);
    }

    fn chance(&self, max_error_px: f64) -> Option<f64> {
        (**self).chance(max_error_px)
    }

    fn num_votes(&self) -> f64 {
        (**self).num_votes()
    }

    fn num_distinct(&self, inliers: &[usize]) -> usize {
        (**self).num_distinct(inliers)
    }

    fn unique(&self) -> Option<&Unique> {
        (**self).unique()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{RansacOptions, ransac};
    use super::*;
    use nalgebra::{Point2, Vector2};

    /// Shifts from matches, with no more than what has to be said.
    struct Shifts(MatchSet);

    #[rustfmt::skip]
    impl Estimator for Shifts {
        type Model = Vector2<f64>;
        fn name(&self) -> &'static str { "a shift from matches" }
        fn sample_size(&self) -> usize { 1 }
        fn codimension(&self) -> usize { 2 }
        fn num_data(&self) -> usize { self.0.len() }
        fn matches(&self) -> Option<&MatchSet> { Some(&self.0) }
        fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
            let (p1, p2) = self.0.pair(sample[0]);
            models.push(p2 - p1);
        }
        fn error_sq(&self, shift: &Self::Model, index: usize) -> f64 {
            let (p1, p2) = self.0.pair(index);
            (p2 - p1 - shift).norm_squared()
        }
        fn refine(&mut self, _: &Self::Model, _: &[usize], _: f64) -> Option<Self::Model> { None }
    }

    #[test]
    fn matches_bring_their_votes_repetitions_and_chances() {
        // Twenty matches move by (7, 2); thirty more lead to one pixel, and one is given forty times.
        let at = |i: usize| Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
        let shift = Vector2::new(7.0, 2.0);
        let mut pixels1: Vec<_> = (0..50).map(at).collect();
        let moved = |i: usize| if i < 20 { at(i) + shift } else { at(3) };
        let mut pixels2: Vec<_> = (0..50).map(moved).collect();
        pixels1.extend([Point2::new(1.0, 1.0); 40]);
        pixels2.extend([Point2::new(300.0, 1.0); 40]);
        let set = MatchSet::new(&pixels1, &pixels2).unwrap();
        let shifts = Shifts(set);
        assert_eq!(shifts.num_data(), 51);
        assert!((shifts.num_votes() - 23.0).abs() < 1e-12);
        assert_eq!(shifts.num_distinct(&[20, 21, 22]), 1);
        // A crowd is two votes, however many it has.
        let support = shifts.support(&shift, 1.0, f64::INFINITY);
        assert!(support.num_inliers == 20 && (support.cost - 3.0).abs() < 1e-12);
        let chance = shifts.chance(1.0).unwrap();
        assert!(chance > 0.0 && chance < 1e-4, "{chance}");
        let report = ransac(shifts, &RansacOptions::default()).unwrap();
        assert_eq!(report.model, shift);
        assert_eq!((report.inliers.len(), report.num_inliers), (90, 20));
        assert!(!report.could_be_chance());
    }
}
