//! NumPy images to images of the library, and back.
//!
//! uint8 images range from 0 to 255, float images from 0 to 1.

use crate::arrays::as_array;
use epipole::image::{GrayImage, RgbImage};
use epipole::imaging::{
    BT601_WEIGHTS, GrayImage32, gray_to_f32, gray_to_u8, rgb_to_gray, rgb_to_gray_f32,
};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Shapes in messages.
const SHAPES: &str = "(H, W) or (H, W, 3)";

/// An image as the caller gave it.
pub(crate) enum Image {
    /// uint8, shape `(H, W)`.
    Gray(GrayImage),
    /// uint8, shape `(H, W, 3)`.
    Rgb(RgbImage),
    /// float, shape `(H, W)`, or the gray of `(H, W, 3)`.
    Float(GrayImage32),
}

impl Image {
    /// Reads a uint8 or float image of shape `(H, W)` or `(H, W, 3)`.
    ///
    /// # Errors
    /// `TypeError` for another dtype, `ValueError` for another shape, NaN or infinity; both name
    /// the argument.
    pub(crate) fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let array = as_array(name, value, SHAPES)?;
        let (height, width, channels) = match *array.shape() {
            [height, width] => (height, width, 1),
            [height, width, 3] => (height, width, 3),
            _ => {
                let shape = PyTuple::new(value.py(), array.shape())?.repr()?;
                return Err(PyValueError::new_err(format!(
                    "{name} must be an image of shape {SHAPES}, but has shape {shape}"
                )));
            }
        };
        let size = u32::try_from(width).ok().zip(u32::try_from(height).ok());
        let too_large = || PyValueError::new_err(format!("{name} is too large"));
        let (width, height) = size.ok_or_else(too_large)?;
        if let Ok(bytes) = array.cast::<PyArrayDyn<u8>>() {
            let bytes = bytes.readonly().as_array().iter().copied().collect();
            let image = match channels {
                1 => GrayImage::from_raw(width, height, bytes).map(Self::Gray),
                _ => RgbImage::from_raw(width, height, bytes).map(Self::Rgb),
            };
            return image.ok_or_else(too_large);
        }
        if u8::from(array.dtype().kind()) != b'f' {
            let dtype: String = array.dtype().getattr("name")?.extract()?;
            return Err(PyTypeError::new_err(format!(
                "{name} must be an image of uint8 or floats, but its dtype is {dtype}"
            )));
        }
        let floats = array.call_method1("astype", ("float32",))?;
        let floats = floats.cast_into::<PyArrayDyn<f32>>()?;
        let mut floats: Vec<f32> = floats.readonly().as_array().iter().copied().collect();
        if floats.iter().any(|value| !value.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "{name} contains NaN or infinity"
            )));
        }
        if channels == 3 {
            let [r, g, b] = BT601_WEIGHTS;
            let gray = |c: &[f32]| r * c[0] + g * c[1] + b * c[2];
            floats = floats.chunks_exact(3).map(gray).collect();
        }
        GrayImage32::from_raw(width, height, floats)
            .map(Self::Float)
            .ok_or_else(too_large)
    }

    /// Gray floats.
    pub(crate) fn into_gray32(self) -> GrayImage32 {
        match self {
            Self::Gray(image) => gray_to_f32(&image),
            Self::Rgb(image) => rgb_to_gray_f32(&image, &BT601_WEIGHTS),
            Self::Float(image) => image,
        }
    }

    /// Gray bytes.
    pub(crate) fn into_gray(self) -> GrayImage {
        match self {
            Self::Gray(image) => image,
            Self::Rgb(image) => rgb_to_gray(&image),
            Self::Float(image) => gray_to_u8(&image),
        }
    }
}

/// float32 array of shape `(H, W)`.
pub(crate) fn from_gray32<'py>(
    py: Python<'py>,
    image: GrayImage32,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let shape = [image.height() as usize, image.width() as usize];
    PyArray1::from_vec(py, image.into_raw()).reshape(shape)
}

/// uint8 array of shape `(H, W)`.
pub(crate) fn from_gray<'py>(
    py: Python<'py>,
    image: GrayImage,
) -> PyResult<Bound<'py, PyArray2<u8>>> {
    let shape = [image.height() as usize, image.width() as usize];
    PyArray1::from_vec(py, image.into_raw()).reshape(shape)
}

/// uint8 array of shape `(H, W, 3)`.
pub(crate) fn from_rgb<'py>(
    py: Python<'py>,
    image: RgbImage,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let shape = [image.height() as usize, image.width() as usize, 3];
    PyArray1::from_vec(py, image.into_raw()).reshape(shape)
}
