//! Degeneracies of the inliers of F.

use super::TwoViewOptions;
use super::pairs::inliers_of;
use crate::homography::estimate_homography;
use crate::robust::RansacOptions;
use crate::{Error, Result};
use nalgebra::Point2;

/// Maximum number of four-match samples: where a homography explains nearly all, a tenth is plenty.
const MAX_SAMPLES: usize = 500;

/// Reason why a fundamental matrix is not determined by its inliers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degeneracy {
    /// Nearly all inliers have the same position in both images, up to noise: the camera hardly
    /// moved, or the matches are on an object that moves with it.
    Unmoved {
        /// Number of unmoved inliers.
        num_unmoved: usize,
        /// Number of inliers.
        num_inliers: usize,
    },
    /// A homography explains nearly all inliers: they show a plane, or the camera only rotated.
    Homography {
        /// Number of inliers that it explains.
        num_explained: usize,
        /// Number of inliers.
        num_inliers: usize,
    },
}

/// Checks whether the inliers determine F, and if not, why. F also fits the matches of a camera
/// that never moved or only rotated, and those of a plane, but is meaningless there.
///
/// * `pixels1`, `pixels2`: the matches from which F was estimated
/// * `inliers`: for each match, whether it is an inlier of F
/// * `options`: [`TwoViewOptions::max_homography_ratio`] defines "nearly all", and
///   [`RansacOptions::max_error_px`] should be that of F. The threshold of the homography is 1.25
///   √2 times as large, since its errors have two dimensions and the noise of both images
///
/// # Errors
/// [`Error::SizeMismatch`] if the lists differ in length, [`Error::NotFinite`] for NaN, and as
/// [`TwoViewOptions::check`].
///
/// Source: Hartley & Zisserman 2004, §11.9 (degenerate configurations).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::two_view::{Degeneracy, TwoViewOptions, find_degeneracy};
/// use nalgebra::Point2;
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let (all, options) = ([true; 60], TwoViewOptions::default());
/// let unmoved = Degeneracy::Unmoved { num_unmoved: 60, num_inliers: 60 };
/// assert_eq!(find_degeneracy(&p1, &p1, &all, &options)?, Some(unmoved));
/// // A step to the right past a frontal wall: everything moves by 12 pixels.
/// let wall: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 12.0, p.y)).collect();
/// let plane = Degeneracy::Homography { num_explained: 60, num_inliers: 60 };
/// assert_eq!(find_degeneracy(&p1, &wall, &all, &options)?, Some(plane));
/// // With depth, near objects move more than far ones.
/// let depth: Vec<_> = (0..60).map(|i| Point2::new(p1[i].x - (5 + i * 13 % 31) as f64, p1[i].y)).collect();
/// assert_eq!(find_degeneracy(&p1, &depth, &all, &options)?, None);
/// # Ok(()) }
/// ```
pub fn find_degeneracy(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
    options: &TwoViewOptions,
) -> Result<Option<Degeneracy>> {
    let unmoved = find_unmoved(pixels1, pixels2, inliers, options)?;
    if unmoved.is_some() {
        return Ok(unmoved);
    }
    let [in1, in2] = inliers_of(pixels1, pixels2, inliers)?;
    let num_inliers = in1.len();
    let in_two_dimensions = options.in_two_dimensions();
    let ransac = RansacOptions {
        max_iterations: in_two_dimensions.max_iterations.min(MAX_SAMPLES),
        ..in_two_dimensions
    };
    let num_explained = match estimate_homography(&in1, &in2, &ransac, &mut ()) {
        Ok(report) => report.num_inliers,
        Err(
            Error::TooFew { .. }
            | Error::TooFewDistinct { .. }
            | Error::NoConsensus { .. }
            | Error::Degenerate { .. },
        ) => 0,
        Err(error) => return Err(error),
    };
    let explained = nearly_all(num_explained, num_inliers, options);
    Ok(explained.then_some(Degeneracy::Homography {
        num_explained,
        num_inliers,
    }))
}

/// Checks whether nearly all inliers of a model are unmoved: returns [`Degeneracy::Unmoved`] or
/// `None`. For a homography, determined by planes and rotations, this is the only degeneracy;
/// [`find_degeneracy`] checks it first.
///
/// # Errors
/// [`Error::SizeMismatch`] if the lists differ in length, and as [`TwoViewOptions::check`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::two_view::{Degeneracy, TwoViewOptions, find_unmoved};
/// use nalgebra::Point2;
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let (all, options) = ([true; 60], TwoViewOptions::default());
/// let unmoved = Degeneracy::Unmoved { num_unmoved: 60, num_inliers: 60 };
/// assert_eq!(find_unmoved(&p1, &p1, &all, &options)?, Some(unmoved));
/// let moved: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 12.0, p.y)).collect();
/// assert_eq!(find_unmoved(&p1, &moved, &all, &options)?, None);
/// # Ok(()) }
/// ```
pub fn find_unmoved(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
    options: &TwoViewOptions,
) -> Result<Option<Degeneracy>> {
    options.check()?;
    let [in1, in2] = inliers_of(pixels1, pixels2, inliers)?;
    let reach_px = options.in_two_dimensions().max_error_px;
    let pairs = in1.iter().zip(&in2);
    let num_unmoved = pairs
        .filter(|(p1, p2)| (*p1 - *p2).norm() < reach_px)
        .count();
    let num_inliers = in1.len();
    Ok(
        nearly_all(num_unmoved, num_inliers, options).then_some(Degeneracy::Unmoved {
            num_unmoved,
            num_inliers,
        }),
    )
}

fn nearly_all(count: usize, num_inliers: usize, options: &TwoViewOptions) -> bool {
    num_inliers > 0 && count as f64 >= options.max_homography_ratio * num_inliers as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_matches_and_none_determine_nothing() {
        let options = TwoViewOptions::default();
        let at = |i: usize| Point2::new((i * 97 % 800) as f64, (i * 61 % 600) as f64);
        let [p1, p2]: [Vec<_>; 2] = [0, 7].map(|by| (0..20).map(|i| at(i + by * i)).collect());
        assert_eq!(find_degeneracy(&[], &[], &[], &options), Ok(None));
        assert_eq!(find_degeneracy(&p1, &p2, &[false; 20], &options), Ok(None));
        let few = find_degeneracy(&p1[..3], &p2[..3], &[true; 3], &options);
        assert_eq!(few, Ok(None));
        let error = find_degeneracy(&p1, &p2[1..], &[true; 20], &options).unwrap_err();
        assert!(matches!(error, Error::SizeMismatch { .. }));
        let mut broken = p2.clone();
        broken[2].y = f64::NAN;
        let error = find_degeneracy(&p1, &broken, &[true; 20], &options).unwrap_err();
        assert!(matches!(error, Error::NotFinite { .. }));
    }

    /// Asserts that some moving inliers do not make a motion, but many do.
    #[test]
    fn nearly_all_is_a_fraction() {
        let options = TwoViewOptions::default();
        let p1: Vec<_> = (0..100)
            .map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480)))
            .collect();
        for (num_moved, expected) in [(10, true), (40, false)] {
            let mut p2 = p1.clone();
            for (index, p) in p2.iter_mut().enumerate().take(num_moved) {
                p.x += 10.0 + (index * 13 % 31) as f64;
            }
            let found = find_degeneracy(&p1, &p2, &[true; 100], &options).unwrap();
            let unmoved = matches!(
                found,
                Some(Degeneracy::Unmoved {
                    num_unmoved: 90,
                    ..
                })
            );
            assert_eq!(unmoved, expected, "{num_moved}: {found:?}");
        }
    }
}
