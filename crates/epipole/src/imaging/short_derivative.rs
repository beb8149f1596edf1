//! Both derivatives of an image by the usual filters, with weights −1, 0, 1 along and three
//! symmetric weights across, in one loop per row.
//!
//! The sums are those of [`RowFilter`](super::separable::RowFilter), in the same order. A new row
//! replaces the oldest in the same loop, so that fewer rows compete for the L1 cache.

use super::kernel::Three;
use super::{Border, GrayImage32};
use crate::math::simd::dispatched;

/// Derivatives row by row. If rows are requested in order, each source row is filtered along u
/// once.
#[derive(Clone)]
pub(crate) struct ShortDerivative<'a> {
    image: &'a GrayImage32,
    across: Three,
    border: Border,
    /// The source row with an additional pixel at either end.
    padded: Vec<f32>,
    /// Differences along the last two source rows, and the same rows smoothed; the older first.
    slopes: [Vec<f32>; 2],
    smooth: [Vec<f32>; 2],
    /// Row for which these are filled.
    next: Option<usize>,
}

impl<'a> ShortDerivative<'a> {
    /// Returns `None` for other filters.
    ///
    /// * `along`, `across`: weights of the filter
    pub(crate) fn new(
        image: &'a GrayImage32,
        (along, across): (&[f32], &[f32]),
        border: Border,
    ) -> Option<Self> {
        if along != [-1.0, 0.0, 1.0] {
            return None;
        }
        let width = image.width() as usize;
        let row = |len: usize| vec![0.0; len];
        Some(Self {
            image,
            across: Three::new(across)?,
            border,
            padded: row(width + 2),
            slopes: [row(width), row(width)],
            smooth: [row(width), row(width)],
            next: None,
        })
    }

    /// Computes the derivatives of row `y`.
    pub(crate) fn row(&mut self, y: usize, du: &mut [f32], dv: &mut [f32]) {
        let newest = y as isize + 1;
        if self.next != Some(y) {
            // The last call overwrites the results of the first two.
            self.push(newest - 2, du, dv);
            self.push(newest - 1, du, dv);
        }
        self.push(newest, du, dv);
        self.next = Some(y + 1);
    }

    /// Adds a source row and computes the derivatives of the previous row.
    fn push(&mut self, row: isize, du: &mut [f32], dv: &mut [f32]) {
        let (width, height) = (self.image.width() as usize, self.image.height() as usize);
        match self.border.index(row, height) {
            None => self.padded.fill(self.border.constant()),
            Some(y) => {
                let source = &self.image.as_raw()[y * width..(y + 1) * width];
                self.padded[1..=width].copy_from_slice(source);
                pad(&mut self.padded, self.border);
            }
        }
        let ([slope, slope_before], [smooth, smooth_before]) = (&mut self.slopes, &mut self.smooth);
        derive(
            self.across,
            &self.padded,
            slope,
            slope_before,
            smooth,
            du,
            dv,
        );
        std::mem::swap(slope, slope_before);
        std::mem::swap(smooth, smooth_before);
    }
}

/// Sets the first and last value by the border of the values between.
pub(crate) fn pad(row: &mut [f32], border: Border) {
    let width = row.len() - 2;
    let at = |x: isize| border.index(x, width).map(|x| x + 1);
    let (first, last) = (at(-1), at(width as isize));
    row[0] = first.map_or(border.constant(), |x| row[x]);
    row[width + 1] = last.map_or(border.constant(), |x| row[x]);
}

dispatched! {
    /// Computes the derivatives of the row before a new one.
    ///
    /// * `padded`: the new row
    /// * `slope_before`: differences along the previous row
    /// * `slope`, `smooth`: values of the row before that, replaced by those of the new row
    fn derive(
        across: Three,
        padded: &[f32],
        slope: &mut [f32],
        slope_before: &[f32],
        smooth: &mut [f32],
        du: &mut [f32],
        dv: &mut [f32],
    ) {
        let n = slope.len();
        let (left, here, right) = (&padded[..n], &padded[1..n + 1], &padded[2..n + 2]);
        let (slope_before, smooth) = (&slope_before[..n], &mut smooth[..n]);
        let (du, dv) = (&mut du[..n], &mut dv[..n]);
        for x in 0..n {
            // Zero is added as in other sums: it turns −0 into 0.
            let new_slope = 0.0 + (right[x] - left[x]);
            let new_smooth = across.sum(left[x], here[x], right[x]);
            du[x] = across.sum(slope[x], slope_before[x], new_slope);
            dv[x] = 0.0 + (new_smooth - smooth[x]);
            slope[x] = new_slope;
            smooth[x] = new_smooth;
        }
    }
}
