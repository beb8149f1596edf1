//! Interface between a robust problem and the RANSAC loop.

use super::{Data, Support};
use crate::math::random::Random;

/// Description of a robust problem.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// Name of the model, for error messages: "a homography from matches".
    pub name: &'static str,
    /// Number of data points in a minimal sample.
    pub sample_size: usize,
    /// Maximum number of models a sample yields.
    pub max_models: usize,
    /// Dimension of an error: 1 for the distance from a line, 2 for the distance from a point.
    pub codimension: usize,
    /// The data.
    pub data: Data<'a>,
}

/// Evidence for a model whose degeneracy is tested.
#[derive(Debug, Clone, Copy)]
pub enum Evidence<'a> {
    /// The model comes from this sample and is better than all before.
    Sample(&'a [usize]),
    /// The model is the final one, with these inliers.
    Inliers(&'a [usize]),
}

/// A problem that [`Ransac`](super::Ransac) can solve.
///
/// Data are addressed by index and have no repetitions; errors are in pixels. An estimator keeps
/// its buffers, so that no call in the loop allocates.
///
/// Required are the description, a minimal solver, the error and a refinement. `support` and
/// `inliers` may be overridden for speed, `polish` and `alternative` for accuracy.
///
/// ```
/// use epipole::robust::{Data, Estimator, Problem, RansacOptions, ransac};
///
/// /// The value that most numbers agree on.
/// struct Level(Vec<f64>);
///
/// impl Estimator for Level {
///     type Model = f64;
///     fn problem(&self) -> Problem<'_> {
///         Problem {
///             name: "a level",
///             sample_size: 1,
///             max_models: 1,
///             codimension: 1,
///             data: Data::Other(self.0.len()),
///         }
///     }
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
/// let report = ransac(Level(vec![4.75, 5.25, 99.0, 5.0]), &RansacOptions::default(), &mut ())?;
/// assert_eq!((report.model, report.num_inliers), (5.0, 3));
/// # Ok(()) }
/// ```
pub trait Estimator {
    /// The model. Cloning must not allocate.
    type Model: Clone;

    /// Describes the problem and its data.
    fn problem(&self) -> Problem<'_>;

    /// Pushes every model that fits the sample, none if the sample is degenerate.
    ///
    /// `sample` holds [`Problem::sample_size`] different indices.
    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>);

    /// Returns the squared distance of a data point from a model, px².
    fn error_sq(&self, model: &Self::Model, index: usize) -> f64;

    /// Improves a model from the data within the threshold; `None` if it cannot be improved.
    fn refine(
        &mut self,
        model: &Self::Model,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<Self::Model>;

    /// Refines a model by weighted least squares, for the final refinement; `None` if
    /// [`refine`](Estimator::refine) suffices. May allocate.
    ///
    /// * `near`: indices of the data close to the model
    /// * `weights`: weight of each of them, in [0, 1]
    fn polish(
        &mut self,
        model: &Self::Model,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Self::Model> {
        let _ = (model, near, weights);
        None
    }

    /// Degeneracy test: returns a model to try in place of one whose sample or inliers are
    /// degenerate. May allocate at the end.
    ///
    /// The alternative for a sample is used if it is better, the final one always.
    fn alternative(
        &mut self,
        model: &Self::Model,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Self::Model> {
        let _ = (model, evidence, max_error_px, random);
        None
    }

    /// Computes the support of a model. May stop once the cost exceeds `cost_limit`.
    fn support(&self, model: &Self::Model, max_error_px: f64, cost_limit: f64) -> Support {
        let error_sq = |index| self.error_sq(model, index);
        (self.problem().data).support(error_sq, max_error_px, cost_limit)
    }

    /// Fills `inliers` with the indices of the data within the threshold.
    fn inliers(&self, model: &Self::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        let per_threshold_sq = 1.0 / (max_error_px * max_error_px);
        let fits = |&index: &usize| self.error_sq(model, index) * per_threshold_sq < 1.0;
        inliers.clear();
        inliers.extend((0..self.problem().data.len()).filter(fits));
    }
}

/// Borrowed estimators: [`ransac`](super::ransac) compiles its loop once for each kind of model.
impl<E: Estimator + ?Sized> Estimator for &mut E {
    type Model = E::Model;

    fn problem(&self) -> Problem<'_> {
        (**self).problem()
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<E::Model>) {
        (**self).fit_sample(sample, models);
    }

    fn error_sq(&self, model: &E::Model, index: usize) -> f64 {
        (**self).error_sq(model, index)
    }

    fn refine(&mut self, model: &E::Model, inliers: &[usize], px: f64) -> Option<E::Model> {
        (**self).refine(model, inliers, px)
    }

    fn polish(&mut self, model: &E::Model, near: &[usize], weights: &[f64]) -> Option<E::Model> {
        (**self).polish(model, near, weights)
    }

    fn alternative(
        &mut self,
        model: &E::Model,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<E::Model> {
        (**self).alternative(model, evidence, max_error_px, random)
    }

    fn support(&self, model: &E::Model, max_error_px: f64, cost_limit: f64) -> Support {
        (**self).support(model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &E::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        (**self).inliers(model, max_error_px, inliers);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MatchSet, RansacOptions, ransac};
    use super::*;
    use nalgebra::{Point2, Vector2};

    /// Shifts from matches, with only the required methods.
    struct Shifts(MatchSet);

    impl Estimator for Shifts {
        type Model = Vector2<f64>;
        fn problem(&self) -> Problem<'_> {
            Problem {
                name: "a shift from matches",
                sample_size: 1,
                max_models: 1,
                codimension: 2,
                data: Data::Matches(&self.0),
            }
        }
        fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
            let (p1, p2) = self.0.pair(sample[0]);
            models.push(p2 - p1);
        }
        fn error_sq(&self, shift: &Self::Model, index: usize) -> f64 {
            let (p1, p2) = self.0.pair(index);
            (p2 - p1 - shift).norm_squared()
        }
        fn refine(&mut self, _: &Self::Model, _: &[usize], _: f64) -> Option<Self::Model> {
            None
        }
    }

    #[test]
    fn matches_provide_votes_repetitions_and_probabilities() {
        // Twenty matches move by (7, 2); thirty more share one pixel, and one is repeated forty
        // times.
        let at = |i: usize| Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
        let shift = Vector2::new(7.0, 2.0);
        let mut pixels1: Vec<_> = (0..50).map(at).collect();
        let moved = |i: usize| if i < 20 { at(i) + shift } else { at(3) };
        let mut pixels2: Vec<_> = (0..50).map(moved).collect();
        pixels1.extend([Point2::new(1.0, 1.0); 40]);
        pixels2.extend([Point2::new(300.0, 1.0); 40]);
        let set = MatchSet::new(&pixels1, &pixels2).unwrap();
        let shifts = Shifts(set);
        let data = shifts.problem().data;
        assert_eq!(data.len(), 51);
        assert!((data.num_votes() - 23.0).abs() < 1e-12);
        assert_eq!(data.num_distinct(&[20, 21, 22]), 1);
        // Matches with the same pixel weigh as much as two, however many they are.
        let support = shifts.support(&shift, 1.0, f64::INFINITY);
        assert!(support.num_inliers == 20 && (support.cost - 3.0).abs() < 1e-12);
        let random_inlier_probability = data.random_inlier_probability(2, 1.0).unwrap();
        assert!(
            random_inlier_probability > 0.0 && random_inlier_probability < 1e-4,
            "{random_inlier_probability}"
        );
        let report = ransac(shifts, &RansacOptions::default(), &mut ()).unwrap();
        assert_eq!(report.model, shift);
        assert_eq!((report.inliers.len(), report.num_inliers), (90, 20));
        assert!(!report.could_be_random());
    }
}
