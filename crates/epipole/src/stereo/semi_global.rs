//! Semi-global matching.

use super::DisparityImage;
use super::filter::{DisparityFilter, SEARCH_FRACTION};
use super::matching_cost::{CostRows, StereoCost};
use super::paths::{Penalties, Sweep};
use super::search::{Search, to_eight_bits};
use super::winner::Selector;
use super::work::{in_two, single};
use crate::math::monitored::Reporter;
use crate::progress::{Monitor, Part};
use crate::{Error, Result};
use derive_setters::Setters;
use image::{GrayImage, ImageBuffer, Luma};
use std::ops::Range;

/// Directions of the paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum StereoPaths {
    /// Along the row and the column, in both directions.
    Four,
    /// Along the row in both directions and from the three pixels above: takes the memory of only a
    /// few rows, but runs on one thread.
    Five,
    /// Along rows, columns and diagonals, in both directions.
    #[default]
    Eight,
}

/// Dense disparity of a rectified pair by semi-global matching.
///
/// The result minimizes, along straight paths from 4, 5 or 8 directions,
/// `Σ_p C(p, d_p) + P1 [|d_p − d_q| = 1] + P2 [|d_p − d_q| > 1]` over neighbors p, q, where C is
/// the [`StereoCost`] between the left pixel and the right pixel `u − d`.
///
/// A pixel has no disparity (NaN) if its best match lies outside the right image, another disparity
/// fits nearly as well, the right image disagrees, or the disparity is that of a small speckle.
/// Images without texture get one smooth surface or no disparities, not an error.
///
/// Source: Hirschmüller 2008, "Stereo processing by semiglobal matching and mutual information".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityFilter, StereoSgm};
/// use image::{GrayImage, Luma};
/// // A pattern, and the same moved 3 pixels to the left.
/// let gray = |u: u32, v: u32| Luma([((u * u * 7 + v * v * 5 + u * v * 3) % 251) as u8]);
/// let left = GrayImage::from_fn(40, 24, gray);
/// let right = GrayImage::from_fn(40, 24, |u, v| gray(u + 3, v));
/// let filter = DisparityFilter::default().with_speckle_size(0);
/// let matcher = StereoSgm::default().with_num_disparities(8).with_filter(filter);
/// let disparity = matcher.compute(&left, &right, &mut ())?;
/// assert!((disparity.get(20, 12).unwrap() - 3.0).abs() < 0.5);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct StereoSgm {
    /// Minimum disparity, pixels; negative for cameras that converge.
    pub min_disparity_px: i32,
    /// Number of disparities from the minimum upwards; 1 to 4096.
    pub num_disparities: u32,
    /// Matching cost.
    pub cost: StereoCost,
    /// Maximum cost of a difference of gray values, 1 to 63.
    pub gray_cap: u8,
    /// Directions.
    pub paths: StereoPaths,
    /// P1: penalty for a change of disparity by one between neighbors.
    pub small_step_penalty: u8,
    /// P2: penalty for a larger change; at least P1, at most 150.
    pub large_step_penalty: u8,
    /// Difference of gray values between two neighbors that halves P2 (never below P1), since edges
    /// of objects are mostly edges of the image. 0: P2 is constant.
    pub edge_gray: u8,
    /// Filter of the disparities.
    pub filter: DisparityFilter,
}

impl Default for StereoSgm {
    /// Returns disparities 0 to 63 and eight paths.
    fn default() -> Self {
        Self {
            min_disparity_px: 0,
            num_disparities: 64,
            cost: StereoCost::default(),
            gray_cap: 30,
            paths: StereoPaths::default(),
            small_step_penalty: 20,
            large_step_penalty: 100,
            edge_gray: 10,
            filter: DisparityFilter::default(),
        }
    }
}

/// Minimum P2 at any gray difference; otherwise textures would tear surfaces apart.
const MIN_LARGE_STEP_PENALTY: u8 = 20;
/// Cost of a candidate outside the right image: more than a good match, less than a bad one, so
/// that disparities continue beyond the border.
pub(super) const OUTSIDE_COST: u8 = 12;

