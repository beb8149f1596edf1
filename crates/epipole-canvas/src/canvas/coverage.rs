//! How much of each pixel a mark covers.
//!
//! A mark first says how much of each pixel it covers, all its parts together, and only then its
//! color is blended: where parts overlap, as the pieces of a curve do at their joints, nothing is
//! drawn twice.

use crate::theme::Rgb;
use std::ops::Range;

/// The parts of one mark on a picture, device pixels; empty between marks.
#[derive(Default)]
pub(super) struct Coverage {
    width: usize,
    /// 0 to 255 for each pixel.
    alpha: Vec<u8>,
    /// The columns of each row outside of which all is 0.
    touched: Vec<Range<usize>>,
    /// The rows outside of which all is 0.
    rows: Range<usize>,
    /// Room for one row of [`Coverage::add_polygon`].
    pub(super) sums: Vec<f32>,
}

impl Coverage {
    /// Nothing is covered yet; the memory of `self` is used again.
    pub(super) fn sized(mut self, width: usize, height: usize) -> Self {
        self.width = width;
        self.alpha.resize(width * height, 0);
        self.touched.resize(height, 0..0);
        self
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    pub(super) fn height(&self) -> usize {
        self.touched.len()
    }

    /// The rows whose centers are within `low..=high`, pixels.
    pub(super) fn rows_within(&self, low: f32, high: f32) -> Range<usize> {
        centers_within(low, high, self.height())
    }

    /// The columns whose centers are within `low..=high`, pixels.
    pub(super) fn columns_within(&self, low: f32, high: f32) -> Range<usize> {
        centers_within(low, high, self.width)
    }

    /// Part of a row, to be covered by whoever asks for it.
    pub(super) fn part(&mut self, row: usize, columns: Range<usize>) -> &mut [u8] {
        if columns.is_empty() {
            return &mut [];
        }
        let join = |a: &Range<usize>, b: &Range<usize>| match a.is_empty() {
            true => b.clone(),
            false => a.start.min(b.start)..a.end.max(b.end),
        };
        self.rows = join(&self.rows, &(row..row + 1));
        self.touched[row] = join(&self.touched[row], &columns);
        &mut self.alpha[row * self.width..][columns]
    }

    /// How much of each pixel is covered.
    pub(super) fn into_alpha(self) -> Vec<u8> {
        self.alpha
    }

    /// Blends a color where the picture is covered, and covers nothing again.
    pub(super) fn blend(&mut self, pixels: &mut [u8], color: Rgb, opacity: f64) {
        let opacity = (opacity.clamp(0.0, 1.0) * 256.0).round() as u32;
        for row in std::mem::take(&mut self.rows) {
            let columns = std::mem::take(&mut self.touched[row]);
            let start = row * self.width + columns.start;
            let alphas = &mut self.alpha[start..][..columns.len()];
            if opacity < 256 {
                for alpha in alphas.iter_mut() {
                    *alpha = ((u32::from(*alpha) * opacity + 128) >> 8) as u8;
                }
            }
            blend_row(&mut pixels[4 * start..][..4 * alphas.len()], alphas, color);
            alphas.fill(0);
        }
    }
}

fn centers_within(low: f32, high: f32, count: usize) -> Range<usize> {
    // A cast takes what is negative for 0 and what is no number, too.
    let start = ((low - 0.5).ceil() as usize).min(count);
    let end = ((high + 0.5).floor() as usize).min(count);
    start..end.max(start)
}

/// Blends a color into pixels of red, green, blue and an alpha of 255.
pub(super) fn blend_row(pixels: &mut [u8], alphas: &[u8], [r, g, b]: Rgb) {
    const AT_ONCE: usize = 8;
    let color = [[r, g, b, 255]; AT_ONCE];
    let color = color.as_flattened();
    let mut chunks = pixels.chunks_exact_mut(4 * AT_ONCE);
    let (alpha_chunks, last_alphas) = alphas.as_chunks::<AT_ONCE>();
    for (pixels, alphas) in (&mut chunks).zip(alpha_chunks) {
        // Most are outside or inside; only the rim is a mixture.
        match u64::from_ne_bytes(*alphas) {
            0 => {}
            u64::MAX => pixels.copy_from_slice(color),
            _ => mix(pixels, alphas, color),
        }
    }
    mix(chunks.into_remainder(), last_alphas, color);
}

/// Made for vector instructions: sixteen bits hold everything, and nothing branches.
#[inline]
fn mix(pixels: &mut [u8], alphas: &[u8], color: &[u8]) {
    let colors = color.chunks_exact(4);
    for ((pixel, &alpha), color) in pixels.chunks_exact_mut(4).zip(alphas).zip(colors) {
        let (alpha, rest) = (u16::from(alpha), u16::from(255 - alpha));
        for (byte, &channel) in pixel.iter_mut().zip(color) {
            let sum = u16::from(channel) * alpha + u16::from(*byte) * rest + 128;
            // The nearest whole number to (sum - 128) / 255.
            *byte = ((sum + (sum >> 8)) >> 8) as u8;
        }
    }
}

/// A share of a pixel, 0 to 1, in 255 parts.
#[inline]
pub(super) fn parts(share: f32) -> u8 {
    // At this size a number's last bits count ones: a cast that vector instructions have.
    const WHOLE_ONLY: f32 = 8_388_608.0;
    (share * 255.0 + WHOLE_ONLY).to_bits() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_covered_twice_is_blended_once_and_then_nothing_is_covered() {
        let mut coverage = Coverage::default().sized(4, 2);
        let mut pixels = [255u8; 4 * 4 * 2];
        coverage.part(1, 1..3).fill(128);
        coverage.part(1, 2..4).fill(128);
        coverage.blend(&mut pixels, [0, 0, 0], 1.0);
        let red: Vec<u8> = pixels.chunks(4).map(|pixel| pixel[0]).collect();
        assert_eq!(red, [255, 255, 255, 255, 255, 127, 127, 127]);
        assert!(pixels.chunks(4).all(|pixel| pixel[3] == 255));
        coverage.blend(&mut pixels, [0, 0, 0], 1.0);
        assert_eq!(pixels[4 * 7], 127);
        assert!(coverage.alpha.iter().all(|&alpha| alpha == 0));
    }

    #[test]
    fn opacity_scales_what_is_covered() {
        let mut coverage = Coverage::default().sized(1, 1);
        let mut pixels = [0u8, 0, 0, 255];
        coverage.part(0, 0..1).fill(255);
        coverage.blend(&mut pixels, [200, 100, 0], 0.5);
        assert_eq!(pixels, [100, 50, 0, 255]);
    }

    #[test]
    fn rows_and_columns_are_those_whose_centers_are_inside() {
        let coverage = Coverage::default().sized(10, 5);
        assert_eq!(coverage.columns_within(1.5, 3.5), 1..4);
        assert_eq!(coverage.columns_within(1.6, 3.4), 2..3);
        assert_eq!(coverage.rows_within(-7.0, 1e9), 0..5);
        assert!(coverage.rows_within(f32::NAN, 2.0).end <= 5);
        assert!(coverage.rows_within(3.0, -2.0).is_empty());
    }
}
