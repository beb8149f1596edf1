//! Block matching.

use super::DisparityImage;
use super::filter::{DisparityFilter, SEARCH_FRACTION};
use super::prefilter::StereoPrefilter;
use super::search::{Search, to_eight_bits};
use super::winner::Selector;
use super::work::Strips;
use crate::math::simd::dispatched;
use crate::progress::{Monitor, Part};
use crate::{Error, Result};
use derive_setters::Setters;
use image::{GrayImage, ImageBuffer, Luma};

/// Dense disparity of a rectified pair by block matching.
///
/// The disparity at (u, v) is the d that minimizes `Σ |L(u+i, v+j) − R(u+i−d, v+j)|` over the
/// window, where L and R are the pre-filtered images; two lines of opposite slope through the sums
/// at d − 1, d, d + 1 give its fraction.
///
/// A pixel has no disparity (NaN) if the window has too little texture, the best match lies outside
/// the right image, another disparity fits nearly as well, the right image disagrees, or the
/// disparity is that of a small speckle. Border pixels are repeated where windows reach over the
/// border. Images without texture get no disparities, not an error.
///
/// Source: Konolige 1997, "Small vision systems: hardware and implementation".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::StereoBm;
/// use image::{GrayImage, Luma};
/// // A pattern, and the same moved 3 pixels to the left.
/// let gray = |u: u32, v: u32| Luma([((u * u * 7 + v * v * 5 + u * v * 3) % 251) as u8]);
/// let left = GrayImage::from_fn(40, 24, gray);
/// let right = GrayImage::from_fn(40, 24, |u, v| gray(u + 3, v));
/// let matcher = StereoBm::default().with_num_disparities(8).with_window_px(9);
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
pub struct StereoBm {
    /// Minimum disparity, pixels; negative for cameras that converge.
    pub min_disparity_px: i32,
    /// Number of disparities from the minimum upwards; 1 to 4096.
    pub num_disparities: u32,
    /// Side of the window, pixels; odd, at most the shorter side of the image. The sums must fit 15
    /// bits: `2 prefilter_cap window² ≤ 32766`, so at most 21 with a cap of 31.
    pub window_px: u32,
    /// Prefilter.
    pub prefilter: StereoPrefilter,
    /// Bound of the absolute pre-filtered values, 1 to 63.
    pub prefilter_cap: u8,
    /// Minimum mean magnitude of the pre-filtered left values in the window; 0 disables this test.
    pub min_texture: f32,
    /// Filter of the disparities.
    pub filter: DisparityFilter,
}

impl Default for StereoBm {
    /// Returns disparities 0 to 63 and windows of 15×15.
    fn default() -> Self {
        Self {
            min_disparity_px: 0,
            num_disparities: 64,
            window_px: 15,
            prefilter: StereoPrefilter::default(),
            prefilter_cap: 31,
            min_texture: 0.5,
            filter: DisparityFilter {
                uniqueness_percent: 10,
                max_gap_px: 0,
                ..DisparityFilter::default()
            },
        }
    }
}

impl StereoBm {
    /// Computes the disparities of `left`.
    ///
    /// * `left`, `right`: a rectified pair, so that matches share a row; equal sizes
    /// * `monitor`: the only stage is
    ///   [`Stage::DenseMatching`](crate::progress::Stage::DenseMatching)
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for images of different size, [`Error::TooFew`] for empty images,
    /// [`Error::OutOfRange`] for an option outside its range or a window larger than the image,
    /// [`Error::Canceled`].
    pub fn compute(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let search = Search::new(left, right, self.min_disparity_px, self.num_disparities)?;
        self.check(&search)?;
        let [left, right] =
            [left, right].map(|image| self.prefilter.apply(image, self.prefilter_cap));
        let mut values = vec![0.0; search.width * search.height];
        let strips = Strips {
            height: search.height,
            width: search.width,
            // Starting a strip costs as much as the rows of one window.
            least_rows: 4 * self.window_px as usize,
        };
        let part = &mut Part::new(monitor, 0.0, SEARCH_FRACTION);
        strips.run(&mut values, part, |first_row, values, reporter| {
            let mut windows = Windows::new(search, self, &left, &right, first_row);
            let mut selector = Selector::new(search, self.filter);
            let mut sums = vec![0; search.width * search.num_cells];
            let num_rows = values.len() / search.width;
            for (i, out) in values.chunks_exact_mut(search.width).enumerate() {
                reporter.report(i, num_rows)?;
                windows.next_row(&mut sums);
                selector.row(&mut sums, out);
                windows.forget_flat(out);
            }
            Ok(())
        })?;
        let clean = &mut Part::new(monitor, SEARCH_FRACTION, 1.0);
        self.filter.clean(search.image(values), clean)
    }

