//! Kernels of whole numbers, and what their sum is divided by.

use epipole::imaging::GrayImage32;
use image::Luma;

/// Nine weights in rows, and the divisor of the sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kernel {
    pub(super) weights: [f32; 9],
    pub(super) divisor: f32,
}

/// The one-dimensional factors.
const SMOOTH: [f32; 3] = [1.0, 2.0, 1.0];
const SLOPE: [f32; 3] = [-1.0, 0.0, 1.0];
const ALONE: [f32; 3] = [0.0, 1.0, 0.0];

impl Kernel {
    /// `across · alongᵀ`, where `along` runs along u; or along v if `turned`.
    fn outer(along: [f32; 3], across: [f32; 3], divisor: f32, turned: bool) -> Self {
        let weights = std::array::from_fn(|index| {
            let (column, row) = (index % 3, index / 3);
            match turned {
                false => along[column] * across[row],
                true => along[row] * across[column],
            }
        });
        Self { weights, divisor }
    }

    /// The centered difference: the slope.
    pub(super) fn difference(turned: bool) -> Self {
        Self::outer(SLOPE, ALONE, 2.0, turned)
    }

    /// Sobel's filter; divided by 8 it gives the slope.
    pub(super) fn sobel(divisor: f32, turned: bool) -> Self {
        Self::outer(SLOPE, SMOOTH, divisor, turned)
    }

    /// The smallest Gaussian in whole numbers.
    pub(super) fn gaussian() -> Self {
        Self::outer(SMOOTH, SMOOTH, 16.0, false)
    }

    /// The weights as the core takes them.
    pub(super) fn image(&self) -> GrayImage32 {
        GrayImage32::from_fn(3, 3, |u, v| Luma([self.weights[(3 * v + u) as usize]]))
    }

    /// Whether there is nothing in it.
    pub(super) fn is_zero(&self) -> bool {
        self.weights.iter().all(|weight| *weight == 0.0)
    }

    /// Whether it answers 0 wherever the image is flat, as all that measure differences do.
    pub(super) fn is_difference(&self) -> bool {
        self.weights.iter().sum::<f32>() == 0.0
    }

    /// Whether all that it does is to fetch a neighbor.
    pub(super) fn is_shift(&self) -> bool {
        let used = |index: &usize| self.weights[*index] != 0.0;
        let used: Vec<usize> = (0..9).filter(used).collect();
        matches!(used[..], [only] if only != 4 && self.weights[only] == self.divisor)
    }
}
