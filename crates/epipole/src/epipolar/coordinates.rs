//! Coordinates of many matches, in a layout for vector instructions.
//!
//! Loops process eight matches at a time, which compilers vectorize; sums are kept per lane, so the
//! order of additions is fixed.

use super::from_cameras::unit_norm;
use crate::Result;
use crate::robust::MatchSet;
use nalgebra::Matrix3;

pub(crate) const LANES: usize = 8;
pub(crate) type Lanes = [f64; LANES];

/// Four coordinates of many matches, in groups of eight; zeros beyond the last match.
#[derive(Debug, Clone)]
pub(crate) struct Coordinates {
    groups: Vec<[Lanes; 4]>,
    len: usize,
    /// Weight of each match; empty if all are equal.
    weights: Vec<f64>,
}

impl Coordinates {
    /// Collects some matches of four lists, in this order.
    fn select(
        indices: impl ExactSizeIterator<Item = usize>,
        at: impl Fn(usize) -> [f64; 4],
    ) -> Self {
        let len = indices.len();
        let mut groups = vec![[[0.0; LANES]; 4]; len.div_ceil(LANES)];
        for (place, index) in indices.enumerate() {
            let group = &mut groups[place / LANES];
            for (lane, x) in group.iter_mut().zip(at(index)) {
                lane[place % LANES] = x;
            }
        }
        Self {
            groups,
            len,
            weights: Vec::new(),
        }
    }

    pub(crate) fn pixels(matches: &MatchSet) -> Self {
        let lists = matches.coordinates();
        Self::select(0..matches.len(), |i| lists.map(|list| list[i]))
    }

    /// As [`pixels`](Self::pixels), but matches that share a pixel also share its weight.
    pub(crate) fn voting(matches: &MatchSet) -> Self {
        Self {
            weights: matches.votes().unwrap_or_default().to_vec(),
            ..Self::pixels(matches)
        }
    }

    /// Moves each image's origin and scales both images alike.
    pub(crate) fn mapped(&self, frame: &CommonFrame) -> Self {
        let [c1, c2] = frame.centers;
        let offsets = [c1[0], c1[1], c2[0], c2[1]];
        let moved = |i: usize| {
            let mut at = self.at(i);
            for (x, offset) in at.iter_mut().zip(offsets) {
                *x = (*x - offset) * frame.scale;
            }
            at
        };
        Self {
            weights: self.weights.clone(),
            ..Self::select(0..self.len, moved)
        }
    }

    /// Returns a subset of the matches, with its weights multiplied by `weights`.
    pub(crate) fn weighted(&self, indices: &[usize], weights: &[f64]) -> Self {
        Self {
            weights: match self.weights(0) {
                None => weights.to_vec(),
                Some(votes) => (indices.iter().zip(weights))
                    .map(|(&i, weight)| votes[i] * weight)
                    .collect(),
            },
            ..Self::select(indices.iter().copied(), |i| self.at(i))
        }
    }

    /// Sets the weights to those of `other`, which has the same matches, times `factors`.
    pub(crate) fn weigh_as(&mut self, other: &Self, factors: &[f64]) {
        self.weights.clear();
        match other.weights(0) {
            None => self.weights.extend_from_slice(factors),
            Some(votes) => {
                self.weights.extend(
                    votes
                        .iter()
                        .zip(factors)
                        .map(|(vote, factor)| vote * factor),
                );
            }
        }
    }

    /// Returns the weights of matches `start..`, if there are any.
    #[inline(always)]
    pub(crate) fn weights(&self, start: usize) -> Option<&[f64]> {
        self.weights.get(start..).filter(|w| !w.is_empty())
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    #[inline(always)]
    pub(crate) fn at(&self, index: usize) -> [f64; 4] {
        let group = &self.groups[index / LANES];
        [0, 1, 2, 3].map(|k: usize| group[k][index % LANES])
    }

    /// Returns matches `start..start + 8`, where `start` is a multiple of 8, and the number of
    /// actual matches; zeros beyond the end.
    #[inline(always)]
    pub(crate) fn lanes(&self, start: usize) -> (&[Lanes; 4], usize) {
        (&self.groups[start / LANES], (self.len - start).min(LANES))
    }
}

/// Common frame of both images: origins at the centroids and one scale, so that a distance d
/// becomes `scale · d` in either.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CommonFrame {
    pub(crate) centers: [[f64; 2]; 2],
    pub(crate) scale: f64,
}

impl CommonFrame {
    pub(crate) fn new(matches: &MatchSet) -> Self {
        let weight = 1.0 / matches.len().max(1) as f64;
        let means = matches
            .coordinates()
            .map(|list| list.iter().map(|x| x * weight).sum::<f64>());
        let mut spread = 0.0;
        for (list, mean) in matches.coordinates().iter().zip(means) {
            for x in *list {
                spread += (x - mean) * (x - mean) * weight;
            }
        }
        // Each of the four coordinates gets mean square 1.
        let scale = (4.0 / spread).sqrt();
        Self {
            centers: [[means[0], means[1]], [means[2], means[3]]],
            scale: if scale.is_finite() { scale } else { 1.0 },
        }
    }

    /// Returns T⁻¹ of an image: from the frame to pixels.
    pub(crate) fn frame_to_pixels(self, image: usize) -> Matrix3<f64> {
        let [cu, cv] = self.centers[image];
        let size = 1.0 / self.scale;
        Matrix3::new(size, 0.0, cu, 0.0, size, cv, 0.0, 0.0, 1.0)
    }

    /// Returns T of an image: from pixels to the frame.
    pub(crate) fn pixels_to_frame(self, image: usize) -> Matrix3<f64> {
        let [cu, cv] = self.centers[image];
        let s = self.scale;
        Matrix3::new(s, 0.0, -s * cu, 0.0, s, -s * cv, 0.0, 0.0, 1.0)
    }

    /// Converts F from pixels to the frame.
    pub(crate) fn fundamental_to_frame(self, f: &Matrix3<f64>) -> Matrix3<f64> {
        self.frame_to_pixels(1).transpose() * f * self.frame_to_pixels(0)
    }

    /// Converts F from the frame to pixels, with unit Frobenius norm.
    ///
    /// # Errors
    /// As [`unit_norm`].
    pub(crate) fn fundamental_to_pixels(self, f: &Matrix3<f64>) -> Result<Matrix3<f64>> {
        unit_norm(&(self.pixels_to_frame(1).transpose() * f * self.pixels_to_frame(0)))
    }

    /// Applies `work` to F in the frame, and converts the result back to pixels.
    pub(crate) fn fundamental_within(
        self,
        f: &Matrix3<f64>,
        work: impl FnOnce(&Matrix3<f64>) -> Option<Matrix3<f64>>,
    ) -> Option<Matrix3<f64>> {
        let found = work(&self.fundamental_to_frame(f))?;
        self.fundamental_to_pixels(&found).ok()
    }
}

/// Returns the entries of F, row by row.
#[inline(always)]
pub(crate) fn entries(f: &Matrix3<f64>) -> [f64; 9] {
    [
        f[(0, 0)],
        f[(0, 1)],
        f[(0, 2)],
        f[(1, 0)],
        f[(1, 1)],
        f[(1, 2)],
        f[(2, 0)],
        f[(2, 1)],
        f[(2, 2)],
    ]
}

#[inline(always)]
pub(crate) fn sum(lanes: &Lanes) -> f64 {
    ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3]))
        + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]))
}
