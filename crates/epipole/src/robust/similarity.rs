//! Similarities of the plane: rotation, scale, translation.

use super::{Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, ransac};
use crate::progress::Monitor;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// The map `u' = a u − b v + tu`, `v' = b u + a v + tv`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneSimilarity {
    /// Scale times the cosine of the angle.
    pub a: f64,
    /// Scale times the sine of the angle.
    pub b: f64,
    /// Translation along u.
    pub tu: f64,
    /// Translation along v.
    pub tv: f64,
}

impl PlaneSimilarity {
    /// Maps a point.
    pub fn apply(&self, p: &Point2<f64>) -> Point2<f64> {
        Point2::new(
            self.a * p.x - self.b * p.y + self.tu,
            self.b * p.x + self.a * p.y + self.tv,
        )
    }

    /// Returns the scale factor.
    pub fn scale(&self) -> f64 {
        libm::hypot(self.a, self.b)
    }

    /// Returns the rotation from u towards v, in (−π, π].
    pub fn angle_rad(&self) -> f64 {
        libm::atan2(self.b, self.a)
    }

    /// Returns the map as a 3×3 matrix on homogeneous points.
    #[rustfmt::skip]
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(
            self.a, -self.b, self.tu,
            self.b,  self.a, self.tv,
            0.0,     0.0,    1.0,
        )
    }
}

/// Fits the similarity with the smallest sum of squared errors in image 2, `Σ ‖p2 − S p1‖²`.
///
/// With points as complex numbers measured from their centroids,
/// `a + i b = Σ conj(z1) z2 / Σ |z1|²`.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two matches, [`Error::Degenerate`] if all points of image 1 are
/// equal, [`Error::OutOfRange`] for coordinates beyond 10⁹ pixels, [`Error::NotFinite`] for
/// infinities, and as [`MatchSet::new`].
///
/// Source: Umeyama 1991, in two dimensions, without reflection.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::fit_similarity;
/// use nalgebra::Point2;
/// let p1 = [Point2::new(0.0, 0.0), Point2::new(1.0, 0.0)];
/// let p2 = [Point2::new(5.0, 5.0), Point2::new(5.0, 7.0)]; // a quarter turn, twice as large
/// let s = fit_similarity(&p1, &p2)?;
/// assert_eq!((s.a, s.b, s.tu, s.tv), (0.0, 2.0, 5.0, 5.0));
/// # Ok(()) }
/// ```
pub fn fit_similarity(pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Result<PlaneSimilarity> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    matches.at_least(2, "a similarity from matches")?;
    fit(pixels1.len(), |i| (pixels1[i], pixels2[i])).ok_or(Error::Degenerate {
        what: "a similarity from matches",
        why: "all points of the first image are equal",
    })
}

fn fit(
    num_matches: usize,
    pair: impl Fn(usize) -> (Point2<f64>, Point2<f64>),
) -> Option<PlaneSimilarity> {
    let weight = 1.0 / num_matches as f64;
    let (mut m1, mut m2) = (Point2::origin(), Point2::origin());
    for i in 0..num_matches {
        let (p1, p2) = pair(i);
        m1 += p1.coords * weight;
        m2 += p2.coords * weight;
    }
    let (mut size_sq, mut real, mut imaginary) = (0.0, 0.0, 0.0);
    for i in 0..num_matches {
        let (p1, p2) = pair(i);
        let (d1, d2) = (p1 - m1, p2 - m2);
        size_sq += d1.x * d1.x + d1.y * d1.y;
        real += d1.x * d2.x + d1.y * d2.y;
        imaginary += d1.x * d2.y - d1.y * d2.x;
    }
    let rounding = f64::EPSILON * (m1.x.abs() + m1.y.abs());
    if size_sq <= 16.0 * num_matches as f64 * rounding * rounding {
        return None;
    }
    let (a, b) = (real / size_sq, imaginary / size_sq);
    let similarity = PlaneSimilarity {
        a,
        b,
        tu: m2.x - (a * m1.x - b * m1.y),
        tv: m2.y - (b * m1.x + a * m1.y),
    };
    [a, b, similarity.tu, similarity.tv]
        .into_iter()
        .all(f64::is_finite)
        .then_some(similarity)
}

/// Estimator of similarities from matches with outliers, for [`Ransac`](super::Ransac).
///
/// A sample is two matches; the error is the distance in image 2. Equal matches count once, and
/// matches that share a pixel have a limited weight together.
#[derive(Debug, Clone)]
pub struct SimilarityEstimator {
    matches: MatchSet,
}

impl SimilarityEstimator {
    /// Prepares the estimation.
    pub fn new(matches: MatchSet) -> Self {
        Self { matches }
    }
}

