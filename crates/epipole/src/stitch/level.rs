//! Sums of weighted colors at one level of a pyramid.

use crate::imaging::GrayImage32;

/// Sums over photos.
pub(super) struct Level {
    width: usize,
    colors: [Vec<f32>; 3],
    weights: Vec<f32>,
}

impl Level {
    pub(super) fn new(width: usize, height: usize) -> Self {
        let zeros = || vec![0.0; width * height];
        Self {
            width,
            colors: [zeros(), zeros(), zeros()],
            weights: zeros(),
        }
    }

    /// Adds weighted colors whose first pixel is at (u, v).
    pub(super) fn add(
        &mut self,
        [u, v]: [usize; 2],
        colors: [&GrayImage32; 3],
        weights: &GrayImage32,
    ) {
        let width = weights.width() as usize;
        for (row, weights) in weights.as_raw().chunks_exact(width.max(1)).enumerate() {
            let place = (v + row) * self.width + u;
            for (sums, colors) in self.colors.iter_mut().zip(colors) {
                let colors = &colors.as_raw()[row * width..];
                for (n, weight) in weights.iter().enumerate() {
                    sums[place + n] += weight * colors[n];
                }
            }
            for (n, weight) in weights.iter().enumerate() {
                self.weights[place + n] += weight;
            }
        }
    }

    /// Returns the mean colors, 0 where there is no weight.
    pub(super) fn means(self) -> [Vec<f32>; 3] {
        let Self {
            colors, weights, ..
        } = self;
        colors.map(|sums| {
            let pairs = sums.into_iter().zip(&weights);
            pairs
                .map(|(sum, weight)| if *weight > 1e-6 { sum / weight } else { 0.0 })
                .collect()
        })
    }
}