impl StereoSgm {
    /// Computes the disparities of `left`.
    ///
    /// * `left`, `right`: a rectified pair, so that matches share a row; equal sizes
    /// * `monitor`: the only stage is
    ///   [`Stage::DenseMatching`](crate::progress::Stage::DenseMatching)
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for images of different size, [`Error::TooFew`] for empty images,
    /// [`Error::OutOfRange`] for an option outside its range or a volume (pixels × disparities) too
    /// large for memory, [`Error::Canceled`].
    pub fn compute(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let search = Search::new(left, right, self.min_disparity_px, self.num_disparities)?;
        self.check()?;
        let task = Task {
            search,
            options: self,
            penalties: self.penalties(),
        };
        let part = &mut Part::new(monitor, 0.0, SEARCH_FRACTION);
        let values = match self.paths {
            StereoPaths::Five => single(part, |reporter| task.five_paths(reporter))?,
            StereoPaths::Four => task.both_ways::<2>(part)?,
            StereoPaths::Eight => task.both_ways::<4>(part)?,
        };
        let clean = &mut Part::new(monitor, SEARCH_FRACTION, 1.0);
        self.filter.clean(search.image(values), clean)
    }

    /// As [`StereoSgm::compute`], for gray values of any range: the smallest and the largest value
    /// of both images become 0 and 255.
    ///
    /// # Errors
    /// As [`StereoSgm::compute`], and [`Error::NotFinite`] for NaN or infinities.
    pub fn compute_f32(
        &self,
        left: &ImageBuffer<Luma<f32>, Vec<f32>>,
        right: &ImageBuffer<Luma<f32>, Vec<f32>>,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let (left, right) = to_eight_bits(left, right)?;
        self.compute(&left, &right, monitor)
    }

    pub(super) fn check(&self) -> Result<()> {
        let (p1, p2) = (self.small_step_penalty, self.large_step_penalty);
        Error::check_rules(&[
            (
                "the largest cost of a difference of gray values",
                "from 1 to 63",
                f64::from(self.gray_cap),
                (1..=63).contains(&self.gray_cap),
            ),
            (
                "the penalty for a large step",
                "at least that for a small step, and at most 150",
                f64::from(p2),
                p1 <= p2 && p2 <= 150,
            ),
        ])?;
        self.filter.check()
    }

    pub(super) fn penalties(&self) -> Penalties {
        let (p1, p2) = (self.small_step_penalty, self.large_step_penalty);
        let lowest = p1.max(MIN_LARGE_STEP_PENALTY).min(p2);
        Penalties {
            p1,
            p2_of_gray_step: std::array::from_fn(|step| {
                if self.edge_gray == 0 {
                    return p2;
                }
                let edge = usize::from(self.edge_gray);
                ((usize::from(p2) * edge / (edge + step)) as u8).max(lowest)
            }),
        }
    }
}

/// A validated search with its options.
struct Task<'a> {
    search: Search<'a>,
    options: &'a StereoSgm,
    penalties: Penalties,
}

impl Task<'_> {
    fn cost_rows(&self) -> CostRows<'_> {
        let options = self.options;
        CostRows::new(self.search, options.cost, options.gray_cap, OUTSIDE_COST)
    }

    fn row_cells(&self) -> usize {
        self.search.width * self.search.num_cells
    }

    /// Runs down the image and along the row in both directions, with the memory of a few rows.
    fn five_paths(&self, reporter: &mut Reporter) -> Result<Vec<f32>> {
        let search = self.search;
        let mut cost_rows = self.cost_rows();
        let mut costs = vec![0; self.row_cells()];
        let mut sums = vec![0; self.row_cells()];
        let mut down = Sweep::<4>::new(search.width, search.num_cells, false);
        let mut back = Sweep::<1>::new(search.width, search.num_cells, true);
        let mut selector = Selector::new(search, self.options.filter);
        let mut values = vec![0.0; search.width * search.height];
        for (v, out) in values.chunks_exact_mut(search.width).enumerate() {
            reporter.report(v, search.height)?;
            cost_rows.row(v, &mut costs);
            let gray = search.row_of(search.left.as_raw(), v);
            down.next_row(&costs, gray, &self.penalties);
            back.next_row(&costs, gray, &self.penalties);
            sums.fill(0);
            down.add_to(&mut sums);
            back.add_to(&mut sums);
            selector.row(&mut sums, out);
        }
        Ok(values)
    }

    /// Runs N paths down and N paths up the image.
    ///
    /// Both sweeps first go to the middle and store their sums. Then each continues through the
    /// other's half, where the sums are now complete. So one volume serves two threads, and the
    /// result is the same with one thread.
    fn both_ways<const N: usize>(&self, monitor: &mut dyn Monitor) -> Result<Vec<f32>> {
        let search = self.search;
        let num_cells = search.check_volume()?;
        let mut volume = Volume {
            costs: vec![0; num_cells],
            means: vec![0; num_cells],
        };
        let mut values = vec![0.0; search.width * search.height];
        let middle = search.height / 2;
        let (upper, lower) = (0..middle, middle..search.height);
        let mut down = HalfSweep::<N>::new(self, false);
        let mut up = HalfSweep::<N>::new(self, true);

        let (top, bottom) = volume.split(middle * self.row_cells());
        in_two(
            monitor,
            0.0..0.5,
            |reporter| down.store(upper.clone(), top, reporter),
            |reporter| up.store(lower.clone(), bottom, reporter),
        )?;
        let (top, bottom) = volume.split(middle * self.row_cells());
        let (top_values, bottom_values) = values.split_at_mut(middle * search.width);
        in_two(
            monitor,
            0.5..1.0,
            |reporter| down.complete(lower.clone(), bottom, bottom_values, reporter),
            |reporter| up.complete(upper.clone(), top, top_values, reporter),
        )?;
        Ok(values)
    }
}