impl Estimator for SimilarityEstimator {
    type Model = PlaneSimilarity;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a similarity from matches",
            sample_size: 2,
            max_models: 1,
            codimension: 2,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<PlaneSimilarity>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        // A map that collapses the image to a point is no similarity.
        models
            .extend(fit(2, |i| self.matches.pair(sample[i])).filter(|s| s.a != 0.0 || s.b != 0.0));
    }

    fn error_sq(&self, similarity: &PlaneSimilarity, index: usize) -> f64 {
        let (p1, p2) = self.matches.pair(index);
        let off = similarity.apply(&p1) - p2;
        off.x * off.x + off.y * off.y
    }

    fn refine(
        &mut self,
        _: &PlaneSimilarity,
        inliers: &[usize],
        _: f64,
    ) -> Option<PlaneSimilarity> {
        fit(inliers.len(), |i| self.matches.pair(inliers[i]))
    }
}

/// Estimates the similarity on which most matches agree.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
///
/// # Errors
/// As [`MatchSet::new`] and [`ransac`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{RansacOptions, estimate_similarity};
/// use nalgebra::Point2;
/// let p1 = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0), (5.0, 5.0)].map(|(u, v)| Point2::new(u, v));
/// let mut p2 = p1.map(|p| Point2::new(p.x + 3.0, p.y));
/// p2[3] = Point2::new(50.0, -20.0);
/// let report = estimate_similarity(&p1, &p2, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.inliers, [true, true, true, false]);
/// assert!((report.model.tu - 3.0).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn estimate_similarity(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<PlaneSimilarity>> {
    ransac(
        SimilarityEstimator::new(MatchSet::new(pixels1, pixels2)?),
        options,
        monitor,
    )
}

#[cfg(test)]
mod tests {
    use super::super::{SamplerKind, ScoreKind};
    use super::*;
    use crate::math::random::Random;

    /// As in COLMAP's src/colmap/optim/ransac_test.cc, in the plane: 1000 matches, the first 400
    /// wrong.
    fn problem(seed: u64) -> (PlaneSimilarity, Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let mut random = Random::new(seed);
        let truth = PlaneSimilarity {
            a: 1.5,
            b: -0.7,
            tu: 100.0,
            tv: -20.0,
        };
        let point = |random: &mut Random| {
            Point2::new(random.uniform(0.0, 1000.0), random.uniform(0.0, 1000.0))
        };
        let p1: Vec<_> = (0..1000).map(|_| point(&mut random)).collect();
        let p2 = p1
            .iter()
            .enumerate()
            .map(|(i, p)| {
                if i < 400 {
                    // At least 20 pixels off, so that the mask is unambiguous.
                    let off = point(&mut random).coords + nalgebra::Vector2::new(20.0, 20.0);
                    truth.apply(p) + off
                } else {
                    truth.apply(p)
                }
            })
            .collect();
        (truth, p1, p2)
    }

    #[test]
    fn four_hundred_outliers_of_a_thousand() {
        for seed in 0..10 {
            let (truth, p1, p2) = problem(seed);
            for sampler in [SamplerKind::Uniform, SamplerKind::Prosac] {
                for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
                    let options = RansacOptions {
                        max_error_px: 10.0,
                        seed,
                        sampler,
                        score,
                        ..RansacOptions::default()
                    };
                    let report = estimate_similarity(&p1, &p2, &options, &mut ()).unwrap();
                    let wrong = (report.inliers.iter().enumerate())
                        .filter(|&(i, &inlier)| inlier != (i >= 400))
                        .count();
                    assert_eq!(wrong, 0, "seed {seed} {sampler:?} {score:?} {report:?}");
                    assert!((report.model.matrix() - truth.matrix()).norm() < 1e-6);
                    assert_eq!(
                        estimate_similarity(&p1, &p2, &options, &mut ()).unwrap(),
                        report
                    );
                }
            }
        }
    }

    #[test]
    fn degenerate_matches_are_refused() {
        let options = RansacOptions::default();
        let same = vec![Point2::new(1.0, 1.0); 5];
        assert!(estimate_similarity(&same, &same, &options, &mut ()).is_err());
        assert!(fit_similarity(&same, &same).is_err());
        assert!(fit_similarity(&[], &[]).is_err());
        let spread: Vec<_> = (0..5).map(|i| Point2::new(f64::from(i), 0.0)).collect();
        assert!(fit_similarity(&same, &spread).is_err());
        assert!(matches!(
            estimate_similarity(&same, &spread, &options, &mut ()),
            Err(Error::NoConsensus { .. })
        ));
    }
}
