//! Sums over rectangles: the integral image and the box filter.

use super::separable::filter;
use super::{Border, GrayImage32};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Sums of all pixels above and to the left, `S(u, v) = Σ_{j<v} Σ_{i<u} I(i, j)`, in double
/// precision; the sum over any rectangle then takes four reads.
///
/// Source: Crow 1984, "Summed-area tables for texture mapping".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{IntegralImage, gray_from_values};
/// let image = gray_from_values(3, 2, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// let integral = IntegralImage::new(&image);
/// assert_eq!(integral.sum(1, 0, 3, 2), 2.0 + 3.0 + 5.0 + 6.0);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct IntegralImage {
    width: usize,
    height: usize,
    /// (width + 1) × (height + 1) sums.
    sums: Vec<f64>,
}

impl IntegralImage {
    /// Computes the integral of an image.
    pub fn new(image: &GrayImage32) -> Self {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let stride = width + 1;
        let mut sums = vec![0.0; stride * (height + 1)];
        for v in 0..height {
            let (above, below) = sums[v * stride..].split_at_mut(stride);
            let mut row = 0.0;
            for u in 0..width {
                row += f64::from(image.as_raw()[v * width + u]);
                below[u + 1] = above[u + 1] + row;
            }
        }
        Self {
            width,
            height,
            sums,
        }
    }

    /// Returns the sum over the rectangle `u0 ≤ u < u1`, `v0 ≤ v < v1`, clipped to the image; 0 if
    /// empty.
    pub fn sum(&self, u0: usize, v0: usize, u1: usize, v1: usize) -> f64 {
        let (u1, v1) = (u1.min(self.width), v1.min(self.height));
        if u0 >= u1 || v0 >= v1 {
            return 0.0;
        }
        let at = |u: usize, v: usize| self.sums[v * (self.width + 1) + u];
        at(u1, v1) - at(u0, v1) - at(u1, v0) + at(u0, v0)
    }

    /// Returns the mean over the same rectangle; 0 if it is empty.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::imaging::{IntegralImage, gray_from_values};
    /// let image = gray_from_values(2, 1, vec![1.0, 2.0])?;
    /// assert_eq!(IntegralImage::new(&image).mean(0, 0, 9, 9), 1.5);
    /// # Ok(()) }
    /// ```
    pub fn mean(&self, u0: usize, v0: usize, u1: usize, v1: usize) -> f64 {
        let (u1, v1) = (u1.min(self.width), v1.min(self.height));
        if u0 >= u1 || v0 >= v1 {
            return 0.0;
        }
        self.sum(u0, v0, u1, v1) / ((u1 - u0) * (v1 - v0)) as f64
    }
}

/// Computes the mean over the `size × size` window around each pixel.
///
/// * `size`: an odd number of pixels, at most 1001; for larger windows see [`IntegralImage`]
///
/// The only stage is [`Stage::Filtering`](crate::progress::Stage::Filtering).
///
/// # Errors
/// [`Error::OutOfRange`] for another size, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, box_filter, gray_from_values};
/// let image = gray_from_values(3, 1, vec![0.0, 3.0, 6.0])?;
/// let mean = box_filter(&image, 3, Border::Replicate, &mut ())?;
/// assert!((mean.as_raw()[1] - 3.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn box_filter(
    image: &GrayImage32,
    size: usize,
    border: Border,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    require_box_size(size)?;
    let (ones, weights) = (vec![1.0; size], vec![1.0 / (size * size) as f32; size]);
    let [mean] = filter(image, [(&ones, &weights)], border, monitor)?;
    Ok(mean)
}

fn require_box_size(size: usize) -> Result<()> {
    if size % 2 == 1 && size <= 1001 {
        return Ok(());
    }
    Err(Error::OutOfRange {
        what: "the size of a box filter",
        requirement: "an odd number up to 1001",
        value: size as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn box_filter_equals_opencv() {
        let image = fixture::gray32("texture.npy");
        for (name, size, border) in [
            ("box_5_reflect101.npy", 5, Border::Reflect101),
            ("box_9_replicate.npy", 9, Border::Replicate),
        ] {
            let ours = box_filter(&image, size, border, &mut ()).unwrap();
            fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
        }
        for size in [0, 2, 1003] {
            assert!(box_filter(&image, size, Border::Replicate, &mut ()).is_err());
        }
    }

    #[test]
    fn every_rectangle_sums_as_its_pixels_do() {
        let image = fixture::gray32("texture.npy");
        let integral = IntegralImage::new(&image);
        for (u0, v0, u1, v1) in [
            (0, 0, 40, 31),
            (3, 4, 17, 5),
            (39, 30, 99, 99),
            (5, 5, 5, 9),
        ] {
            let mut sum = 0.0;
            for (u, v, p) in image.enumerate_pixels() {
                if (u0..u1).contains(&(u as usize)) && (v0..v1).contains(&(v as usize)) {
                    sum += f64::from(p.0[0]);
                }
            }
            assert!((integral.sum(u0, v0, u1, v1) - sum).abs() < 1e-9);
        }
        assert_eq!(integral.sum(9, 9, 3, 3), 0.0);
        assert_eq!(integral.mean(50, 0, 60, 9), 0.0);
        assert_eq!(
            IntegralImage::new(&GrayImage32::new(0, 0)).sum(0, 0, 1, 1),
            0.0
        );
    }
}
