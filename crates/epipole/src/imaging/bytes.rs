//! Filters of 8-bit images in whole numbers, equal to OpenCV's bit by bit.

use super::gaussian::samples;
use super::integral::require_box_size;
use super::{Border, DerivativeFilter};
use crate::math::simd::dispatched;
use crate::{Error, Result};
use image::{GrayImage, ImageBuffer, Luma};

/// A gray image of signed 16-bit numbers: derivatives of 8-bit images.
pub type GrayImageI16 = ImageBuffer<Luma<i16>, Vec<i16>>;

/// The derivatives of an 8-bit image along u and v, [`gain`](DerivativeFilter::gain) included.
///
/// Equal to OpenCV's `Sobel` and `Scharr` with 16-bit output. A constant border is in gray values
/// 0..255, rounded.
///
/// ```
/// use epipole::imaging::{Border, DerivativeFilter, derivative_u8};
/// let step = image::GrayImage::from_raw(3, 1, vec![0, 0, 255]).expect("three pixels");
/// let (du, _) = derivative_u8(&step, DerivativeFilter::Sobel3, Border::Replicate);
/// assert_eq!(du.as_raw(), &[0, 1020, 1020]);
/// ```
pub fn derivative_u8(
    image: &GrayImage,
    kind: DerivativeFilter,
    border: Border,
) -> (GrayImageI16, GrayImageI16) {
    let (along, across) = kind.kernels();
    let whole = |kernel: &[f32]| kernel.iter().map(|&w| w as i32).collect::<Vec<_>>();
    let (along, across) = (whole(along), whole(across));
    let run = |ku: &[i32], kv: &[i32]| {
        let mut out = Vec::with_capacity(image.as_raw().len());
        // The largest sum, of Sobel 5×5, is 3 · 16 · 255 = 12 240.
        filter(image, ku, kv, border, |row| {
            out.extend(row.iter().map(|&s| s as i16))
        });
        GrayImageI16::from_raw(image.width(), image.height(), out)
            .expect("one value was computed for each pixel")
    };
    (run(&along, &across), run(&across, &along))
}

/// An 8-bit image blurred by a Gaussian in 8-bit fixed point, equal to OpenCV's `GaussianBlur`.
///
/// * `size`: an odd number of samples up to 255; `None` takes `round(6σ + 1) | 1`
/// * `sigma_px`: pixels, > 0
///
/// The kernel is rounded to 256ths from its ends inwards, each error carried to the next sample,
/// and the center takes what is left of 256.
///
/// # Errors
/// [`Error::OutOfRange`] for another size or σ.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gaussian_blur_u8};
/// let flat = image::GrayImage::from_pixel(4, 4, image::Luma([77]));
/// assert_eq!(gaussian_blur_u8(&flat, Some(5), 1.1, Border::Reflect101)?, flat);
/// # Ok(()) }
/// ```
pub fn gaussian_blur_u8(
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
    let kernel = fixed_point_gaussian(sigma_px, size);
    Ok(collect(image, &kernel, &kernel, border, |sum| {
        ((sum + (1 << 15)) >> 16).min(255) as u8
    }))
}

/// The mean of an 8-bit image over the `size × size` window around each pixel, rounded as OpenCV's
/// `blur` rounds it.
///
/// * `size`: an odd number of pixels, at most 1001
///
/// # Errors
/// [`Error::OutOfRange`] for another size.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, box_filter_u8};
/// let image = image::GrayImage::from_raw(3, 1, vec![0, 10, 21]).expect("three pixels");
/// assert_eq!(box_filter_u8(&image, 3, Border::Replicate)?.as_raw(), &[3, 10, 17]);
/// # Ok(()) }
/// ```
pub fn box_filter_u8(image: &GrayImage, size: usize, border: Border) -> Result<GrayImage> {
    require_box_size(size)?;
    let ones = vec![1; size];
    let scale = 1.0 / (size * size) as f64;
    Ok(collect(image, &ones, &ones, border, |sum| {
        (f64::from(sum) * scale).round_ties_even() as u8
    }))
}

/// The 8-bit image at half its size, `(Σ + 128) / 256` of the weights `1 4 6 4 1` both ways; equal
/// to OpenCV's `pyrDown`.
///
/// ```
/// use epipole::imaging::{Border, pyramid_down_u8};
/// let flat = image::GrayImage::from_pixel(5, 4, image::Luma([9]));
/// assert_eq!(pyramid_down_u8(&flat, Border::Reflect101).dimensions(), (3, 2));
/// ```
pub fn pyramid_down_u8(image: &GrayImage, border: Border) -> GrayImage {
    let kernel = [1, 4, 6, 4, 1];
    let (mut values, mut v) = (Vec::new(), 0);
    filter(image, &kernel, &kernel, border, |row| {
        if v % 2 == 0 {
            values.extend(row.iter().step_by(2).map(|s| ((s + 128) >> 8) as u8));
        }
        v += 1;
    });
    GrayImage::from_raw(
        image.width().div_ceil(2),
        image.height().div_ceil(2),
        values,
    )
    .expect("one value was computed for each pixel")
}

