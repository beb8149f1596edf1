//! Costs of a single pixel in semi-global matching: the matching cost and all path costs.

use super::matching_cost::CostRows;
use super::paths::{Penalties, advance};
use super::search::Search;
use super::semi_global::{OUTSIDE_COST, StereoSgm};
use crate::{Error, Result};
use image::GrayImage;

/// Steps (du, dv) of the eight paths to a pixel, in pixels: along the row, the column, and both
/// diagonals, each in both directions.
pub const PATH_STEPS: [[i32; 2]; 8] = [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
    [1, 1],
    [-1, -1],
    [-1, 1],
    [1, -1],
];

/// Costs of one left pixel at each disparity, from the minimum upwards.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct PixelCosts {
    /// Matching cost C.
    pub matching: Vec<u8>,
    /// Path costs L for each of [`PATH_STEPS`].
    pub paths: [PathCosts; 8],
}

/// Costs of one path to a pixel.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct PathCosts {
    /// Path cost L of the pixel at each disparity, at most the matching cost plus P2.
    pub costs: Vec<u8>,
    /// Disparity with the lowest L at each pixel of the path, from the border to the pixel itself.
    pub winners_px: Vec<i32>,
}

impl StereoSgm {
    /// Returns the costs of one pixel of `left` for all eight paths, whatever the number of
    /// [`paths`](Self::paths): the terms that [`compute`](Self::compute) adds there.
    ///
    /// * `left`, `right`: as for [`compute`](Self::compute)
    /// * `u`, `v`: column and row of the pixel
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a pixel outside the image; otherwise as
    /// [`compute`](Self::compute).
    ///
    /// Source: Hirschmüller 2008, equation 13.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::stereo::StereoSgm;
    /// use image::{GrayImage, Luma};
    /// let gray = |u: u32, v: u32| Luma([((u * u * 7 + v * v * 5 + u * v * 3) % 251) as u8]);
    /// let left = GrayImage::from_fn(40, 24, gray);
    /// let right = GrayImage::from_fn(40, 24, |u, v| gray(u + 3, v));
    /// let costs = StereoSgm::default().with_num_disparities(8).pixel_costs(&left, &right, 20, 12)?;
    /// // The match, 3 pixels to the left, is exact. The path from the left has 21 pixels.
    /// assert_eq!((costs.matching[3], costs.paths[0].costs[3]), (0, 0));
    /// assert_eq!(costs.paths[0].winners_px.len(), 21);
    /// # Ok(()) }
    /// ```
    pub fn pixel_costs(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        u: u32,
        v: u32,
    ) -> Result<PixelCosts> {
        let search = Search::new(left, right, self.min_disparity_px, self.num_disparities)?;
        self.check()?;
        for (what, at, size) in [
            ("the column of the pixel", u, left.width()),
            ("the row of the pixel", v, left.height()),
        ] {
            if at >= size {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "inside the picture",
                    value: at.into(),
                });
            }
        }
        let (u, v) = (u as usize, v as usize);
        let penalties = self.penalties();
        let mut cost_rows = CostRows::new(search, self.cost, self.gray_cap, OUTSIDE_COST);
        let mut row_costs = vec![0; search.width * search.num_cells];
        let mut paths: [Path; 8] = std::array::from_fn(|_| Path::new(&search));
        // Rows above, then rows below, each towards the pixel, then its own row.
        for row in (0..v).chain((v + 1..search.height).rev()).chain([v]) {
            cost_rows.row(row, &mut row_costs);
            let gray = search.row_of(search.left.as_raw(), row);
            let visit = |path: &mut Path, column: usize| {
                let costs = &row_costs[column * search.num_cells..][..search.num_disparities];
                path.advance(costs, gray[column], &penalties);
            };
            for (path, [du, dv]) in paths.iter_mut().zip(PATH_STEPS) {
                if dv == 0 && row == v {
                    let before = if du > 0 { 0..u } else { u + 1..search.width };
                    match du > 0 {
                        true => before.for_each(|column| visit(path, column)),
                        false => before.rev().for_each(|column| visit(path, column)),
                    }
                    visit(path, u);
                } else if dv != 0 && (v as i64 - row as i64) * i64::from(dv) >= 0 {
                    let steps = v.abs_diff(row) as i64;
                    let column = u as i64 - steps * i64::from(du);
                    if (0..search.width as i64).contains(&column) {
                        visit(path, column as usize);
                    }
                }
            }
        }
        let matching = row_costs[u * search.num_cells..][..search.num_disparities].to_vec();
        let paths = paths.map(Path::into_costs);
        Ok(PixelCosts { matching, paths })
    }
}

/// State of a path towards the pixel.
struct Path {
    /// Path costs of the last pixel, between two unreachable cells.
    cells: Vec<u8>,
    minimum: u8,
    gray_before: Option<u8>,
    min_disparity: i32,
    winners_px: Vec<i32>,
}

impl Path {
    /// Creates a path before its first pixel: L = 0, so that this pixel costs C alone.
    fn new(search: &Search) -> Self {
        let mut cells = vec![0; search.num_disparities + 2];
        cells[0] = u8::MAX;
        cells[search.num_disparities + 1] = u8::MAX;
        Self {
            cells,
            minimum: 0,
            gray_before: None,
            min_disparity: search.min_disparity,
            winners_px: Vec::new(),
        }
    }

    /// Continues to the next pixel, with its matching costs and gray value.
    fn advance(&mut self, costs: &[u8], gray: u8, penalties: &Penalties) {
        let step = self.gray_before.map_or(0, |before| gray.abs_diff(before));
        let (p1, p2) = (penalties.p1, penalties.p2_of_gray_step[usize::from(step)]);
        let before = self.cells.clone();
        let next = &mut self.cells[1..=costs.len()];
        self.minimum = advance::<1>(costs, &before, self.minimum, p1, p2, next);
        let winner = next.iter().position(|&cost| cost == self.minimum);
        self.winners_px
            .push(self.min_disparity + winner.unwrap_or(0) as i32);
        self.gray_before = Some(gray);
    }

    fn into_costs(self) -> PathCosts {
        PathCosts {
            costs: self.cells[1..self.cells.len() - 1].to_vec(),
            winners_px: self.winners_px,
        }
    }
}
