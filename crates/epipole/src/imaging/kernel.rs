//! Weights of a correlation along one axis, and destination rows for its results.

use std::ops::Range;

/// An odd number of weights along one axis, and their symmetry.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernel<'a> {
    pub(super) weights: &'a [f32],
    pub(super) symmetry: Symmetry,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Symmetry {
    Even,
    Odd,
    None,
}

impl<'a> Kernel<'a> {
    pub(crate) fn new(weights: &'a [f32]) -> Self {
        let n = weights.len();
        let mirrored = |sign: f32| (0..n / 2).all(|k| weights[k] == sign * weights[n - 1 - k]);
        let symmetry = if mirrored(1.0) {
            Symmetry::Even
        } else if weights[n / 2] == 0.0 && mirrored(-1.0) {
            Symmetry::Odd
        } else {
            Symmetry::None
        };
        Self { weights, symmetry }
    }

    pub(crate) fn len(&self) -> usize {
        self.weights.len()
    }

    pub(super) fn radius(&self) -> usize {
        self.weights.len() / 2
    }
}

/// Three symmetric weights.
#[derive(Clone, Copy)]
pub(crate) struct Three {
    middle: f32,
    side: f32,
}

impl Three {
    /// Returns `None` for other weights.
    pub(crate) fn new(weights: &[f32]) -> Option<Self> {
        match *weights {
            [before, middle, side] if before == side => Some(Self { middle, side }),
            _ => None,
        }
    }

    /// Returns the weighted sum of three values, in the order of longer kernels.
    #[inline(always)]
    pub(crate) fn sum(self, before: f32, middle: f32, after: f32) -> f32 {
        self.middle * middle + self.side * (before + after)
    }
}

/// Destination of a row of results.
pub(crate) enum Row<'a> {
    /// Overwrites existing values.
    Over(&'a mut [f32]),
    /// Appends to a list, so that new memory is written only once, not first filled with zeros.
    End(&'a mut Vec<f32>),
}

impl Row<'_> {
    /// Returns columns to be overwritten. Each must be requested once, in order.
    #[inline]
    pub(crate) fn columns(&mut self, columns: Range<usize>) -> &mut [f32] {
        match self {
            Self::Over(row) => &mut row[columns],
            Self::End(list) => {
                let end = list.len();
                list.resize(end + columns.len(), 0.0);
                &mut list[end..]
            }
        }
    }
}
