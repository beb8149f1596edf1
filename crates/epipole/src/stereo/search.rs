//! Input checks shared by all matchers: a pair of images and a range of disparities.

use super::DisparityImage;
use crate::{Error, Result};
use image::{GrayImage, ImageBuffer, Luma};

/// Maximum number of cells (pixels × disparities) of a volume, to limit memory.
#[cfg(target_pointer_width = "64")]
const MAX_CELLS: usize = 1 << 31;
#[cfg(not(target_pointer_width = "64"))]
const MAX_CELLS: usize = 1 << 28;

/// A validated pair of equal size with its range of disparities.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) left: &'a GrayImage,
    pub(super) right: &'a GrayImage,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) min_disparity: i32,
    pub(super) num_disparities: usize,
    /// The number of disparities of one pixel, rounded up to a multiple of 16.
    pub(super) num_cells: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        left: &'a GrayImage,
        right: &'a GrayImage,
        min_disparity: i32,
        num_disparities: u32,
    ) -> Result<Self> {
        for (what, first, second) in [
            ("the rows of the two pictures", left.width(), right.width()),
            (
                "the columns of the two pictures",
                left.height(),
                right.height(),
            ),
        ] {
            if first != second {
                return Err(Error::SizeMismatch {
                    what,
                    first: first as usize,
                    second: second as usize,
                });
            }
        }
        if left.width() == 0 || left.height() == 0 {
            return Err(Error::TooFew {
                what: "dense matching of pictures' pixels",
                needed: 1,
                got: 0,
            });
        }
        let longest = left.width();
        Error::check_rules(&[
            (
                "the number of disparities",
                "at least 1, and at most 4096",
                f64::from(num_disparities),
                (1..=4096).contains(&num_disparities),
            ),
            (
                "the smallest disparity",
                "less than the width of the pictures, to either side",
                f64::from(min_disparity),
                min_disparity.unsigned_abs() < longest,
            ),
        ])?;
        Ok(Self {
            left,
            right,
            width: left.width() as usize,
            height: left.height() as usize,
            min_disparity,
            num_disparities: num_disparities as usize,
            num_cells: (num_disparities as usize).next_multiple_of(16),
        })
    }

    /// Rejects a search whose cost volume would not fit in memory.
    pub(super) fn check_volume(&self) -> Result<usize> {
        self.width
            .checked_mul(self.height)
            .and_then(|n| n.checked_mul(self.num_cells))
            .filter(|&n| n <= MAX_CELLS)
            .ok_or(Error::OutOfRange {
                what: "the number of pixels times disparities",
                requirement: "small enough for memory; take smaller pictures or fewer disparities",
                value: self.width as f64 * self.height as f64 * self.num_cells as f64,
            })
    }

    /// Returns row v of an image of the pair's size.
    pub(super) fn row_of<'b>(&self, pixels: &'b [u8], v: usize) -> &'b [u8] {
        &pixels[v * self.width..(v + 1) * self.width]
    }

    /// Reverses a right row, so that candidates of increasing disparity are adjacent: cell d of
    /// column u is at `width − 1 − u + d`. Border pixels are repeated outside.
    #[inline(always)]
    pub(super) fn reverse(&self, row: &[u8], reversed: &mut [u8]) {
        let (width, len) = (self.width as i64, reversed.len() as i64);
        let row = &row[..self.width];
        // Element j is right pixel `begin − j`.
        let begin = width - 1 - i64::from(self.min_disparity);
        let first_inside = (begin - width + 1).clamp(0, len);
        let end_inside = (begin + 1).clamp(first_inside, len);
        let (head, rest) = reversed.split_at_mut(first_inside as usize);
        let (inside, tail) = rest.split_at_mut((end_inside - first_inside) as usize);
        head.fill(row[self.width - 1]);
        tail.fill(row[0]);
        if !inside.is_empty() {
            let last = (begin - first_inside) as usize;
            let from = &row[last + 1 - inside.len()..=last];
            for (to, &value) in inside.iter_mut().zip(from.iter().rev()) {
                *to = value;
            }
        }
    }

    /// Returns the cells of column u whose right pixel lies inside the image.
    pub(super) fn cells_inside(&self, u: usize) -> std::ops::Range<usize> {
        let nearest = u as i64 - i64::from(self.min_disparity);
        let begin = (nearest - self.width as i64 + 1).clamp(0, self.num_disparities as i64);
        let end = (nearest + 1).clamp(begin, self.num_disparities as i64);
        begin as usize..end as usize
    }

    pub(super) fn image(&self, values: Vec<f32>) -> DisparityImage {
        DisparityImage::new(self.left.width(), self.left.height(), values)
    }
}

/// Converts the pair to eight bits: the smallest and largest value of both become 0 and 255.
///
/// # Errors
/// [`Error::NotFinite`] for NaN or infinities.
pub(super) fn to_eight_bits(
    left: &ImageBuffer<Luma<f32>, Vec<f32>>,
    right: &ImageBuffer<Luma<f32>, Vec<f32>>,
) -> Result<(GrayImage, GrayImage)> {
    let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
    for &x in left.as_raw().iter().chain(right.as_raw()) {
        if !x.is_finite() {
            return Err(Error::NotFinite {
                what: "every gray value of the two pictures",
            });
        }
        low = low.min(x);
        high = high.max(x);
    }
    let scale = 255.0 / (f64::from(high) - f64::from(low)).max(f64::MIN_POSITIVE);
    let convert = |image: &ImageBuffer<Luma<f32>, Vec<f32>>| {
        let gray = |&x: &f32| ((f64::from(x) - f64::from(low)) * scale + 0.5) as u8;
        let raw = image.as_raw().iter().map(gray).collect();
        GrayImage::from_raw(image.width(), image.height(), raw)
            .expect("as many values as the picture it comes from")
    };
    Ok((convert(left), convert(right)))
}
