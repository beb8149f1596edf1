//! Robust estimation of F.

use super::coordinates::{CommonFrame, Coordinates};
use super::epipolar_row;
use super::plane_recovery::PlaneRecovery;
use super::refine::refine_in_frame;
use super::sampson;
use super::seven_point::seven_point_rows;
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::robust::{
    Data, Estimator, Evidence, MatchSet, Problem, RansacOptions, RansacReport, Support, ransac,
};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Vector3};

/// Estimator of fundamental matrices from matches, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is seven matches; the error is [`sampson_px`](super::sampson_px); refinement minimizes
/// the truncated Sampson error. A sample with five or more matches on one plane does not determine
/// F: then the plane's homography and two matches off the plane give another F. Samples whose
/// points cannot all be in front of both cameras are rejected, unless the matches are so few that
/// there are no others. Equal matches count once.
///
/// Source: Hartley & Zisserman 2004, §11.6; Chum, Werner & Matas 2004, "Epipolar geometry
/// estimation via RANSAC benefits from the oriented epipolar constraint"; Chum, Werner & Matas
/// 2005, "Two-view geometry estimation unaffected by a dominant plane".
#[derive(Debug, Clone)]
pub struct FundamentalEstimator {
    matches: MatchSet,
    pixels: Coordinates,
    in_frame: Coordinates,
    frame: CommonFrame,
    recovery: PlaneRecovery,
    /// Whether samples must have all their points in front of both cameras, or all behind.
    is_oriented: bool,
}

/// Maximum number of matches for which all samples are tried in advance, to find whether one can
/// have its points in front of the cameras.
const FEW: usize = 10;

impl FundamentalEstimator {
    /// Prepares the estimation.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 7 matches, [`Error::Degenerate`]
    /// if all pixels of an image are equal or on one line.
    pub fn new(matches: MatchSet) -> Result<Self> {
        matches.at_least(7, "a fundamental matrix from matches")?;
        refuse_collinear(&matches, "a fundamental matrix from matches")?;
        let pixels = Coordinates::voting(&matches);
        let frame = CommonFrame::new(&matches);
        let in_frame = pixels.mapped(&frame);
        let mut estimator = Self {
            recovery: PlaneRecovery::new(matches.len()),
            matches,
            pixels,
            in_frame,
            frame,
            is_oriented: true,
        };
        let len = estimator.matches.len();
        estimator.is_oriented = len > FEW || estimator.has_oriented_sample(len);
        Ok(estimator)
    }

    fn has_oriented_sample(&self, len: usize) -> bool {
        let samples = (0..1_u32 << len).filter(|chosen| chosen.count_ones() == 7);
        samples.into_iter().any(|chosen| {
            let mut sample = (0..len).filter(|i| chosen >> i & 1 == 1);
            let points = core::array::from_fn(|_| self.in_frame.at(sample.next().unwrap_or(0)));
            let (solutions, count) = seven_point(&points);
            solutions[..count].iter().any(|f| is_oriented(f, &points))
        })
    }

    /// Refines F of the frame by a few steps.
    fn refined_in_frame(&self, f: &Matrix3<f64>, max_error: f64) -> Option<Matrix3<f64>> {
        let loss = RobustLoss::Truncated { width: max_error };
        refine_in_frame(&self.in_frame, f, loss, &LmOptions::few_steps(2))
    }
}

/// Rejects matches whose pixels lie on one line in either image.
pub(crate) fn refuse_collinear(matches: &MatchSet, what: &'static str) -> Result<()> {
    let [u1, v1, u2, v2] = matches.coordinates();
    for (u, v) in [(u1, v1), (u2, v2)] {
        let weight = 1.0 / u.len().max(1) as f64;
        let (mean_u, mean_v) = (
            u.iter().map(|x| x * weight).sum::<f64>(),
            v.iter().map(|x| x * weight).sum::<f64>(),
        );
        let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
        for (x, y) in u.iter().zip(v) {
            let (du, dv) = (x - mean_u, y - mean_v);
            uu += du * du;
            uv += du * dv;
            vv += dv * dv;
        }
        let total = uu + vv;
        // Product of the scatter matrix's eigenvalues against their squared sum: an extent a
        // million times as long as wide.
        if uu * vv - uv * uv <= 1e-12 * total * total {
            return Err(Error::Degenerate {
                what,
                why: "the pixels of an image lie on one line",
            });
        }
    }
    Ok(())
}

fn seven_point(points: &[[f64; 4]; 7]) -> ([Matrix3<f64>; 3], usize) {
    let rows =
        points.map(|[u1, v1, u2, v2]| epipolar_row(&Point2::new(u1, v1), &Point2::new(u2, v2)));
    seven_point_rows(&rows)
}

/// Returns whether all rays of the sample can point forward: `(e2 × x2)·(F x1)` has the same sign
/// for all.
fn is_oriented(f: &Matrix3<f64>, sample: &[[f64; 4]; 7]) -> bool {
    let columns = [0, 1, 2].map(|i| f.column(i).into_owned());
    let mut epipole2 = columns[0].cross(&columns[1]);
    for other in [columns[1].cross(&columns[2]), columns[2].cross(&columns[0])] {
        if other.norm_squared() > epipole2.norm_squared() {
            epipole2 = other;
        }
    }
    let mut first = 0.0;
    for [u1, v1, u2, v2] in sample {
        let line2 = f * Vector3::new(*u1, *v1, 1.0);
        let sign = epipole2.cross(&Vector3::new(*u2, *v2, 1.0)).dot(&line2);
        if first == 0.0 {
            first = sign;
        } else if first * sign < 0.0 {
            return false;
        }
    }
    true
}

