//! Coverage of each pixel by a mark.
//!
//! All parts of a mark add to its coverage before its color is blended once, so that overlapping
//! parts, such as the pieces of a curve at their joints, are not drawn twice.

use super::edge::Edge;
use crate::theme::Rgb;
use std::ops::Range;

/// The parts of one mark on a picture, device pixels; empty between marks.
#[derive(Default)]
pub(super) struct Coverage {
    width: usize,
    /// Coverage of each pixel, 0 to 255.
    alpha: Vec<u8>,
    /// Column range of each row outside of which the coverage is 0.
    touched: Vec<Range<usize>>,
    /// Row range outside of which the coverage is 0.
    rows: Range<usize>,
    /// Scratch memory for one row of [`Coverage::add_polygon`]; 0 between rows.
    pub(super) sums: Vec<f32>,
    /// Scratch memory for its edges.
    pub(super) edges: Vec<Edge>,
}

impl Coverage {
    /// Returns an empty coverage that reuses the memory of `self`.
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

    /// Returns the rows with centers within `low..=high`, pixels.
    pub(super) fn rows_within(&self, low: f32, high: f32) -> Range<usize> {
        centers_within(low, high, self.height())
    }

    /// Returns the columns with centers within `low..=high`, pixels.
    pub(super) fn columns_within(&self, low: f32, high: f32) -> Range<usize> {
        centers_within(low, high, self.width)
    }

    /// Returns part of a row for writing and marks it as touched.
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

    /// Returns the coverage of each pixel, 0 to 255.
    pub(super) fn into_alpha(self) -> Vec<u8> {
        self.alpha
    }

    /// Blends a color by the coverage, and clears the coverage.
    pub(super) fn blend(&mut self, pixels: &mut [u8], color: Rgb, opacity: f64) {
        let opacity = (opacity.clamp(0.0, 1.0) * 256.0).round() as u16;
        let ink = Ink::new(color);
        for row in std::mem::take(&mut self.rows) {
            let columns = std::mem::take(&mut self.touched[row]);
            let start = row * self.width + columns.start;
            let alphas = &mut self.alpha[start..][..self.width - columns.start];
            let touched = &mut alphas[..columns.len()];
            if opacity < 256 {
                // The product fits in 16 bits, so that a vector holds eight.
                for alpha in touched.iter_mut() {
                    *alpha = ((u16::from(*alpha) * opacity + 128) >> 8) as u8;
                }
            }
            // Uncovered pixels do not change, so round up to whole vectors.
            let together = columns.len().next_multiple_of(AT_ONCE).min(alphas.len());
            ink.blend_row(
                &mut pixels[4 * start..][..4 * together],
                &alphas[..together],
            );
            alphas[..columns.len()].fill(0);
        }
    }
}

fn centers_within(low: f32, high: f32, count: usize) -> Range<usize> {
    // The cast saturates: negative values and NaN become 0.
    let start = ((low - 0.5).ceil() as usize).min(count);
    let end = ((high + 0.5).floor() as usize).min(count);
    start..end.max(start)
}

/// Number of pixels blended together.
pub(super) const AT_ONCE: usize = 8;
const BYTES: usize = 4 * AT_ONCE;

/// A color to be blended into pixels of red, green, blue and an alpha of 255.
pub(super) struct Ink {
    /// Bytes of two pixels of the color.
    color: [u16; 8],
}

impl Ink {
    pub(super) fn new([r, g, b]: Rgb) -> Self {
        let bytes = [r, g, b, 255].map(u16::from);
        Self {
            color: std::array::from_fn(|byte| bytes[byte % 4]),
        }
    }

    /// Blends the color into a row of pixels by the coverage of each.
    #[inline]
    pub(super) fn blend_row(&self, pixels: &mut [u8], alphas: &[u8]) {
        let (chunks, last_pixels) = pixels.as_chunks_mut::<BYTES>();
        let (alpha_chunks, last_alphas) = alphas.as_chunks::<AT_ONCE>();
        for (pixels, alphas) in chunks.iter_mut().zip(alpha_chunks) {
            // Most marks are small or narrow within their bounds, and large ones are uniform
            // inside.
            if *alphas == [0; AT_ONCE] {
                continue;
            }
            match *alphas == [alphas[0]; AT_ONCE] {
                true => self.mix_evenly(pixels, alphas[0]),
                false => self.mix(pixels, alphas),
            }
        }
        let count = last_alphas.len();
        if count > 0 {
            // A padded copy is faster than pixel by pixel.
            let (mut few, mut padded) = ([0; BYTES], [0; AT_ONCE]);
            few[..4 * count].copy_from_slice(last_pixels);
            padded[..count].copy_from_slice(last_alphas);
            self.mix(&mut few, &padded);
            last_pixels.copy_from_slice(&few[..4 * count]);
        }
    }

