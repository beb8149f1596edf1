//! Filters before block matching, which keep details and remove gradual brightness changes.

use crate::math::simd::dispatched;
use image::GrayImage;

/// Filter of both images before block matching.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum StereoPrefilter {
    /// Horizontal Sobel derivative, limited to ± the cap: vertical edges.
    #[default]
    XSobel,
    /// Difference from the mean of the 9×9 surrounding pixels, limited to ± the cap.
    LocalMean,
}

/// Half the window of [`StereoPrefilter::LocalMean`].
const MEAN_RADIUS: usize = 4;

impl StereoPrefilter {
    /// Returns the filtered image plus `cap`, from 0 to 2 cap. Border pixels are repeated outside.
    pub(super) fn apply(self, image: &GrayImage, cap: u8) -> Vec<u8> {
        match self {
            Self::XSobel => x_sobel(image, cap),
            Self::LocalMean => local_mean(image, cap),
        }
    }
}

#[inline(always)]
fn limit(x: i16, cap: u8) -> u8 {
    (x.clamp(-i16::from(cap), i16::from(cap)) + i16::from(cap)) as u8
}

dispatched! {
    fn x_sobel(image: &GrayImage, cap: u8) -> Vec<u8> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let row = |v: usize| &image.as_raw()[v * width..(v + 1) * width];
        let mut out = vec![0; width * height];
        // Each column's 1-2-1 sum, with a repeated column at either end.
        let mut sums = vec![0i16; width + 2];
        for (v, out) in out.chunks_exact_mut(width).enumerate() {
            let (above, here) = (row(v.saturating_sub(1)), row(v));
            let below = row((v + 1).min(height - 1));
            let inner = &mut sums[1..=width];
            for u in 0..width {
                inner[u] = i16::from(above[u]) + 2 * i16::from(here[u]) + i16::from(below[u]);
            }
            sums[0] = sums[1];
            sums[width + 1] = sums[width];
            let (before, after) = (&sums[..width], &sums[2..]);
            for u in 0..width {
                out[u] = limit(after[u] - before[u], cap);
            }
        }
        out
    }
}

dispatched! {
    fn local_mean(image: &GrayImage, cap: u8) -> Vec<u8> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let row = |v: usize| &image.as_raw()[v * width..(v + 1) * width];
        let area = (2 * MEAN_RADIUS as i32 + 1) * (2 * MEAN_RADIUS as i32 + 1);
        let mut out = vec![0; width * height];
        let mut columns = vec![0i32; width + 2 * MEAN_RADIUS];
        for (v, out) in out.chunks_exact_mut(width).enumerate() {
            columns.fill(0);
            for k in 0..=2 * MEAN_RADIUS {
                let from = row((v + k).saturating_sub(MEAN_RADIUS).min(height - 1));
                for u in 0..width {
                    columns[MEAN_RADIUS + u] += i32::from(from[u]);
                }
            }
            let (first, last) = (columns[MEAN_RADIUS], columns[MEAN_RADIUS + width - 1]);
            columns[..MEAN_RADIUS].fill(first);
            columns[MEAN_RADIUS + width..].fill(last);
            let mut sum: i32 = columns[..2 * MEAN_RADIUS].iter().sum();
            let here = row(v);
            for u in 0..width {
                sum += columns[u + 2 * MEAN_RADIUS];
                // Rounded to nearest: sums are never negative.
                let mean = (2 * sum + area) / (2 * area);
                out[u] = limit(i16::from(here[u]) - mean as i16, cap);
                sum -= columns[u];
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    #[test]
    fn a_ramp_has_the_same_derivative_everywhere_inside() {
        let ramp = GrayImage::from_fn(8, 5, |u, _| Luma([(3 * u) as u8]));
        let filtered = StereoPrefilter::XSobel.apply(&ramp, 31);
        // (1 + 2 + 1) × (two columns apart: 6) = 24, and half of it where a column repeats.
        assert_eq!(&filtered[8..16], &[43, 55, 55, 55, 55, 55, 55, 43]);
        let limited = StereoPrefilter::XSobel.apply(&ramp, 10);
        assert!(limited.iter().all(|&x| x == 20));
    }

    #[test]
    fn brightness_does_not_matter() {
        let dark = GrayImage::from_fn(20, 12, |u, v| Luma([((u * 7 + v * 13) % 50) as u8]));
        let bright = GrayImage::from_fn(20, 12, |u, v| Luma([dark.get_pixel(u, v).0[0] + 100]));
        for filter in [StereoPrefilter::XSobel, StereoPrefilter::LocalMean] {
            let (a, b) = (filter.apply(&dark, 31), filter.apply(&bright, 31));
            assert_eq!(a, b);
            assert!(a.iter().any(|&x| x != 31));
        }
    }
}
