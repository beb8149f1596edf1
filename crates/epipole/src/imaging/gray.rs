//! Gray images, and their conversion from and to the types of the `image` crate.

use crate::math::simd::dispatched;
use crate::{Error, Result};
use image::{GrayImage, ImageBuffer, Luma, RgbImage};

/// A gray image of 32-bit floats, rows from top to bottom; black is 0 and white is 1.
///
/// Filters are linear and accept any range; only thresholds stated for [0, 1] depend on the range.
pub type GrayImage32 = ImageBuffer<Luma<f32>, Vec<f32>>;

/// Luma weights of red, green and blue: `Y = 0.299 R + 0.587 G + 0.114 B`.
///
/// Source: ITU-R BT.601-7, §2.5.1.
pub const BT601_WEIGHTS: [f32; 3] = [0.299, 0.587, 0.114];

/// Luma weights of red, green and blue: `Y = 0.2126 R + 0.7152 G + 0.0722 B`.
///
/// Source: ITU-R BT.709-6, item 3.2.
pub const BT709_WEIGHTS: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Creates an image of the given size from its pixels in rows.
///
/// # Errors
/// [`Error::SizeMismatch`] unless there are `width × height` values.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// let image = epipole::imaging::gray_from_values(2, 1, vec![0.25, 0.75])?;
/// assert_eq!(image.get_pixel(1, 0).0, [0.75]);
/// # Ok(()) }
/// ```
pub fn gray_from_values(width: u32, height: u32, values: Vec<f32>) -> Result<GrayImage32> {
    let got = values.len();
    let needed = width as usize * height as usize;
    if got != needed {
        return Err(Error::SizeMismatch {
            what: "the image and its list of pixels",
            first: needed,
            second: got,
        });
    }
    Ok(from_vec(width, height, values))
}

/// Creates an image as [`gray_from_values`], infallibly, from pixels computed by this crate.
pub(crate) fn from_vec(width: u32, height: u32, values: Vec<f32>) -> GrayImage32 {
    GrayImage32::from_raw(width, height, values).expect("one value was computed for each pixel")
}

/// Converts an 8-bit gray image to floats in [0, 1]: `v / 255`.
///
/// ```
/// use image::{GrayImage, Luma};
/// let image = epipole::imaging::gray_to_f32(&GrayImage::from_pixel(1, 1, Luma([51])));
/// assert_eq!(image.get_pixel(0, 0).0, [0.2]);
/// ```
pub fn gray_to_f32(image: &GrayImage) -> GrayImage32 {
    let values = image.as_raw().iter().map(|&v| f32::from(v) / 255.0);
    from_vec(image.width(), image.height(), values.collect())
}

/// Converts a float image in [0, 1] to 8 bits: `round(255 v)`, clamped; NaN becomes 0.
///
/// Inverts [`gray_to_f32`] exactly.
///
/// ```
/// use epipole::imaging::{gray_from_values, gray_to_u8};
/// # fn main() -> Result<(), epipole::Error> {
/// let image = gray_from_values(3, 1, vec![0.2, -1.0, 7.0])?;
/// assert_eq!(gray_to_u8(&image).as_raw(), &[51, 0, 255]);
/// # Ok(()) }
/// ```
pub fn gray_to_u8(image: &GrayImage32) -> GrayImage {
    let mut bytes = vec![0; image.as_raw().len()];
    to_bytes(image.as_raw(), &mut bytes);
    GrayImage::from_raw(image.width(), image.height(), bytes)
        .expect("one value was computed for each pixel")
}

/// Between this number and its double, floats are the integers.
const WHOLE: f32 = 8_388_608.0;

dispatched! {
    fn to_bytes(values: &[f32], bytes: &mut [u8]) {
        for (byte, value) in bytes.iter_mut().zip(values) {
            // Conversions by `as` saturate, which costs more than the rest: adding 2²³ leaves the
            // nearest integer in the lowest bits. Halves round up; NaN becomes 0.
            let scaled = value * 255.0;
            let scaled = if scaled > 0.0 { scaled } else { 0.0 };
            let scaled = if scaled < 255.0 { scaled } else { 255.0 };
            let shifted = scaled + WHOLE;
            let half_below = scaled - (shifted - WHOLE) >= 0.5;
            *byte = (shifted.to_bits() as u8).wrapping_add(u8::from(half_below));
        }
    }
}