    /// Blends this color into a row of pixels, and another one over it, each by its own coverage.
    // Inlining would lose the no-alias guarantee of the arguments, and with it vectorization.
    #[inline(never)]
    pub(super) fn blend_row_under(
        &self,
        over: &Self,
        pixels: &mut [u8],
        alphas: &[u8],
        alphas_over: &[u8],
    ) {
        let (chunks, last_pixels) = pixels.as_chunks_mut::<BYTES>();
        let (chunks_under, last_under) = alphas.as_chunks::<AT_ONCE>();
        let (chunks_over, last_over) = alphas_over.as_chunks::<AT_ONCE>();
        for ((pixels, alphas), alphas_over) in chunks.iter_mut().zip(chunks_under).zip(chunks_over)
        {
            if *alphas_over == [255; AT_ONCE] {
                over.mix_evenly(pixels, 255);
                continue;
            }
            if *alphas != [0; AT_ONCE] {
                self.mix(pixels, alphas);
            }
            if *alphas_over != [0; AT_ONCE] {
                over.mix(pixels, alphas_over);
            }
        }
        if !last_under.is_empty() {
            self.blend_row(last_pixels, last_under);
            over.blend_row(last_pixels, last_over);
        }
    }

    /// Blends eight bytes at a time in 16 bits each, without branches, for vector instructions.
    #[inline(always)]
    fn mix(&self, pixels: &mut [u8; BYTES], alphas: &[u8; AT_ONCE]) {
        let twos = pixels.as_chunks_mut::<8>().0.iter_mut();
        for (two, &[first, second]) in twos.zip(alphas.as_chunks::<2>().0) {
            for (index, byte) in two.iter_mut().enumerate() {
                let coverage = u16::from(if index < 4 { first } else { second });
                let paper = u16::from(*byte) * (255 - coverage);
                *byte = nearest_255th(self.color[index] * coverage + paper);
            }
        }
    }

    /// Blends as [`mix`](Self::mix), with equal coverage of all pixels.
    #[inline(always)]
    fn mix_evenly(&self, pixels: &mut [u8; BYTES], alpha: u8) {
        let coverage = u16::from(alpha);
        let ink: [u16; 8] = std::array::from_fn(|byte| self.color[byte] * coverage);
        for two in pixels.as_chunks_mut::<8>().0 {
            for (byte, ink) in two.iter_mut().zip(ink) {
                *byte = nearest_255th(ink + u16::from(*byte) * (255 - coverage));
            }
        }
    }
}

/// Divides a number up to 255² by 255, rounded to nearest.
#[inline]
fn nearest_255th(sum: u16) -> u8 {
    let sum = sum + 128;
    ((sum + (sum >> 8)) >> 8) as u8
}

// Unlike `f32::min` and `f32::max`, these compile to one instruction, also for vectors; not for
// NaN.

#[inline]
pub(super) fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Converts a coverage from 0 to 1 to 255ths.
#[inline]
pub(super) fn parts(coverage: f32) -> u8 {
    // Adding 2²³ rounds to an integer in the low bits: a cast that vector instructions have.
    const WHOLE_ONLY: f32 = 8_388_608.0;
    (coverage * 255.0 + WHOLE_ONLY).to_bits() as u8
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
    fn pixels_together_blend_as_one_by_one() {
        let alphas: Vec<u8> = [0, 255, 40, 7, 128]
            .into_iter()
            .flat_map(|alpha| [[alpha; 8], [0, 1, 128, 254, 255, alpha, 3, 9]])
            .flatten()
            .chain([9, 200, 255])
            .collect();
        let before: Vec<u8> = (0..4 * alphas.len())
            .map(|k| (k * 37 % 256) as u8)
            .collect();
        let color = [200, 10, 90];
        let mut pixels = before.clone();
        Ink::new(color).blend_row(&mut pixels, &alphas);
        for (index, &alpha) in alphas.iter().enumerate() {
            for channel in 0..3 {
                let [ink, paper] = [color[channel], before[4 * index + channel]].map(f64::from);
                let coverage = f64::from(alpha) / 255.0;
                let expected = ink * coverage + paper * (1.0 - coverage);
                let error = (expected - f64::from(pixels[4 * index + channel])).abs();
                assert!(error <= 0.5 + 1e-9, "{index} {channel}: {error}");
            }
        }
    }

    #[test]
    fn two_colors_together_blend_as_one_after_the_other() {
        let alphas: Vec<u8> = (0..43).map(|k| (k * 53 % 256) as u8).collect();
        let over = [[0; 8], [255; 8], [0, 7, 255, 255, 9, 200, 0, 255], [0; 8]];
        let over: Vec<u8> = over.concat().into_iter().chain([255; 11]).collect();
        let before: Vec<u8> = (0..4 * alphas.len())
            .map(|k| (k * 37 % 256) as u8)
            .collect();
        let inks = [Ink::new([200, 10, 90]), Ink::new([3, 250, 40])];
        let (mut together, mut in_turn) = (before.clone(), before);
        inks[0].blend_row_under(&inks[1], &mut together, &alphas, &over);
        inks[0].blend_row(&mut in_turn, &alphas);
        inks[1].blend_row(&mut in_turn, &over);
        assert_eq!(together, in_turn);
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
