//! Downscaling of color images.

use image::RgbImage;
use image::imageops::{FilterType, resize};

/// Returns the size with the same aspect ratio and at most `max_pixels` pixels, at least 1 × 1.
fn reduced_size((width, height): (u32, u32), max_pixels: u64) -> (u32, u32) {
    let pixels = u64::from(width) * u64::from(height);
    if pixels <= max_pixels {
        return (width, height);
    }
    let factor = libm::sqrt(max_pixels.max(1) as f64 / pixels as f64);
    let side = |side: u32| ((f64::from(side) * factor).floor() as u32).max(1);
    (side(width), side(height))
}

/// Downscales an image to at most `max_pixels` pixels: each new pixel is a triangle-weighted mean
/// of those around its position. A sufficiently small image is returned unchanged.
///
/// The corner (−½, −½) is preserved, as in [`resize`](super::resize()):
/// [`Intrinsics::resized`](crate::camera::Intrinsics::resized) converts the camera.
///
/// ```
/// use epipole::imaging::reduce_rgb;
/// let image = image::RgbImage::from_pixel(40, 30, image::Rgb([9, 8, 7]));
/// let small = reduce_rgb(image, 300);
/// assert_eq!(small.dimensions(), (20, 15));
/// assert_eq!(small.get_pixel(3, 4).0, [9, 8, 7]);
/// ```
pub fn reduce_rgb(image: RgbImage, max_pixels: u64) -> RgbImage {
    let (width, height) = reduced_size(image.dimensions(), max_pixels);
    if (width, height) == image.dimensions() {
        return image;
    }
    resize(&image, width, height, FilterType::Triangle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_that_are_not_usual() {
        assert_eq!(reduced_size((4000, 3000), 3_000_000), (2000, 1500));
        assert_eq!(reduced_size((640, 480), 3_000_000), (640, 480));
        assert_eq!(reduced_size((1_000_000, 1), 100), (10_000, 1));
        assert_eq!(reduced_size((0, 0), 100), (0, 0));
        assert_eq!(reduced_size((7, 5), 0), (1, 1));
        assert_eq!(
            reduced_size((u32::MAX, u32::MAX), u64::MAX),
            (u32::MAX, u32::MAX)
        );
        let (width, height) = reduced_size((u32::MAX, u32::MAX), 3_000_000);
        assert!(u64::from(width) * u64::from(height) <= 3_000_000);
    }

    #[test]
    fn the_middle_stays_in_the_middle() {
        // Brightness grows to the right, so preserving the corner preserves the mean.
        let image = RgbImage::from_fn(64, 8, |u, _| image::Rgb([(u * 4) as u8; 3]));
        let small = reduce_rgb(image, 16 * 2);
        assert_eq!(small.dimensions(), (16, 2));
        for u in 2..14 {
            // Pixel u of the small image is at 4 (u + ½) − ½ of the large one.
            let expected = 4.0 * (4.0 * (f64::from(u) + 0.5) - 0.5);
            let got = f64::from(small.get_pixel(u, 0).0[0]);
            assert!((got - expected).abs() <= 1.0, "{u}: {got} {expected}");
        }
    }
}
