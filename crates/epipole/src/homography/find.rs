//! H from matches of which many are wrong.

use super::four_point::{same_orientation, solve};
use super::refine::{refine_in_frame, to_frame, to_pixels};
use super::sums;
use crate::epipolar::coordinates::{CommonFrame, Coordinates};
use crate::optim::{LmOptions, RobustLoss};
use crate::robust::{Estimator, MatchSet, RansacOptions, RansacReport, Support, Unique, ransac};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// Homographies from matches, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is four matches, no three of them on a line, whose triangles turn the same way in both
/// images; the error is the distance in image 2; refinement minimizes its truncated square. Equal
/// matches count once.
#[derive(Debug, Clone)]
pub struct HomographyEstimator {
    matches: MatchSet,
    pixels: Coordinates,
    in_frame: Coordinates,
    frame: CommonFrame,
}

impl HomographyEstimator {
    /// Prepares the estimation.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than 4 different matches.
    pub fn new(matches: MatchSet) -> Result<Self> {
        if matches.len() < 4 {
            return Err(Error::TooFew {
                what: "a homography from matches",
                needed: 4,
                got: matches.len(),
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
        let options = LmOptions {
            max_iterations,
            cost_tolerance: 1e-5,
            step_tolerance: 1e-9,
            ..LmOptions::default()
        };
        let start = to_frame(&self.frame, homography);
        let refined = refine_in_frame(coordinates, &start, loss, &options)?;
        to_pixels(&self.frame, &refined)
    }
}

impl Estimator for HomographyEstimator {
    type Model = Matrix3<f64>;

    fn name(&self) -> &'static str {
        "a homography from matches"
    }

    fn sample_size(&self) -> usize {
        4
    }

    fn num_data(&self) -> usize {
        self.matches.len()
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
        self.refined(model, &near, RobustLoss::Trivial, 4)
    }

    fn support(&self, model: &Matrix3<f64>, max_error_px: f64, cost_limit: f64) -> Support {
        sums::support(&self.pixels, model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &Matrix3<f64>, max_error_px: f64, inliers: &mut Vec<usize>) {
        sums::inliers(&self.pixels, model, max_error_px, inliers);
    }

    fn chance(&self, max_error_px: f64) -> Option<f64> {
        Some(self.matches.chance_near_point2(max_error_px))
    }

    fn num_votes(&self) -> f64 {
        self.matches.num_votes()
    }

    fn num_distinct(&self, inliers: &[usize]) -> usize {
        self.matches.num_distinct(inliers)
    }

    fn unique(&self) -> Option<&Unique> {
        Some(self.matches.unique())
    }
}

/// The homography that most matches agree on, unit Frobenius norm.
///
/// * `pixels1`, `pixels2`: matching pixels; wrong matches are expected
/// * `options`: [`RansacOptions::max_error_px`] bounds the distance of an inlier in image 2
///
/// Mirrored images are refused. Two cameras on the same side of a plane see every triangle of it turn the
/// same way, so a sample with one that turns over holds a wrong match, and is skipped. An image and its
/// mirror image therefore give [`Error::NoConsensus`]: flip one of them first, or use
/// [`fit_homography`](super::fit_homography), which takes matches as they are.
///
/// # Errors
/// As [`MatchSet::new`], [`HomographyEstimator::new`] and [`ransac`]; pixels on one line give
/// [`Error::NoConsensus`].
///
/// Source: Hartley & Zisserman 2004, algorithm 4.6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::homography::find_homography;
/// use epipole::robust::RansacOptions;
/// use nalgebra::Point2;
/// // A shift by (5, 3); every fourth match is wrong.
/// let p1: Vec<_> = (0..40).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().enumerate().map(|(i, p)| {
///     if i % 4 == 0 { Point2::new(p.y, 90.0) } else { Point2::new(p.x + 5.0, p.y + 3.0) }
/// }).collect();
/// let report = find_homography(&p1, &p2, &RansacOptions::default())?;
/// assert_eq!(report.num_inliers, 30);
/// assert!((report.model[(0, 2)] / report.model[(2, 2)] - 5.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
#[doc(alias = "findHomography")]
pub fn find_homography(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &RansacOptions,
) -> Result<RansacReport<Matrix3<f64>>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    ransac(HomographyEstimator::new(matches)?, options)
}
