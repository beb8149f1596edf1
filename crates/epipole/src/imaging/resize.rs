//! Resizing of gray images.

use super::GrayImage32;
use super::gray::from_vec;
use crate::math::simd::dispatched;
use crate::{Error, Result};

/// Resizes an image without aliasing: along an axis that shrinks each new pixel is the mean over
/// its area, along one that grows it is interpolated linearly.
///
/// The corner (−½, −½) is preserved: pixel u of the result is at `(u + ½) w/w' − ½` of the image.
///
/// * `width`, `height`: new size, pixels, > 0
///
/// # Errors
/// [`Error::OutOfRange`] for a width or height of 0, [`Error::TooFew`] for an image without
/// pixels.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{gray_from_values, resize};
/// let image = gray_from_values(3, 1, vec![0.0, 3.0, 9.0])?;
/// // Two pixels of 1.5 each: (0 + ½·3)/1.5 and (½·3 + 9)/1.5.
/// let small = resize(&image, 2, 1)?;
/// assert!((small.as_raw()[0] - 1.0).abs() < 1e-6 && (small.as_raw()[1] - 7.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn resize(image: &GrayImage32, width: u32, height: u32) -> Result<GrayImage32> {
    for (what, value) in [
        ("the width to resize to", width),
        ("the height to resize to", height),
    ] {
        if value == 0 {
            return Err(Error::OutOfRange {
                what,
                requirement: "at least 1 pixel",
                value: 0.0,
            });
        }
    }
    if image.as_raw().is_empty() {
        return Err(Error::TooFew {
            what: "resizing an image in pixels",
            needed: 1,
            got: 0,
        });
    }
    let (w, new_w) = (image.width() as usize, width as usize);
    let columns = weights(w, new_w);
    let rows = weights(image.height() as usize, height as usize);
    let mut values = Vec::with_capacity(new_w * height as usize);
    // Combine rows first: they are contiguous, so that this loop vectorizes.
    let mut row = vec![0.0f32; w];
    for (first, weights) in &rows {
        combine(weights, &image.as_raw()[first * w..], &mut row);
        values.extend(columns.iter().map(|(first, weights)| {
            let covered = &row[*first..first + weights.len()];
            match (weights.as_slice(), covered) {
                ([a, b, c], [u, v, w]) => a * u + b * v + c * w,
                _ => weights.iter().zip(covered).map(|(w, v)| w * v).sum::<f32>(),
            }
        }));
    }
    Ok(from_vec(width, height, values))
}

/// Number of columns whose sums are computed at once, in registers.
const LANES: usize = 32;

dispatched! {
    /// Computes the weighted sum of rows, one row per weight.
    fn combine(weights: &[f32], rows: &[f32], sums: &mut [f32]) {
        let width = sums.len();
        let mut x = 0;
        while x + LANES <= width {
            sums[x..x + LANES].copy_from_slice(&weighted::<LANES>(weights, &rows[x..], width));
            x += LANES;
        }
        for x in x..width {
            sums[x] = weighted::<1>(weights, &rows[x..], width)[0];
        }
    }
}

#[inline(always)]
fn weighted<const L: usize>(weights: &[f32], rows: &[f32], width: usize) -> [f32; L] {
    let mut sums = [0.0; L];
    for (k, weight) in weights.iter().enumerate() {
        let values = &rows[k * width..k * width + L];
        for i in 0..L {
            sums[i] += weight * values[i];
        }
    }
    sums
}

/// Returns, for each new sample, the index of the first old one used, and the weights from there
/// on.
fn weights(old: usize, new: usize) -> Vec<(usize, Vec<f32>)> {
    let scale = old as f64 / new as f64;
    let sample = |k: usize| {
        if new < old {
            let (from, to) = (k as f64 * scale, (k + 1) as f64 * scale);
            let first = (from.floor() as usize).min(old - 1);
            let last = (to.ceil() as usize).clamp(first + 1, old);
            let covered = (first..last).map(|i| {
                let overlap = to.min((i + 1) as f64) - from.max(i as f64);
                (overlap.max(0.0) / scale) as f32
            });
            (first, covered.collect())
        } else {
            let at = ((k as f64 + 0.5) * scale - 0.5).clamp(0.0, (old - 1) as f64);
            let first = (at.floor() as usize).min(old.saturating_sub(2));
            let fraction = (at - first as f64) as f32;
            if old == 1 {
                (0, vec![1.0])
            } else {
                (first, vec![1.0 - fraction, fraction])
            }
        }
    };
    (0..new).map(sample).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn sizes_equal_opencv() {
        let image = fixture::gray32("texture.npy");
        for (name, width, height) in [
            ("resize_area_20x12.npy", 20, 12),
            ("resize_area_13x9.npy", 13, 9),
            ("resize_linear_93x50.npy", 93, 50),
        ] {
            let ours = resize(&image, width, height).unwrap();
            fixture::assert_close(&ours, &fixture::gray32(name), 2e-6, name);
        }
    }

    #[test]
    fn mean_and_flatness_survive() {
        let image = fixture::gray32("texture.npy");
        let mean = |i: &GrayImage32| i.as_raw().iter().sum::<f32>() / i.as_raw().len() as f32;
        assert!((mean(&resize(&image, 7, 5).unwrap()) - mean(&image)).abs() < 1e-5);
        let one = GrayImage32::from_pixel(1, 1, image::Luma([0.25]));
        assert!(
            resize(&one, 6, 4)
                .unwrap()
                .as_raw()
                .iter()
                .all(|&v| v == 0.25)
        );
    }

    #[test]
    fn no_pixels_in_or_out_is_an_error() {
        let image = GrayImage32::new(4, 4);
        assert!(resize(&image, 0, 3).is_err());
        assert!(resize(&image, 3, 0).is_err());
        assert!(resize(&GrayImage32::new(0, 0), 3, 3).is_err());
    }
}
