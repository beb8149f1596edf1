//! Matches between two images, in a layout for fast scoring.

use super::{Unique, probability_near_line, probability_near_point};
use crate::{Error, Result};
use nalgebra::Point2;

/// Unique, finite matches: pixel `(u1[i], v1[i])` of image 1 and `(u2[i], v2[i])` of image 2.
///
/// One array per coordinate lets the scoring loops process several matches at once.
#[derive(Debug, Clone, PartialEq)]
pub struct MatchSet {
    u1: Vec<f64>,
    v1: Vec<f64>,
    u2: Vec<f64>,
    v2: Vec<f64>,
    unique: Unique,
    crowds: Option<Crowds>,
}

/// Total weight of all matches that share a pixel. Two rather than one: pairs are common and
/// harmless, and half the weight would hurt the correct one of them.
const VOTES_OF_PIXEL: f64 = 2.0;

/// Matches that share a pixel of an image.
#[derive(Debug, Clone, PartialEq)]
struct Crowds {
    /// For each match, the number of its pixel in images 1 and 2.
    pixels: [Vec<usize>; 2],
    /// For each match, its part of the pixel's weight, at most 1.
    votes: Vec<f64>,
}

/// Maximum absolute coordinate for robust estimation, pixels: the fourth power of larger ones
/// exceeds the arithmetic of the solvers.
///
/// ```
/// assert_eq!(epipole::robust::FARTHEST_PX, 1e9);
/// ```
pub const FARTHEST_PX: f64 = 1e9;