/// Samples of a Gaussian in 256ths that sum to 256.
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

fn collect(
    image: &GrayImage,
    kernel_u: &[i32],
    kernel_v: &[i32],
    border: Border,
    finish: impl Fn(i32) -> u8,
) -> GrayImage {
    let mut values = Vec::with_capacity(image.as_raw().len());
    filter(image, kernel_u, kernel_v, border, |row| {
        values.extend(row.iter().map(|&sum| finish(sum)));
    });
    GrayImage::from_raw(image.width(), image.height(), values)
        .expect("one value was computed for each pixel")
}

/// Calls `emit` with each row of exact sums. Sums are whole, so their order does not matter.
fn filter(
    image: &GrayImage,
    kernel_u: &[i32],
    kernel_v: &[i32],
    border: Border,
    mut emit: impl FnMut(&[i32]),
) {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width == 0 || height == 0 {
        return;
    }
    let (ru, rv) = (kernel_u.len() / 2, kernel_v.len() / 2);
    let outside = f64::from(border.constant()).round().clamp(0.0, 255.0) as i32;
    let mut padded = vec![0i32; width + 2 * ru];
    let mut ring = vec![0i32; kernel_v.len() * width];
    let mut sums = vec![0i32; width];
    let length = kernel_v.len();
    for y in 0..height as isize {
        let newest = y + rv as isize;
        let first = if y == 0 { -(rv as isize) } else { newest };
        for row in first..=newest {
            match border.index(row, height) {
                None => padded.fill(outside),
                Some(m) => {
                    let source = &image.as_raw()[m * width..(m + 1) * width];
                    for (x, value) in padded.iter_mut().enumerate().take(ru) {
                        let index = border.index(x as isize - ru as isize, width);
                        *value = index.map_or(outside, |x| i32::from(source[x]));
                    }
                    for (value, &byte) in padded[ru..].iter_mut().zip(source) {
                        *value = i32::from(byte);
                    }
                    for x in 0..ru {
                        let index = border.index((width + x) as isize, width);
                        padded[ru + width + x] = index.map_or(outside, |x| i32::from(source[x]));
                    }
                }
            }
            let slot = (row + rv as isize) as usize % length;
            let out = &mut ring[slot * width..(slot + 1) * width];
            out.fill(0);
            for (k, &w) in kernel_u.iter().enumerate().filter(|(_, w)| **w != 0) {
                add(w, &padded[k..k + width], out);
            }
        }
        sums.fill(0);
        for (k, &w) in kernel_v.iter().enumerate().filter(|(_, w)| **w != 0) {
            let slot = (y as usize + k) % length;
            add(w, &ring[slot * width..(slot + 1) * width], &mut sums);
        }
        emit(&sums);
    }
}

dispatched! {
    fn add(weight: i32, values: &[i32], sums: &mut [i32]) {
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn derivatives_equal_opencv() {
        let image = fixture::gray8("texture_u8.npy");
        for (name, kind) in [
            ("sobel3", DerivativeFilter::Sobel3),
            ("sobel5", DerivativeFilter::Sobel5),
            ("scharr", DerivativeFilter::Scharr),
        ] {
            let (du, dv) = derivative_u8(&image, kind, Border::Reflect101);
            assert_eq!(
                du.as_raw(),
                &fixture::shorts(&format!("u8_{name}_u.npy")).values
            );
            assert_eq!(
                dv.as_raw(),
                &fixture::shorts(&format!("u8_{name}_v.npy")).values
            );
        }
    }

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
        for size in [3, 5, 7, 9] {
            let ours = box_filter_u8(&image, size, Border::Reflect101).unwrap();
            let name = format!("u8_box_{size}.npy");
            assert_eq!(ours.as_raw(), &fixture::bytes(&name).values, "{name}");
        }
        let ours = pyramid_down_u8(&image, Border::Reflect101);
        assert_eq!(ours.as_raw(), &fixture::bytes("u8_pyr_down.npy").values);
    }

    #[test]
    fn tiny_images_and_bad_sizes() {
        for (w, h) in [(0, 0), (1, 1), (1, 9), (9, 1)] {
            let image = GrayImage::from_pixel(w, h, Luma([200]));
            let blurred = gaussian_blur_u8(&image, Some(9), 2.0, Border::Reflect101).unwrap();
            assert_eq!(blurred, image);
            assert_eq!(box_filter_u8(&image, 5, Border::Replicate).unwrap(), image);
            let (du, _) = derivative_u8(&image, DerivativeFilter::Sobel5, Border::Reflect101);
            assert!(du.as_raw().iter().all(|&d| d == 0));
        }
        let image = GrayImage::new(4, 4);
        assert!(gaussian_blur_u8(&image, Some(4), 1.0, Border::Replicate).is_err());
        assert!(gaussian_blur_u8(&image, None, f64::NAN, Border::Replicate).is_err());
        assert!(gaussian_blur_u8(&image, None, 900.0, Border::Replicate).is_err());
        assert!(box_filter_u8(&image, 2, Border::Replicate).is_err());
    }
}
