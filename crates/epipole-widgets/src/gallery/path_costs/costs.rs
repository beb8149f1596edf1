//! The costs of one pixel: matching cost, path costs and their sum.

use epipole::Result;
use epipole::stereo::{PATH_STEPS, PathCosts, PixelCosts, StereoSgm};
use image::GrayImage;

/// Number of disparities searched, from 0 up.
pub(super) const NUM_DISPARITIES: u32 = 48;
/// Error below which a disparity is correct, pixels, as it then belongs to the same surface.
pub(super) const RIGHT_PX: f64 = 1.5;

/// Smoothness penalties of the matching.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Penalties {
    /// P1, for a change of disparity by one pixel.
    pub(super) small: u8,
    /// P2, for any larger change; at least P1.
    pub(super) large: u8,
}

/// Indices into [`PATH_STEPS`] of the paths in each number of directions.
pub(super) const DIRECTIONS: [&[usize]; 5] = [
    &[0],
    &[0, 1],
    &[0, 1, 2, 3],
    // The directions available to a single pass down the image, and back along the row.
    &[0, 1, 2, 4, 6],
    &[0, 1, 2, 3, 4, 5, 6, 7],
];

/// Costs of the pixel under the probe, for the chosen directions.
#[derive(Debug, Clone)]
pub(super) struct Costs {
    pixel: PixelCosts,
    directions: &'static [usize],
    sums: Vec<u32>,
}

/// Returns the core's matcher with these penalties, the same everywhere in the image.
pub(super) fn matcher(penalties: Penalties) -> StereoSgm {
    StereoSgm::default()
        .with_num_disparities(NUM_DISPARITIES)
        .with_small_step_penalty(penalties.small)
        .with_large_step_penalty(penalties.large)
        .with_edge_gray(0)
}

impl Costs {
    pub(super) fn new(
        [left, right]: &[GrayImage; 2],
        (u, v): (u32, u32),
        penalties: Penalties,
        directions: &'static [usize],
    ) -> Result<Self> {
        let pixel = matcher(penalties).pixel_costs(left, right, u, v)?;
        let sum = |d: usize| {
            let costs = directions.iter().map(|&k| pixel.paths[k].costs[d]);
            costs.map(u32::from).sum()
        };
        Ok(Self {
            sums: (0..pixel.matching.len()).map(sum).collect(),
            directions,
            pixel,
        })
    }

    /// Returns the matching cost of each disparity.
    pub(super) fn raw(&self) -> Vec<f64> {
        self.pixel.matching.iter().map(|&c| c.into()).collect()
    }

    /// Returns the mean of the path costs, which has the same minimum as their sum.
    pub(super) fn means(&self) -> Vec<f64> {
        let count = self.directions.len() as f64;
        self.sums.iter().map(|&s| f64::from(s) / count).collect()
    }

    /// Returns the chosen directions, as indices into [`PATH_STEPS`], with their paths.
    pub(super) fn paths(&self) -> impl Iterator<Item = (usize, &PathCosts)> {
        let paths = &self.pixel.paths;
        self.directions.iter().map(|&k| (k, &paths[k]))
    }

    /// Returns the disparity of the lowest matching cost, pixels.
    pub(super) fn raw_winner_px(&self) -> usize {
        lowest(&self.pixel.matching)
    }

    /// Returns the disparity of the lowest sum, pixels.
    pub(super) fn winner_px(&self) -> usize {
        lowest(&self.sums)
    }

    /// Returns the number of local minima of the matching cost.
    pub(super) fn num_minima(&self) -> usize {
        let costs = &self.pixel.matching;
        let at = |d: usize| costs.get(d).copied().unwrap_or(u8::MAX);
        let is_minimum = |&d: &usize| at(d) < at(d.wrapping_sub(1)) && at(d) <= at(d + 1);
        (0..costs.len()).filter(is_minimum).count()
    }
}

/// Returns the disparity at which a path is lowest, pixels.
pub(super) fn path_winner_px(path: &PathCosts) -> usize {
    lowest(&path.costs)
}

/// Returns the pixels of a path to a pixel, the last one first.
pub(super) fn pixels(index: usize, (u, v): (u32, u32)) -> impl Iterator<Item = (f64, f64)> {
    let [du, dv] = PATH_STEPS[index].map(f64::from);
    (0..).map(move |k| {
        let steps = f64::from(k);
        (f64::from(u) - steps * du, f64::from(v) - steps * dv)
    })
}

/// Returns the index of the lowest value, the first of equal ones.
fn lowest<T: Ord>(values: &[T]) -> usize {
    (0..values.len()).min_by_key(|&d| &values[d]).unwrap_or(0)
}