    /// As [`StereoBm::compute`], for gray values of any range: the smallest and the largest value
    /// of both images become 0 and 255.
    ///
    /// # Errors
    /// As [`StereoBm::compute`], and [`Error::NotFinite`] for NaN or infinities.
    pub fn compute_f32(
        &self,
        left: &ImageBuffer<Luma<f32>, Vec<f32>>,
        right: &ImageBuffer<Luma<f32>, Vec<f32>>,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let (left, right) = to_eight_bits(left, right)?;
        self.compute(&left, &right, monitor)
    }

    fn check(&self, search: &Search) -> Result<()> {
        let (window, cap) = (u64::from(self.window_px), u64::from(self.prefilter_cap));
        let shorter = search.width.min(search.height) as u64;
        Error::check_rules(&[
            (
                "the window",
                "an odd number of pixels, at least 3",
                f64::from(self.window_px),
                window % 2 == 1 && window >= 3,
            ),
            (
                "the window",
                "no larger than the shorter side of the pictures",
                f64::from(self.window_px),
                window <= shorter,
            ),
            (
                "the cap of the pre-filter",
                "from 1 to 63",
                f64::from(self.prefilter_cap),
                (1..=63).contains(&cap),
            ),
            (
                "the number of pixels in the window times twice the cap of the pre-filter",
                "at most 32766",
                (self.window_px as f64)
                    * (self.window_px as f64)
                    * 2.0
                    * f64::from(self.prefilter_cap),
                window.saturating_mul(window).saturating_mul(2 * cap) <= 32766,
            ),
            (
                "the smallest texture",
                "at least 0",
                f64::from(self.min_texture),
                self.min_texture >= 0.0,
            ),
        ])?;
        self.filter.check()
    }
}

/// Running sums over windows.
struct Windows<'a> {
    search: Search<'a>,
    radius: usize,
    cap: u8,
    /// Windows whose sum of magnitudes is below this are flat.
    min_texture: f32,
    left: &'a [u8],
    right: &'a [u8],
    /// Next row.
    v: usize,
    /// Absolute differences of each column, summed over the window's rows: width × `num_cells`.
    columns: Vec<i16>,
    /// Magnitudes of the left image's columns, summed likewise.
    textures: Vec<i32>,
    /// Sums over the window of one pixel.
    window: Vec<i16>,
    /// Right rows that enter and leave the window, reversed.
    entering: Vec<u8>,
    leaving: Vec<u8>,
}

impl<'a> Windows<'a> {
    /// Prepares the sums for row `first`.
    fn new(
        search: Search<'a>,
        options: &StereoBm,
        left: &'a [u8],
        right: &'a [u8],
        first: usize,
    ) -> Self {
        let padded = search.width + search.num_cells;
        let side = options.window_px as f32;
        let mut windows = Self {
            search,
            radius: options.window_px as usize / 2,
            cap: options.prefilter_cap,
            min_texture: options.min_texture * side * side,
            left,
            right,
            v: first,
            columns: vec![0; search.width * search.num_cells],
            textures: vec![0; search.width],
            window: vec![0; search.num_cells],
            entering: vec![0; padded],
            leaving: vec![0; padded],
        };
        // The window around the row before the first, with rows outside repeated.
        let radius = windows.radius as isize;
        for k in -radius..=radius {
            windows.add_row(windows.clamped(first as isize - 1 + k));
        }
        windows
    }

    fn clamped(&self, v: isize) -> usize {
        v.clamp(0, self.search.height as isize - 1) as usize
    }

    fn add_row(&mut self, v: usize) {
        let (width, n) = (self.search.width, self.search.num_cells);
        let left = self.search.row_of(self.left, v);
        let right = self.search.row_of(self.right, v);
        self.search.reverse(right, &mut self.entering);
        for (u, cells) in self.columns.chunks_exact_mut(n).enumerate() {
            let row = &self.entering[width - 1 - u..][..n];
            for (sum, &gray) in cells.iter_mut().zip(row) {
                *sum += i16::from(gap(left[u], gray));
            }
            self.textures[u] += i32::from(left[u].abs_diff(self.cap));
        }
    }

