//! Gaussian blur of 8-bit images in integers, bit-identical to OpenCV.

use super::Border;
use super::gaussian::samples;
use crate::math::simd::dispatched;
use crate::{Error, Result};
use image::GrayImage;

/// Blurs an 8-bit image by a Gaussian in 8-bit fixed point, equal to OpenCV's `GaussianBlur`.
///
/// * `size`: an odd number of samples up to 255; `None` for `round(6σ + 1) | 1`
/// * `sigma_px`: pixels, > 0
///
/// The kernel is rounded to multiples of 1/256 from its ends inwards, each error is carried to the
/// next sample, and the center takes the remainder.
///
/// # Errors
/// [`Error::OutOfRange`] for another size or σ.
pub(crate) fn gaussian_blur_u8(
    image: &GrayImage,
    size: Option<usize>,
    sigma_px: f64,
    border: Border,
) -> Result<GrayImage> {
    if !(sigma_px > 0.0 && sigma_px <= 1000.0) {
        return Err(Error::OutOfRange {
            what: "the standard deviation of a Gaussian in pixels",
            requirement: "greater than 0 and at most 1000",
            value: sigma_px,
        });
    }
    let size = size.unwrap_or((sigma_px * 6.0 + 1.0).round_ties_even() as usize | 1);
    if size.is_multiple_of(2) || size > 255 {
        return Err(Error::OutOfRange {
            what: "the size of a Gaussian kernel for bytes",
            requirement: "an odd number up to 255",
            value: size as f64,
        });
    }
    Ok(filter(image, &fixed_point_gaussian(sigma_px, size), border))
}

/// Returns samples of a Gaussian as multiples of 1/256 that sum to 256.
fn fixed_point_gaussian(sigma_px: f64, size: usize) -> Vec<i32> {
    let exact = samples(sigma_px, size / 2);
    let mut kernel = vec![0; size];
    let (mut carried, mut sum) = (0.0, 0);
    for k in 0..size / 2 {
        let wanted = exact[k] * 256.0 + carried;
        let rounded = wanted.round_ties_even();
        carried = wanted - rounded;
        kernel[k] = rounded as i32;
        kernel[size - 1 - k] = rounded as i32;
        sum += 2 * rounded as i32;
    }
    kernel[size / 2] = 256 - sum;
    kernel
}

/// Filters an image along u and v. Sums are integers, so their order does not matter.
fn filter(image: &GrayImage, kernel: &[i32], border: Border) -> GrayImage {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width == 0 || height == 0 {
        return image.clone();
    }
    let size = kernel.len();
    let radius = size / 2;
    let outside = f64::from(border.constant()).round().clamp(0.0, 255.0) as u8;
    let mut padded = vec![0u8; width + 2 * radius];
    let mut ring = vec![0i32; size * width];
    let mut values = vec![0u8; width * height];
    for (y, out) in values.chunks_exact_mut(width).enumerate() {
        let newest = (y + radius) as isize;
        let first = if y == 0 { -(radius as isize) } else { newest };
        for row in first..=newest {
            match border.index(row, height) {
                None => padded.fill(outside),
                Some(m) => {
                    let source = &image.as_raw()[m * width..(m + 1) * width];
                    let beyond = |x: isize| border.index(x, width).map_or(outside, |x| source[x]);
                    for x in 0..radius {
                        padded[x] = beyond(x as isize - radius as isize);
                        padded[radius + width + x] = beyond((width + x) as isize);
                    }
                    padded[radius..radius + width].copy_from_slice(source);
                }
            }
            let slot = (row + radius as isize) as usize % size;
            along(kernel, &padded, &mut ring[slot * width..(slot + 1) * width]);
        }
        across(kernel, &ring, y % size, out);
    }
    GrayImage::from_raw(image.width(), image.height(), values)
        .expect("one value was computed for each pixel")
}

/// Number of pixels whose sums are computed at once, in registers.
const LANES: usize = 16;

dispatched! {
    fn along(kernel: &[i32], padded: &[u8], sums: &mut [i32]) {
        let mut x = 0;
        while x + LANES <= sums.len() {
            let values = weighted::<LANES, _>(kernel, |k| &padded[x + k..], i32::from);
            sums[x..x + LANES].copy_from_slice(&values);
            x += LANES;
        }
        for x in x..sums.len() {
            sums[x] = weighted::<1, _>(kernel, |k| &padded[x + k..], i32::from)[0];
        }
    }
}

dispatched! {
    /// * `oldest`: row of the ring for the first weight
    fn across(kernel: &[i32], ring: &[i32], oldest: usize, out: &mut [u8]) {
        let (width, size) = (out.len(), kernel.len());
        let row = |k: usize| {
            let slot = oldest + k - if oldest + k < size { 0 } else { size };
            &ring[slot * width..(slot + 1) * width]
        };
        let byte = |sum: i32| ((sum + (1 << 15)) >> 16).min(255) as u8;
        let mut x = 0;
        while x + LANES <= width {
            let values = weighted::<LANES, _>(kernel, |k| &row(k)[x..], |sum| sum);
            out[x..x + LANES].copy_from_slice(&values.map(byte));
            x += LANES;
        }
        for x in x..width {
            out[x] = byte(weighted::<1, _>(kernel, |k| &row(k)[x..], |sum| sum)[0]);
        }
    }
}

/// Computes weighted sums of the first values of slices, one slice per weight.
#[inline(always)]
fn weighted<'a, const L: usize, T: Copy + 'a>(
    kernel: &[i32],
    values: impl Fn(usize) -> &'a [T],
    number: impl Fn(T) -> i32,
) -> [i32; L] {
    let mut sums = [0; L];
    for (k, &weight) in kernel.iter().enumerate() {
        let values = &values(k)[..L];
        for i in 0..L {
            sums[i] += weight * number(values[i]);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;
    use image::Luma;

    #[test]
    fn blurs_equal_opencv() {
        let image = fixture::gray8("texture_u8.npy");
        for (name, size, sigma_px, border) in [
            ("u8_gauss_5_s1.1.npy", Some(5), 1.1, Border::Reflect101),
            ("u8_gauss_auto_s2.npy", None, 2.0, Border::Replicate),
            ("u8_gauss_7_s1.4.npy", Some(7), 1.4, Border::Constant(0.0)),
            ("u8_gauss_3_s0.6.npy", Some(3), 0.6, Border::Reflect101),
            ("u8_gauss_11_s3.npy", Some(11), 3.0, Border::Reflect101),
        ] {
            let ours = gaussian_blur_u8(&image, size, sigma_px, border).unwrap();
            assert_eq!(ours.as_raw(), &fixture::bytes(name).values, "{name}");
        }
    }

    #[test]
    fn tiny_images_and_bad_sizes() {
        for (w, h) in [(0, 0), (1, 1), (1, 9), (9, 1)] {
            let image = GrayImage::from_pixel(w, h, Luma([200]));
            let blurred = gaussian_blur_u8(&image, Some(9), 2.0, Border::Reflect101).unwrap();
            assert_eq!(blurred, image);
        }
        let image = GrayImage::new(4, 4);
        assert!(gaussian_blur_u8(&image, Some(4), 1.0, Border::Replicate).is_err());
        assert!(gaussian_blur_u8(&image, None, f64::NAN, Border::Replicate).is_err());
        assert!(gaussian_blur_u8(&image, None, 900.0, Border::Replicate).is_err());
    }
}