impl MatchSet {
    /// Copies the matches without repetitions.
    ///
    /// * `pixels1`, `pixels2`: matching pixels of the two images, in the same order
    ///
    /// A match with a coordinate that is infinite or beyond 10⁹ pixels, whose fourth power exceeds
    /// the arithmetic of the solvers, is an outlier and left out; see
    /// [`RansacReport::num_left_out`](super::RansacReport::num_left_out).
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] if the lists differ in length, [`Error::NotFinite`] for NaN.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::robust::MatchSet;
    /// use nalgebra::Point2;
    /// let p = [Point2::new(1.0, 2.0), Point2::new(3.0, 4.0), Point2::new(1.0, 2.0), Point2::new(1e12, 0.0)];
    /// let set = MatchSet::new(&p, &p)?;
    /// assert_eq!((set.len(), set.unique().num_left_out()), (2, 1));
    /// # Ok(()) }
    /// ```
    pub fn new(pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Result<Self> {
        Self::of_usable(pixels1, pixels2, |_| true)
    }

    /// As [`new`](Self::new), but keeps only usable matches.
    pub(crate) fn of_usable(
        pixels1: &[Point2<f64>],
        pixels2: &[Point2<f64>],
        is_usable: impl Fn(usize) -> bool,
    ) -> Result<Self> {
        if pixels1.len() != pixels2.len() {
            return Err(Error::SizeMismatch {
                what: "the two lists of matching pixels",
                first: pixels1.len(),
                second: pixels2.len(),
            });
        }
        if (pixels1.iter().chain(pixels2)).any(|p| p.x.is_nan() || p.y.is_nan()) {
            return Err(Error::NotFinite {
                what: "a matched pixel",
            });
        }
        let unique = Unique::of_usable(pixels1.len(), |i| {
            let values = [pixels1[i].x, pixels1[i].y, pixels2[i].x, pixels2[i].y];
            let is_near = values.iter().all(|x| x.abs() <= FARTHEST_PX);
            (is_near && is_usable(i)).then_some(values)
        });
        let collect = |coordinate: &dyn Fn(usize) -> f64| {
            unique
                .first_occurrences()
                .iter()
                .map(|&i| coordinate(i))
                .collect()
        };
        let (u1, v1) = (collect(&|i| pixels1[i].x), collect(&|i| pixels1[i].y));
        let (u2, v2) = (collect(&|i| pixels2[i].x), collect(&|i| pixels2[i].y));
        Ok(Self {
            crowds: Crowds::new([[&u1, &v1], [&u2, &v2]]),
            u1,
            v1,
            u2,
            v2,
            unique,
        })
    }

    /// As [`new`](Self::new), for callers that need every match.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`Error::NotFinite`] for infinities and [`Error::OutOfRange`] for
    /// coordinates beyond 10⁹ pixels.
    pub(crate) fn of_all(pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Result<Self> {
        for value in pixels1.iter().chain(pixels2).flat_map(|p| [p.x, p.y]) {
            if value.is_infinite() {
                return Err(Error::NotFinite {
                    what: "a matched pixel",
                });
            }
            if value.abs() > FARTHEST_PX {
                return Err(Error::OutOfRange {
                    what: "a matched pixel's coordinate",
                    requirement: "at most 10⁹ pixels from 0",
                    value,
                });
            }
        }
        Self::new(pixels1, pixels2)
    }

    /// Returns the number of unique matches.
    pub fn len(&self) -> usize {
        self.u1.len()
    }

    /// Returns whether there is no match.
    pub fn is_empty(&self) -> bool {
        self.u1.is_empty()
    }

    /// Returns the pixels of a match in images 1 and 2.
    pub fn pair(&self, index: usize) -> (Point2<f64>, Point2<f64>) {
        (
            Point2::new(self.u1[index], self.v1[index]),
            Point2::new(self.u2[index], self.v2[index]),
        )
    }

    /// Returns the coordinates `[u1, v1, u2, v2]`, one slice each.
    pub fn coordinates(&self) -> [&[f64]; 4] {
        [&self.u1, &self.v1, &self.u2, &self.v2]
    }

    /// Checks that there are enough matches to estimate `what`.
    ///
    /// # Errors
    /// As [`Unique::at_least`].
    pub(crate) fn at_least(&self, needed: usize, what: &'static str) -> Result<()> {
        self.unique.at_least(needed, what)
    }

    /// Returns the probability that a random pixel of image 2 is within `radius_px` of a given one.
    pub(crate) fn probability_near_point2(&self, radius_px: f64) -> f64 {
        probability_near_point([self.u2.clone(), self.v2.clone()], radius_px)
    }

    /// Returns the probability that random pixels of both images have a smaller Sampson error than
    /// this.
    ///
    /// If lines move equally in both images, the error is the distance from a line divided by √2.
    pub(crate) fn probability_near_lines(&self, max_error_px: f64) -> f64 {
        let distance_px = core::f64::consts::SQRT_2 * max_error_px;
        [[&self.u1, &self.v1], [&self.u2, &self.v2]]
            .map(|[u, v]| probability_near_line([u.clone(), v.clone()], distance_px))
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// Returns the weight of each match for scoring; `None` if all are equal.
    ///
    /// At most one of the matches that share a pixel can be correct, so their total weight is
    /// limited. Otherwise a pixel shared by half of all matches would outvote everything: each F
    /// with its epipole there fits them all.
    pub(crate) fn votes(&self) -> Option<&[f64]> {
        self.crowds.as_ref().map(|crowds| &*crowds.votes)
    }

    /// Returns whether two of these matches share a pixel, so that at most one can be correct.
    pub(crate) fn have_shared_pixel(&self, indices: &[usize]) -> bool {
        let Some(Crowds { pixels, .. }) = &self.crowds else {
            return false;
        };
        pixels.iter().any(|pixel| {
            let twice = |(place, &i): (usize, &usize)| {
                indices[..place].iter().any(|&j| pixel[i] == pixel[j])
            };
            indices.iter().enumerate().any(twice)
        })
    }

    /// Returns an upper bound on the number of correct matches: the number of their unique pixels,
    /// in the image with fewer.
    ///
    /// Source: Schönberger & Frahm 2016, COLMAP's support by unique inliers.
    pub(crate) fn num_distinct(&self, indices: &[usize]) -> usize {
        let Some(Crowds { pixels, .. }) = &self.crowds else {
            return indices.len();
        };
        let count = |pixel: &Vec<usize>| {
            let mut is_used = vec![false; pixel.len()];
            indices.iter().for_each(|&i| is_used[pixel[i]] = true);
            is_used.into_iter().filter(|&is_used| is_used).count()
        };
        pixels.iter().map(count).min().unwrap_or(0)
    }

    /// Returns the map between these matches and the given ones.
    pub fn unique(&self) -> &Unique {
        &self.unique
    }
}

impl Crowds {
    fn new(images: [[&Vec<f64>; 2]; 2]) -> Option<Self> {
        let different = images.map(|[u, v]| Unique::new(u.len(), |i| [u[i], v[i]]));
        let num_matches = images[0][0].len();
        if different.iter().all(|pixels| pixels.len() == num_matches) {
            return None;
        }
        let pixels: [Vec<usize>; 2] =
            different.map(|pixels| pixels.places().iter().flatten().copied().collect());
        let sizes = [0, 1].map(|image: usize| {
            let mut sizes = vec![0_usize; num_matches];
            pixels[image].iter().for_each(|&pixel| sizes[pixel] += 1);
            sizes
        });
        let size = |i: usize| sizes[0][pixels[0][i]].max(sizes[1][pixels[1][i]]) as f64;
        let vote = |i: usize| (VOTES_OF_PIXEL / size(i)).min(1.0);
        Some(Self {
            votes: (0..num_matches).map(vote).collect(),
            pixels,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_matches_are_refused() {
        let p = vec![Point2::new(1.0, 2.0); 3];
        assert!(matches!(
            MatchSet::new(&p, &p[..2]),
            Err(Error::SizeMismatch { .. })
        ));
        let mut q = p.clone();
        q[1].y = f64::NAN;
        assert!(MatchSet::new(&p, &q).is_err());
        assert!(MatchSet::new(&q, &p).is_err());
        for far in [f64::INFINITY, 1e200, -1.1e9] {
            q[1].y = far;
            for set in [MatchSet::new(&p, &q), MatchSet::new(&q, &p)] {
                let set = set.unwrap();
                assert_eq!(set.unique().places(), [Some(0), None, Some(0)]);
            }
            assert!(MatchSet::of_all(&p, &q).is_err());
            assert!(MatchSet::of_all(&q, &p).is_err());
        }
        assert!(MatchSet::new(&[], &[]).unwrap().is_empty());
    }

    #[test]
    fn matches_of_one_pixel_share_its_votes() {
        let point = |u: f64| Point2::new(u, 0.0);
        let p = [0.0, 1.0, 2.0, 3.0, 3.0].map(point);
        let q = [7.0, 7.0, 7.0, 8.0, 9.0].map(point);
        let set = MatchSet::new(&p, &q).unwrap();
        let part = 2.0 / 3.0;
        assert_eq!(set.votes(), Some(&[part, part, part, 1.0, 1.0][..]));
        assert!(set.have_shared_pixel(&[0, 3, 1]) && set.have_shared_pixel(&[4, 3]));
        assert!(!set.have_shared_pixel(&[2, 4]));
        assert_eq!(set.num_distinct(&[0, 1, 2, 3, 4]), 3);
        assert_eq!(set.num_distinct(&[3, 4]), 1);
        let set = MatchSet::new(&p[..4], &p[..4]).unwrap();
        assert_eq!(set.votes(), None);
        assert_eq!(set.num_distinct(&[1, 2]), 2);
    }

    #[test]
    fn different_in_one_image_is_different() {
        let p = vec![Point2::new(1.0, 2.0); 3];
        let q = [(0.0, 0.0), (5.0, 0.0), (0.0, 0.0)].map(|(u, v)| Point2::new(u, v));
        let set = MatchSet::new(&p, &q).unwrap();
        assert_eq!(set.len(), 2);
        assert_eq!(set.pair(1), (p[0], q[1]));
        assert_eq!(set.unique().places(), [0, 1, 0].map(Some));
    }
}