    /// Computes the sums of the next row: width × `num_cells`.
    fn next_row(&mut self, sums: &mut [i16]) {
        let radius = self.radius as isize;
        let new = self.clamped(self.v as isize + radius);
        let old = self.clamped(self.v as isize - 1 - radius);
        self.v += 1;
        let search = &self.search;
        let (new_left, old_left) = (search.row_of(self.left, new), search.row_of(self.left, old));
        search.reverse(search.row_of(self.right, new), &mut self.entering);
        search.reverse(search.row_of(self.right, old), &mut self.leaving);
        for (texture, (new, old)) in self.textures.iter_mut().zip(new_left.iter().zip(old_left)) {
            *texture += i32::from(new.abs_diff(self.cap)) - i32::from(old.abs_diff(self.cap));
        }
        slide_windows(
            search.num_cells,
            self.radius,
            [new_left, old_left],
            [&self.entering, &self.leaving],
            &mut self.columns,
            &mut self.window,
            sums,
        );
    }

    /// Removes the disparities of the last row in flat windows.
    fn forget_flat(&self, disparities: &mut [f32]) {
        if self.min_texture <= 0.0 {
            return;
        }
        let last = self.search.width - 1;
        let mut sum = self.textures[0] * self.radius as i32;
        for u in 0..self.radius {
            sum += self.textures[u.min(last)];
        }
        for (u, value) in disparities.iter_mut().enumerate() {
            sum += self.textures[(u + self.radius).min(last)];
            if (sum as f32) < self.min_texture {
                *value = f32::NAN;
            }
            sum -= self.textures[u.saturating_sub(self.radius)];
        }
    }
}

dispatched! {
    /// Computes the sums over the windows of a row.
    ///
    /// * `left`: the left rows that enter and leave the window, `right`: the right ones, reversed
    /// * `columns`: sums over the window's rows, updated from the previous row to this one
    /// * `window`: buffer of `num_cells` values
    fn slide_windows(
        num_cells: usize,
        radius: usize,
        left: [&[u8]; 2],
        right: [&[u8]; 2],
        columns: &mut [i16],
        window: &mut [i16],
        sums: &mut [i16],
    ) {
        let (n, width) = (num_cells, left[0].len());
        let column = |u: usize| u.min(width - 1) * n..(u.min(width - 1) + 1) * n;
        for u in 0..width + radius {
            if u < width {
                let entering = &right[0][width - 1 - u..][..n];
                let leaving = &right[1][width - 1 - u..][..n];
                exchange(&mut columns[column(u)], left[0][u], entering, left[1][u], leaving);
            }
            if u == 0 {
                // Columns left of the image repeat the first.
                for (sum, first) in window.iter_mut().zip(&columns[column(0)]) {
                    *sum = first * radius as i16;
                }
            }
            let entering = &columns[column(u)];
            if u < radius {
                slide(window, entering);
            } else {
                let leaving = &columns[column(u.saturating_sub(2 * radius))];
                let out = &mut sums[(u - radius) * n..][..n];
                slide_out(window, entering, leaving, out);
            }
        }
    }
}

/// Adds the differences of one row to a column of the window and subtracts those of another.
#[inline(always)]
fn exchange(cells: &mut [i16], gray_in: u8, entering: &[u8], gray_out: u8, leaving: &[u8]) {
    let n = cells.len();
    let (entering, leaving) = (&entering[..n], &leaving[..n]);
    for d in 0..n {
        let gain = i16::from(gap(gray_in, entering[d]));
        let loss = i16::from(gap(gray_out, leaving[d]));
        cells[d] += gain - loss;
    }
}

/// Returns |a − b|, by operations that vector units have for bytes.
#[inline(always)]
fn gap(a: u8, b: u8) -> u8 {
    a.max(b) - a.min(b)
}

#[inline(always)]
fn slide(window: &mut [i16], entering: &[i16]) {
    for (sum, column) in window.iter_mut().zip(entering) {
        *sum += column;
    }
}

/// Adds a column to the window, writes the sums, and removes a column.
#[inline(always)]
fn slide_out(window: &mut [i16], entering: &[i16], leaving: &[i16], out: &mut [i16]) {
    let n = window.len();
    let (entering, leaving, out) = (&entering[..n], &leaving[..n], &mut out[..n]);
    for d in 0..n {
        let sum = window[d] + entering[d];
        out[d] = sum;
        window[d] = sum - leaving[d];
    }
}
