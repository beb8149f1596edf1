//! Robust estimation of H.

use super::four_point::{same_orientation, solve};
use super::refine::{refine_in_frame, to_frame, to_pixels};
use super::refine_both::refine_by_both_images;
use super::sums;
use crate::epipolar::coordinates::{CommonFrame, Coordinates};
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::robust::{
    Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, Support, ransac,
};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// Estimator of homographies from matches, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is four matches, no three of them collinear, whose triangles have the same orientation
/// in both images; the error is the distance in image 2; refinement minimizes its truncated square,
/// and the final one the weighted square of the Sampson error, which treats both images alike.
/// Equal matches count once.
#[derive(Debug, Clone)]
pub struct HomographyEstimator {
    matches: MatchSet,
    pixels: Coordinates,
    in_frame: Coordinates,
    frame: CommonFrame,
}

/// Returns whether points lie on one line up to rounding: no four of them determine a homography.
fn is_line(u: &[f64], v: &[f64]) -> bool {
    let from_first = |i: usize| [u[i] - u[0], v[i] - v[0]];
    let length_sq = |[x, y]: [f64; 2]| x * x + y * y;
    let [x, y] = (1..u.len()).map(from_first).fold([0.0; 2], |far, d| {
        if length_sq(d) > length_sq(far) {
            d
        } else {
            far
        }
    });
    // The tolerance, relative to the length of the line, is that for three points of a sample.
    let reach_sq = length_sq([x, y]);
    (1..u.len())
        .map(from_first)
        .all(|d| (d[0] * y - d[1] * x).abs() <= 1e-12 * reach_sq)
}

impl HomographyEstimator {
    /// Prepares the estimation.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 4 matches, [`Error::Degenerate`]
    /// if all pixels of an image lie on one line.
    pub fn new(matches: MatchSet) -> Result<Self> {
        matches.at_least(4, "a homography from matches")?;
        let [u1, v1, u2, v2] = matches.coordinates();
        if is_line(u1, v1) || is_line(u2, v2) {
            return Err(Error::Degenerate {
                what: "a homography from matches",
                why: "all pixels of an image lie on one line",
            });
        }
        let pixels = Coordinates::voting(&matches);
        let frame = CommonFrame::new(&matches);
        Ok(Self {
            in_frame: pixels.mapped(&frame),
            matches,
            pixels,
            frame,
        })
    }

    fn refined(
        &self,
        homography: &Matrix3<f64>,
        coordinates: &Coordinates,
        loss: RobustLoss,
        max_iterations: usize,
    ) -> Option<Matrix3<f64>> {
        let start = to_frame(&self.frame, homography);
        let refined = refine_in_frame(
            coordinates,
            &start,
            loss,
            &LmOptions::few_steps(max_iterations),
        )?;
        to_pixels(&self.frame, &refined)
    }
}

impl Estimator for HomographyEstimator {
    type Model = Matrix3<f64>;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a homography from matches",
            sample_size: 4,
            max_models: 1,
            codimension: 2,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Matrix3<f64>>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        let points: [[f64; 4]; 4] = core::array::from_fn(|i| self.in_frame.at(sample[i]));
        let (p1, p2) = (
            points.map(|[u1, v1, _, _]| [u1, v1]),
            points.map(|[_, _, u2, v2]| [u2, v2]),
        );
        if same_orientation(&p1, &p2)
            && let Some(h) = solve(&p1, &p2)
        {
            models.extend(to_pixels(&self.frame, &h));
        }
    }

    fn error_sq(&self, homography: &Matrix3<f64>, index: usize) -> f64 {
        let (x1, x2) = self.matches.pair(index);
        super::transfer_error_sq(homography, &x1, &x2)
    }

    fn refine(
        &mut self,
        model: &Matrix3<f64>,
        _: &[usize],
        max_error_px: f64,
    ) -> Option<Matrix3<f64>> {
        let loss = RobustLoss::Truncated {
            width: max_error_px * self.frame.scale,
        };
        self.refined(model, &self.in_frame, loss, 2)
    }

    fn polish(
        &mut self,
        model: &Matrix3<f64>,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Matrix3<f64>> {
        let near = self.in_frame.weighted(near, weights);
        let start = to_frame(&self.frame, model);
        let refined = refine_by_both_images(&near, &start, &LmOptions::few_steps(4))?;
        to_pixels(&self.frame, &refined)
    }

    fn support(&self, model: &Matrix3<f64>, max_error_px: f64, cost_limit: f64) -> Support {
        sums::support(&self.pixels, model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &Matrix3<f64>, max_error_px: f64, inliers: &mut Vec<usize>) {
        sums::inliers(&self.pixels, model, max_error_px, inliers);
    }
}

/// Estimates the homography on which most matches agree, unit Frobenius norm.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `options`: [`RansacOptions::max_error_px`] bounds the distance of an inlier in image 2
///
/// Mirrored images are rejected. Two cameras on the same side of a plane see its triangles with the
/// same orientation, so a sample with a flipped triangle contains a wrong match and is skipped. An
/// image and its mirror image therefore give [`Error::NoConsensus`]: flip one of them first, or use
/// [`fit_homography`](super::fit_homography), which allows any orientation.
///
/// # Errors
/// As [`MatchSet::new`], [`HomographyEstimator::new`] and [`ransac`].
///
/// Source: Hartley & Zisserman 2004, algorithm 4.6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::homography::estimate_homography;
/// use epipole::robust::RansacOptions;
/// use nalgebra::Point2;
/// // A shift by (5, 3); every fourth match is wrong.
/// let p1: Vec<_> = (0..40).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().enumerate().map(|(i, p)| {
///     if i % 4 == 0 { Point2::new(p.y, 90.0) } else { Point2::new(p.x + 5.0, p.y + 3.0) }
/// }).collect();
/// let report = estimate_homography(&p1, &p2, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 30);
/// assert!((report.model[(0, 2)] / report.model[(2, 2)] - 5.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
#[doc(alias = "findHomography")]
pub fn estimate_homography(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    ransac(HomographyEstimator::new(matches)?, options, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Previously this drew ten thousand samples in vain.
    #[test]
    fn pixels_on_a_line_are_refused_at_once() {
        let line: Vec<_> = (0..50)
            .map(|i| Point2::new(12.3 + 7.7 * f64::from(i), 400.1 - 3.3 * f64::from(i)))
            .collect();
        let anywhere: Vec<_> = (0..50)
            .map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480)))
            .collect();
        for (p1, p2) in [(&line, &line), (&line, &anywhere), (&anywhere, &line)] {
            let error =
                estimate_homography(p1, p2, &RansacOptions::default(), &mut ()).unwrap_err();
            assert!(matches!(error, Error::Degenerate { .. }), "{error}");
            assert!(error.to_string().contains("one line"));
        }
        // One pixel off the line is not enough, but two are.
        let mut bent = line.clone();
        bent[3].y += 40.0;
        bent[40].y -= 30.0;
        let report = estimate_homography(&bent, &bent, &RansacOptions::default(), &mut ()).unwrap();
        assert_eq!(report.num_inliers, 50);
    }
}
