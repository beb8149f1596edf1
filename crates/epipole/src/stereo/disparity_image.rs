//! Disparities of the pixels of the left image.

use crate::{Error, Result};
use image::{ImageBuffer, Luma};

/// Disparities `d = u_left − u_right` of the left image's pixels, in pixels; NaN if unknown.
///
/// Values are either finite or NaN, never infinite.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::DisparityImage;
/// let disparity = DisparityImage::from_raw(2, 1, vec![3.5, f32::NAN])?;
/// assert_eq!(disparity.get(0, 0), Some(3.5));
/// assert_eq!(disparity.get(1, 0), None);
/// assert_eq!(disparity.density(), 0.5);
/// assert_eq!(disparity.range_px(), Some((3.5, 3.5)));
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct DisparityImage {
    width: u32,
    height: u32,
    values: Vec<f32>,
}

impl DisparityImage {
    /// Creates an image from disparities row by row; infinite values become NaN.
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] unless there are width × height values.
    pub fn from_raw(width: u32, height: u32, mut values: Vec<f32>) -> Result<Self> {
        let num_pixels = width as usize * height as usize;
        if values.len() != num_pixels {
            return Err(Error::SizeMismatch {
                what: "the disparities and the picture",
                first: values.len(),
                second: num_pixels,
            });
        }
        for value in &mut values {
            // Branch-free, as unknown pixels among known ones would make branches slow.
            *value = if value.is_finite() { *value } else { f32::NAN };
        }
        Ok(Self {
            width,
            height,
            values,
        })
    }

    /// Creates an image from values known to be finite or NaN, and of the right number.
    pub(super) fn new(width: u32, height: u32, values: Vec<f32>) -> Self {
        debug_assert_eq!(values.len(), width as usize * height as usize);
        Self {
            width,
            height,
            values,
        }
    }

    /// Returns the number of columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the disparity at column `u` and row `v`; `None` if unknown or outside the image.
    pub fn get(&self, u: u32, v: u32) -> Option<f32> {
        if u >= self.width || v >= self.height {
            return None;
        }
        let value = self.values[v as usize * self.width as usize + u as usize];
        (!value.is_nan()).then_some(value)
    }

    /// Returns all values row by row, NaN if unknown.
    pub fn as_raw(&self) -> &[f32] {
        &self.values
    }

    /// Exchanges rows and columns.
    pub(super) fn transposed(&self) -> Self {
        let value = |u: u32, v: u32| self.values[u as usize * self.width as usize + v as usize];
        let pixels = (0..self.width).flat_map(|v| (0..self.height).map(move |u| (u, v)));
        Self {
            width: self.height,
            height: self.width,
            values: pixels.map(|(u, v)| value(u, v)).collect(),
        }
    }

    pub(super) fn values_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// Converts the values to a gray image of `f32`, NaN if unknown.
    pub fn into_image(self) -> ImageBuffer<Luma<f32>, Vec<f32>> {
        let (width, height) = (self.width, self.height);
        ImageBuffer::from_raw(width, height, self.values)
            .expect("the constructor checked that the values fill the picture")
    }

    /// Returns the fraction of pixels with a disparity, 0 to 1; 0 for an empty image.
    pub fn density(&self) -> f64 {
        if self.values.is_empty() {
            return 0.0;
        }
        let answered = self.values.iter().filter(|d| !d.is_nan()).count();
        answered as f64 / self.values.len() as f64
    }

    /// Returns the minimum and maximum disparity, pixels; `None` if no pixel has one.
    pub fn range_px(&self) -> Option<(f32, f32)> {
        self.values
            .iter()
            .filter(|d| !d.is_nan())
            .fold(None, |range, &d| match range {
                None => Some((d, d)),
                Some((low, high)) => Some((d.min(low), d.max(high))),
            })
    }
}

/// Images are equal if the same pixels have disparities with the same bits.
impl PartialEq for DisparityImage {
    fn eq(&self, other: &Self) -> bool {
        let same = |(a, b): (&f32, &f32)| a == b || (a.is_nan() && b.is_nan());
        self.width == other.width
            && self.height == other.height
            && self.values.iter().zip(&other.values).all(same)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn infinities_are_no_answers() {
        let d = DisparityImage::from_raw(3, 1, vec![1.0, f32::INFINITY, f32::NAN]).unwrap();
        assert_eq!(d.get(1, 0), None);
        assert_eq!(d.get(3, 0), None);
        assert_eq!(d, d.clone());
        assert!((d.density() - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(d.into_image().dimensions(), (3, 1));
    }

    #[test]
    fn a_wrong_number_of_values_is_refused() {
        assert!(matches!(
            DisparityImage::from_raw(3, 2, vec![0.0; 5]),
            Err(Error::SizeMismatch {
                first: 5,
                second: 6,
                ..
            })
        ));
        let empty = DisparityImage::from_raw(0, 0, vec![]).unwrap();
        assert_eq!(empty.density(), 0.0);
        assert_eq!(empty.range_px(), None);
    }
}