/// Converts color to gray by [`BT601_WEIGHTS`] in 15-bit fixed point, equal to OpenCV's `cvtColor`:
/// `(9798 R + 19235 G + 3735 B + 16384) / 32768`.
///
/// ```
/// use image::{Rgb, RgbImage};
/// let red = RgbImage::from_pixel(1, 1, Rgb([255, 0, 0]));
/// assert_eq!(epipole::imaging::rgb_to_gray(&red).as_raw(), &[76]); // 0.299 · 255 = 76.2
/// ```
pub fn rgb_to_gray(image: &RgbImage) -> GrayImage {
    let values = image.as_raw().as_chunks::<3>().0.iter().map(|&[r, g, b]| {
        ((9798 * u32::from(r) + 19235 * u32::from(g) + 3735 * u32::from(b) + 16384) >> 15) as u8
    });
    GrayImage::from_raw(image.width(), image.height(), values.collect())
        .expect("one value was computed for each pixel")
}

/// Converts color to gray in [0, 1] by weights of red, green and blue,
/// `(w_r R + w_g G + w_b B) / 255`.
///
/// Weights that sum to one, such as [`BT601_WEIGHTS`] and [`BT709_WEIGHTS`], keep white at 1.
///
/// ```
/// use epipole::imaging::{BT709_WEIGHTS, rgb_to_gray_f32};
/// use image::{Rgb, RgbImage};
/// let green = RgbImage::from_pixel(1, 1, Rgb([0, 255, 0]));
/// let gray = rgb_to_gray_f32(&green, &BT709_WEIGHTS);
/// assert!((gray.get_pixel(0, 0).0[0] - 0.7152).abs() < 1e-6);
/// ```
pub fn rgb_to_gray_f32(image: &RgbImage, weights: &[f32; 3]) -> GrayImage32 {
    let values = image.as_raw().as_chunks::<3>().0.iter().map(|&[r, g, b]| {
        (weights[0] * f32::from(r) + weights[1] * f32::from(g) + weights[2] * f32::from(b)) / 255.0
    });
    from_vec(image.width(), image.height(), values.collect())
}

/// Returns whether every pixel is a finite number.
pub(crate) fn is_finite(image: &GrayImage32) -> bool {
    // 0·v is 0 for a finite v and NaN otherwise; eight sums let the loop vectorize.
    let (chunks, rest) = image.as_raw().as_chunks::<8>();
    let mut lanes = [0.0f32; 8];
    for chunk in chunks {
        for (lane, v) in lanes.iter_mut().zip(chunk) {
            *lane += v * 0.0;
        }
    }
    lanes.iter().sum::<f32>() == 0.0 && rest.iter().all(|v| v.is_finite())
}

/// Returns [`Error::NotFinite`] if a pixel is NaN or infinite.
pub(crate) fn require_finite(image: &GrayImage32) -> Result<()> {
    if is_finite(image) {
        Ok(())
    } else {
        Err(Error::NotFinite {
            what: "every pixel of the image",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn bytes_survive_the_way_through_floats() {
        let all: Vec<u8> = (0..=255).collect();
        let image = GrayImage::from_raw(16, 16, all).unwrap();
        assert_eq!(gray_to_u8(&gray_to_f32(&image)), image);
    }

    #[test]
    fn bytes_are_rounded_and_clamped() {
        let mut values: Vec<f32> = (-40..1100).map(|k| k as f32 / 1020.0).collect();
        for half in 0..255 {
            let at = (half as f32 + 0.5) / 255.0;
            values.extend([at.next_down(), at, at.next_up()]);
        }
        values.extend([
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            -0.0,
            1e30,
            -1e30,
        ]);
        let image = gray_from_values(values.len() as u32, 1, values).unwrap();
        for (value, byte) in image.as_raw().iter().zip(gray_to_u8(&image).as_raw()) {
            assert_eq!(*byte, (value * 255.0).round() as u8, "{value}");
        }
    }

    #[test]
    fn color_to_gray_equals_opencv() {
        let rgb = fixture::bytes("rgb.npy");
        let gray = fixture::bytes("rgb_gray.npy");
        let image = RgbImage::from_raw(64, 64, rgb.values).unwrap();
        assert_eq!(rgb_to_gray(&image).as_raw(), &gray.values);
        let close = rgb_to_gray_f32(&image, &BT601_WEIGHTS);
        for (a, &b) in close.as_raw().iter().zip(&gray.values) {
            assert!((a * 255.0 - f32::from(b)).abs() < 0.51);
        }
    }

    #[test]
    fn a_wrong_number_of_pixels_is_refused() {
        assert!(matches!(
            gray_from_values(2, 2, vec![0.0; 3]),
            Err(Error::SizeMismatch {
                first: 4,
                second: 3,
                ..
            })
        ));
    }

    #[test]
    fn one_bad_pixel_anywhere_is_found() {
        for k in 0..21 {
            for bad in [f32::NAN, f32::INFINITY] {
                let mut image = GrayImage32::new(7, 3);
                assert!(is_finite(&image));
                image.as_mut()[k] = bad;
                assert!(!is_finite(&image));
            }
        }
    }
}