/// Data that one sweep stores for the other: costs, and the means of N path costs, each rows ×
/// width × `num_cells`.
struct Volume {
    costs: Vec<u8>,
    means: Vec<u8>,
}

impl Volume {
    fn split(&mut self, at: usize) -> (VolumePart<'_>, VolumePart<'_>) {
        let (top_costs, bottom_costs) = self.costs.split_at_mut(at);
        let (top_means, bottom_means) = self.means.split_at_mut(at);
        (
            VolumePart {
                costs: top_costs,
                means: top_means,
            },
            VolumePart {
                costs: bottom_costs,
                means: bottom_means,
            },
        )
    }
}

/// Part of a [`Volume`] with some rows.
struct VolumePart<'a> {
    costs: &'a mut [u8],
    means: &'a mut [u8],
}

/// N paths down the image, or up.
struct HalfSweep<'a, const N: usize> {
    task: &'a Task<'a>,
    cost_rows: CostRows<'a>,
    paths: Sweep<N>,
    selector: Selector<'a>,
    upward: bool,
}

impl<'a, const N: usize> HalfSweep<'a, N> {
    fn new(task: &'a Task<'a>, upward: bool) -> Self {
        let search = task.search;
        Self {
            task,
            cost_rows: task.cost_rows(),
            paths: Sweep::new(search.width, search.num_cells, upward),
            selector: Selector::new(search, task.options.filter),
            upward,
        }
    }

    /// Iterates over the rows of a range in the order of the sweep: the number of preceding rows,
    /// and the row.
    fn visits(&self, rows: &Range<usize>) -> impl Iterator<Item = (usize, usize)> + use<N> {
        let (rows, upward) = (rows.clone(), self.upward);
        (0..rows.len()).map(move |i| {
            let v = if upward {
                rows.end - 1 - i
            } else {
                rows.start + i
            };
            (i, v)
        })
    }

    /// Runs the first half of the sweep: stores costs and path costs.
    fn store(
        &mut self,
        rows: Range<usize>,
        volume: VolumePart,
        reporter: &mut Reporter,
    ) -> Result<()> {
        let (search, len) = (self.task.search, self.task.row_cells());
        for (i, v) in self.visits(&rows) {
            reporter.report(i, rows.len())?;
            let cells = (v - rows.start) * len..(v - rows.start + 1) * len;
            let costs = &mut volume.costs[cells.clone()];
            self.cost_rows.row(v, costs);
            let gray = search.row_of(search.left.as_raw(), v);
            self.paths.next_row(costs, gray, &self.task.penalties);
            self.paths.means(&mut volume.means[cells]);
        }
        Ok(())
    }

    /// Runs the second half: adds to the other sweep's sums, and selects disparities.
    fn complete(
        &mut self,
        rows: Range<usize>,
        volume: VolumePart,
        values: &mut [f32],
        reporter: &mut Reporter,
    ) -> Result<()> {
        let (search, len) = (self.task.search, self.task.row_cells());
        let mut sums = vec![0; len];
        for (i, v) in self.visits(&rows) {
            reporter.report(i, rows.len())?;
            let row = v - rows.start;
            let cells = row * len..(row + 1) * len;
            let gray = search.row_of(search.left.as_raw(), v);
            let costs = &volume.costs[cells.clone()];
            self.paths.next_row(costs, gray, &self.task.penalties);
            // The mean times N is the other sweep's sum, to within half of N.
            for (sum, &mean) in sums.iter_mut().zip(&volume.means[cells]) {
                *sum = i16::from(mean) * N as i16;
            }
            self.paths.add_to(&mut sums);
            let out = &mut values[row * search.width..(row + 1) * search.width];
            self.selector.row(&mut sums, out);
        }
        Ok(())
    }
}
