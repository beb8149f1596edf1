//! Pairs of photos that overlap.

use crate::homography::{HomographyEstimator, transfer_error_px};
use crate::progress::Monitor;
use crate::robust::{MatchSet, RansacOptions, ransac};
use crate::two_view::{Configuration, TwoViewOptions, estimate_two_view};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Matrix3, Point2};

/// Options of [`find_overlap`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct OverlapOptions {
    /// Robust estimation of the homography, with a threshold of 3 px.
    pub ransac: RansacOptions,
    /// Minimum number of inliers. 12.
    pub min_num_inliers: usize,
}

impl Default for OverlapOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default().within(3.0),
            min_num_inliers: 12,
        }
    }
}

/// Two overlapping photos and their inliers.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap {
    /// Indices of the photos.
    pub images: [usize; 2],
    /// Matching pixels in each.
    pub pixels: [Vec<Point2<f64>>; 2],
    /// `x2 ∝ H x1`.
    pub homography: Matrix3<f64>,
    /// Number of matches, including outliers.
    pub num_matches: usize,
    /// Whether the matches show parallax: the camera moved, and no homography fits all of them.
    pub has_parallax: bool,
}

/// Finds the homography on which the matches of two photos agree, and detects parallax.
///
/// * `images`: indices of the photos
/// * `pixels1`, `pixels2`: matches, outliers included
///
/// Returns `None` if no more matches agree than wrong ones might by chance.
///
/// # Errors
/// As [`MatchSet::new`] and [`ransac`]; too few matches are no error.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stitch::{OverlapOptions, find_overlap};
/// use nalgebra::Point2;
/// // Shifted by 200 px, except for every fourth match.
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let mut p2: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 200.0, p.y)).collect();
/// for (i, p) in p2.iter_mut().enumerate().step_by(4) {
///     *p = Point2::new((i * 113 % 640) as f64, (i * 29 % 480) as f64);
/// }
/// let overlap = find_overlap([0, 1], &p1, &p2, &OverlapOptions::default(), &mut ())?.unwrap();
/// assert!(overlap.pixels[0].len() >= 45 && !overlap.has_parallax);
/// assert!((overlap.homography[(0, 2)] / overlap.homography[(2, 2)] + 200.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn find_overlap(
    images: [usize; 2],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &OverlapOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Overlap>> {
    let estimator = HomographyEstimator::new(MatchSet::new(pixels1, pixels2)?);
    let report = match estimator.and_then(|it| ransac(it, &options.ransac, &mut *monitor)) {
        Ok(report) => report,
        Err(Error::TooFew { .. } | Error::TooFewDistinct { .. } | Error::NoConsensus { .. }) => {
            return Ok(None);
        }
        Err(error) => return Err(error),
    };
    if report.num_unique_inliers < options.min_num_inliers || report.could_be_random() {
        return Ok(None);
    }
    let homography = report.model;
    let pairs = pixels1.iter().zip(pixels2);
    // The final refinement of the homography changed some errors.
    let near = |(a, b): &(&Point2<f64>, &Point2<f64>)| {
        transfer_error_px(&homography, a, b) <= report.max_error_px
    };
    let (in1, in2) = pairs.filter(near).map(|(a, b)| (*a, *b)).unzip();
    let two_view = TwoViewOptions::default().with_ransac(options.ransac);
    let views = estimate_two_view(pixels1, pixels2, &two_view, monitor)?;
    Ok(Some(Overlap {
        images,
        pixels: [in1, in2],
        homography,
        num_matches: pixels1.len(),
        has_parallax: views.configuration == Configuration::General,
    }))
}