impl Estimator for FundamentalEstimator {
    type Model = Matrix3<f64>;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a fundamental matrix from matches",
            sample_size: 7,
            max_models: 3,
            codimension: 1,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Matrix3<f64>>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        let points: [[f64; 4]; 7] = core::array::from_fn(|i| self.in_frame.at(sample[i]));
        let (solutions, count) = seven_point(&points);
        for f in &solutions[..count] {
            if !self.is_oriented || is_oriented(f, &points) {
                models.extend(self.frame.fundamental_to_pixels(f));
            }
        }
    }

    fn error_sq(&self, fundamental: &Matrix3<f64>, index: usize) -> f64 {
        let (x1, x2) = self.matches.pair(index);
        super::sampson_sq(fundamental, &x1, &x2)
    }

    fn refine(
        &mut self,
        model: &Matrix3<f64>,
        _: &[usize],
        max_error_px: f64,
    ) -> Option<Matrix3<f64>> {
        let max_error = max_error_px * self.frame.scale;
        (self.frame).fundamental_within(model, |f| self.refined_in_frame(f, max_error))
    }

    fn polish(
        &mut self,
        model: &Matrix3<f64>,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Matrix3<f64>> {
        let near = self.in_frame.weighted(near, weights);
        self.frame.fundamental_within(model, |f| {
            refine_in_frame(&near, f, RobustLoss::Trivial, &LmOptions::few_steps(4))
        })
    }

    fn alternative(
        &mut self,
        model: &Matrix3<f64>,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>> {
        let max_error = max_error_px * self.frame.scale;
        let frame = self.frame;
        frame.fundamental_within(model, |f| {
            let inliers = match evidence {
                Evidence::Inliers(inliers) => inliers,
                Evidence::Sample(sample) => {
                    return (self.recovery).recover(&self.in_frame, f, sample, max_error, random);
                }
            };
            let alternatives =
                self.recovery
                    .alternatives(&self.in_frame, f, inliers, max_error, random);
            let mut best = *f;
            for start in alternatives {
                let wide = self.refined_in_frame(&start, 2.0 * max_error);
                let refined = wide.and_then(|wide| self.refined_in_frame(&wide, max_error));
                if let Some(refined) = refined
                    && (self.recovery).fits_more_off_plane(
                        &self.in_frame,
                        &refined,
                        &best,
                        max_error,
                    )
                {
                    best = refined;
                }
            }
            (best != *f).then_some(best)
        })
    }

    fn support(&self, model: &Matrix3<f64>, max_error_px: f64, cost_limit: f64) -> Support {
        sampson::support(&self.pixels, model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &Matrix3<f64>, max_error_px: f64, inliers: &mut Vec<usize>) {
        sampson::inliers(&self.pixels, model, max_error_px, inliers);
    }
}

/// Estimates the fundamental matrix on which most matches agree, unit Frobenius norm, rank 2.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier
///
/// F is correct even if nearly all matches lie on one plane, as long as a few lie off it. If all
/// do, or the camera only rotated, many matrices fit equally well and the result is one of them;
/// [`estimate_two_view`](crate::two_view::estimate_two_view) distinguishes the cases.
///
/// # Errors
/// As [`MatchSet::new`], [`FundamentalEstimator::new`] and [`ransac`].
///
/// Source: as [`FundamentalEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::estimate_fundamental;
/// use epipole::robust::RansacOptions;
/// use nalgebra::Point2;
/// // A step to the right: each point keeps its row and moves by its disparity. Every fourth match
/// // is wrong.
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().enumerate().map(|(i, p)| {
///     let wrong = if i % 4 == 0 { 40.0 + i as f64 } else { 0.0 };
///     Point2::new(p.x - (5 + i * 13 % 31) as f64, p.y + wrong)
/// }).collect();
/// let report = estimate_fundamental(&p1, &p2, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 45);
/// assert!(report.model[(2, 2)].abs() < 1e-6);
/// # Ok(()) }
/// ```
#[doc(alias = "findFundamentalMat")]
pub fn estimate_fundamental(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    ransac(FundamentalEstimator::new(matches)?, options, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight to ten random matches: a sample of seven fits exactly, whatever the signs of its
    /// depths.
    #[test]
    fn few_matches_have_a_matrix_whatever_is_behind_a_camera() {
        let mut num_unoriented = 0;
        for seed in 0..60 {
            let mut random = Random::new(seed);
            let len = 8 + random.below(3);
            let mut pixels = || -> Vec<_> {
                let mut at = |size: f64| random.uniform(0.0, size);
                (0..len)
                    .map(|_| Point2::new(at(640.0), at(480.0)))
                    .collect()
            };
            let (p1, p2) = (pixels(), pixels());
            let set = MatchSet::new(&p1, &p2).unwrap();
            let estimator = FundamentalEstimator::new(set).unwrap();
            num_unoriented += usize::from(!estimator.is_oriented);
            let report =
                estimate_fundamental(&p1, &p2, &RansacOptions::default(), &mut ()).unwrap();
            assert!(report.num_inliers >= 7, "{seed}");
        }
        assert!(num_unoriented > 0);
    }
}
