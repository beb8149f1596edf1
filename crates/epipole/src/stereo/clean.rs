//! Removing answers that stand alone, and closing single gaps.

use super::DisparityImage;
use crate::{Error, Result};

/// Removes the answers of every connected set of fewer than `min_size` pixels; neighbors left,
/// right, above and below are connected if their disparities differ by at most `range_px`.
///
/// # Errors
/// [`Error::OutOfRange`] unless `range_px` is a number ≥ 0.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityImage, remove_speckles};
/// let mut disparity = DisparityImage::from_raw(4, 1, vec![5.0, 5.5, 6.0, 20.0])?;
/// remove_speckles(&mut disparity, 2, 1.0)?;
/// assert_eq!(disparity.get(2, 0), Some(6.0));
/// assert_eq!(disparity.get(3, 0), None);
/// # Ok(()) }
/// ```
pub fn remove_speckles(disparity: &mut DisparityImage, min_size: u32, range_px: f32) -> Result<()> {
    if range_px.is_nan() || range_px < 0.0 {
        return Err(Error::OutOfRange {
            what: "the range of a speckle",
            requirement: "at least 0 pixels",
            value: f64::from(range_px),
        });
    }
    if min_size < 2 {
        return Ok(());
    }
    let width = disparity.width() as usize;
    let values = disparity.values_mut();
    let mut sets = Sets::new(values.len());
    // NaN compares as false, so it connects to nothing.
    for i in 0..values.len() {
        if i % width > 0 && (values[i] - values[i - 1]).abs() <= range_px {
            sets.join(i, i - 1);
        }
        if i >= width && (values[i] - values[i - width]).abs() <= range_px {
            sets.join(i, i - width);
        }
    }
    for i in 0..values.len() {
        let root = sets.root(i);
        if sets.sizes[root] < min_size {
            values[i] = f32::NAN;
        }
    }
    Ok(())
}

/// Disjoint sets of pixels; a set's root is its first pixel.
struct Sets {
    parents: Vec<u32>,
    sizes: Vec<u32>,
}

impl Sets {
    fn new(len: usize) -> Self {
        Self {
            parents: (0..len as u32).collect(),
            sizes: vec![1; len],
        }
    }

    #[inline]
    fn root(&mut self, i: usize) -> usize {
        let mut i = i;
        while self.parents[i] as usize != i {
            let parent = self.parents[i] as usize;
            self.parents[i] = self.parents[parent];
            i = self.parents[i] as usize;
        }
        i
    }

    #[inline]
    fn join(&mut self, i: usize, j: usize) {
        let (a, b) = (self.root(i), self.root(j));
        if a != b {
            let (first, second) = (a.min(b), a.max(b));
            self.parents[second] = first as u32;
            self.sizes[first] += self.sizes[second];
        }
    }
}

/// Closes gaps of at most `max_gap` pixels along rows, then along columns, by a straight line
/// between the answers at both ends, where these differ by at most `range_px`: a surface that
/// goes on behind the gap. Where they differ more, one end hides what lies behind, and the gap
/// stays.
pub(super) fn close_gaps(disparity: &mut DisparityImage, max_gap: usize, range_px: f32) {
    let (width, height) = (disparity.width() as usize, disparity.height() as usize);
    let values = disparity.values_mut();
    for v in 0..height {
        close_gaps_of_line(values, v * width, 1, width, max_gap, range_px);
    }
    for u in 0..width {
        close_gaps_of_line(values, u, width, height, max_gap, range_px);
    }
}

/// Of `len` pixels, each `step` after the last.
fn close_gaps_of_line(
    values: &mut [f32],
    first: usize,
    step: usize,
    len: usize,
    max_gap: usize,
    range_px: f32,
) {
    let mut before: Option<usize> = None;
    for k in 0..len {
        let end = values[first + k * step];
        if end.is_nan() {
            continue;
        }
        if let Some(j) = before {
            let begin = values[first + j * step];
            if k - j > 1 && k - j - 1 <= max_gap && (end - begin).abs() <= range_px {
                for i in j + 1..k {
                    let share = (i - j) as f32 / (k - j) as f32;
                    values[first + i * step] = begin + (end - begin) * share;
                }
            }
        }
        before = Some(k);
    }
}
