//! Matches from the caller, without repetitions.

use super::TwoViewOptions;
use crate::robust::MatchSet;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// Matches from the caller.
pub(super) struct Pairs<'a> {
    pub(super) pixels1: &'a [Point2<f64>],
    pub(super) pixels2: &'a [Point2<f64>],
    /// Whether each match is usable and no earlier one is equal.
    is_first: Vec<bool>,
    /// Whether each match, or an equal one, is among the unique matches.
    is_used: Vec<bool>,
}

impl<'a> Pairs<'a> {
    pub(super) fn new(
        pixels1: &'a [Point2<f64>],
        pixels2: &'a [Point2<f64>],
        set: &MatchSet,
    ) -> Self {
        let mut is_first = vec![false; pixels1.len()];
        for &place in set.unique().first_occurrences() {
            is_first[place] = true;
        }
        Self {
            pixels1,
            pixels2,
            is_first,
            is_used: (set.unique().places().iter())
                .map(Option::is_some)
                .collect(),
        }
    }

    /// Returns whether each match fits a homography.
    pub(super) fn fit(&self, homography: &Matrix3<f64>, options: &TwoViewOptions) -> Vec<bool> {
        let pairs = self.pixels1.iter().zip(self.pixels2);
        let fits = |((p1, p2), used): ((&Point2<f64>, &Point2<f64>), &bool)| {
            *used && options.fits_homography(homography, p1, p2)
        };
        pairs.zip(&self.is_used).map(fits).collect()
    }

    /// Returns the unique matches.
    pub(super) fn different(
        &self,
    ) -> impl Iterator<Item = (&'a Point2<f64>, &'a Point2<f64>)> + use<'a, '_> {
        self.among(&self.is_first)
    }

    /// Returns the matches of a mask.
    pub(super) fn among<'b>(
        &self,
        mask: &'b [bool],
    ) -> impl Iterator<Item = (&'a Point2<f64>, &'a Point2<f64>)> + Clone + use<'a, 'b> {
        let pairs = self.pixels1.iter().zip(self.pixels2);
        pairs
            .zip(mask)
            .filter(|(_, is_inlier)| **is_inlier)
            .map(|(pair, _)| pair)
    }

    /// Returns the unique matches of a mask.
    pub(super) fn different_among<'b>(
        &'b self,
        mask: &'b [bool],
    ) -> impl Iterator<Item = (&'a Point2<f64>, &'a Point2<f64>)> + use<'a, 'b> {
        let pairs = self.pixels1.iter().zip(self.pixels2);
        pairs
            .zip(mask.iter().zip(&self.is_first))
            .filter(|(_, (is_inlier, first))| **is_inlier && **first)
            .map(|(pair, _)| pair)
    }

    /// Returns the fraction of some inliers that fit a homography.
    pub(super) fn explained_ratio(
        &self,
        homography: &Matrix3<f64>,
        inliers: &[bool],
        options: &TwoViewOptions,
    ) -> f64 {
        let (mut fit, mut count) = (0.0, 0.0_f64);
        for (p1, p2) in self.different_among(inliers) {
            count += 1.0;
            if options.fits_homography(homography, p1, p2) {
                fit += 1.0;
            }
        }
        fit / count.max(1.0)
    }
}

/// Returns both pixels of the matches of a mask.
///
/// # Errors
/// [`Error::SizeMismatch`] if the lists differ in length.
pub(super) fn inliers_of(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
) -> Result<[Vec<Point2<f64>>; 2]> {
    for (first, second) in [
        (pixels1.len(), pixels2.len()),
        (pixels1.len(), inliers.len()),
    ] {
        if first != second {
            return Err(Error::SizeMismatch {
                what: "the lists of matching pixels and of inliers",
                first,
                second,
            });
        }
    }
    Ok([pixels1, pixels2].map(|pixels| {
        let inlier_pairs = pixels.iter().zip(inliers).filter(|(_, is)| **is);
        inlier_pairs.map(|(pixel, _)| *pixel).collect()
    }))
}
