//! Sharpness of an image, relative to others of the same scene.

use super::{GrayImage32, laplacian_pyramid};

/// Returns the mean square of the second level of the image's Laplacian pyramid, with details of a
/// few pixels, which blur removes. The first level is ignored: it is mostly noise and codec
/// artifacts.
///
/// Only images of the same size and similar content are comparable, such as consecutive video
/// frames. 0 for images with a side of less than about four pixels.
///
/// Source: Burt & Adelson 1983, §3, for the pyramid.
///
/// ```
/// use epipole::imaging::{Border, gaussian_blur, gray_from_values, sharpness};
/// # fn main() -> Result<(), epipole::Error> {
/// let stripes = (0..64 * 64).map(|n| if n % 64 / 4 % 2 == 0 { 0.2 } else { 0.8 });
/// let sharp = gray_from_values(64, 64, stripes.collect())?;
/// let soft = gaussian_blur(&sharp, 1.5, Border::Replicate, &mut ())?;
/// assert!(sharpness(&sharp) > 2.0 * sharpness(&soft));
/// # Ok(()) }
/// ```
pub fn sharpness(image: &GrayImage32) -> f64 {
    // Two differences, and the remainder.
    let levels = laplacian_pyramid(image, 3);
    let Some(band) = levels.get(1).filter(|_| levels.len() == 3) else {
        return 0.0;
    };
    let values = band.as_raw();
    let sum: f64 = values.iter().map(|v| f64::from(*v) * f64::from(*v)).sum();
    sum / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_that_are_too_small_have_none() {
        for (width, height) in [(1, 1), (2, 1), (0, 0), (5, 3)] {
            assert_eq!(sharpness(&GrayImage32::new(width, height)), 0.0);
        }
    }
}
