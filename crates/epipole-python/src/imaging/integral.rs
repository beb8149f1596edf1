//! Integral images.

use crate::images::gray;
use crate::progress;
use epipole::imaging;
use pyo3::prelude::*;

/// Sums of all pixels above and to the left, in double precision.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
#[pyclass(frozen, eq, module = "epipole.imaging")]
#[derive(PartialEq)]
pub(super) struct IntegralImage(imaging::IntegralImage);

#[pymethods]
impl IntegralImage {
    #[new]
    fn new(image: &Bound<'_, PyAny>) -> PyResult<Self> {
        let image_pixels = gray("image", image)?;
        Ok(Self(progress::detach(image.py(), || {
            imaging::IntegralImage::new(&image_pixels)
        })))
    }

    /// Returns the sum over ``image[v0:v1, u0:u1]``.
    ///
    /// Parameters
    /// ----------
    /// u0, v0, u1, v1 : int
    ///     Columns u0 to u1 - 1 and rows v0 to v1 - 1.
    fn sum(&self, u0: usize, v0: usize, u1: usize, v1: usize) -> f64 {
        self.0.sum(u0, v0, u1, v1)
    }

    /// Returns the mean over ``image[v0:v1, u0:u1]``; 0 if it is empty.
    ///
    /// Parameters
    /// ----------
    /// u0, v0, u1, v1 : int
    ///     Columns u0 to u1 - 1 and rows v0 to v1 - 1.
    fn mean(&self, u0: usize, v0: usize, u1: usize, v1: usize) -> f64 {
        self.0.mean(u0, v0, u1, v1)
    }
}
