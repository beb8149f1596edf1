//! Integer kernels with a divisor.

use epipole::imaging::GrayImage32;
use image::Luma;

/// Nine integer weights in row order, and the divisor of the weighted sum.
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
    /// Returns the outer product `across · alongᵀ`; `along` runs along u, or along v if `turned`.
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

    /// Returns the centered difference, whose output is the slope.
    pub(super) fn difference(turned: bool) -> Self {
        Self::outer(SLOPE, ALONE, 2.0, turned)
    }

    /// Returns the Sobel filter, whose output is the slope if `divisor` is 8.
    pub(super) fn sobel(divisor: f32, turned: bool) -> Self {
        Self::outer(SLOPE, SMOOTH, divisor, turned)
    }

    /// Returns the smallest Gaussian with integer weights.
    pub(super) fn gaussian() -> Self {
        Self::outer(SMOOTH, SMOOTH, 16.0, false)
    }

    /// Returns the weights as an image, the format of the core's filters.
    pub(super) fn image(&self) -> GrayImage32 {
        GrayImage32::from_fn(3, 3, |u, v| Luma([self.weights[(3 * v + u) as usize]]))
    }

    /// Whether all weights are zero.
    pub(super) fn is_zero(&self) -> bool {
        self.weights.iter().all(|weight| *weight == 0.0)
    }

    /// Whether the weights sum to zero, so that the output is 0 in flat regions.
    pub(super) fn is_difference(&self) -> bool {
        self.weights.iter().sum::<f32>() == 0.0
    }

    /// Whether the kernel only copies a neighbor.
    pub(super) fn is_shift(&self) -> bool {
        let used = |index: &usize| self.weights[*index] != 0.0;
        let used: Vec<usize> = (0..9).filter(used).collect();
        matches!(used[..], [only] if only != 4 && self.weights[only] == self.divisor)
    }
}
