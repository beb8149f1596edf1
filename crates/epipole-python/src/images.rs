//! Conversion between NumPy arrays and images.
//!
//! Images are uint8 of shape `(H, W)` or `(H, W, 3)`, or float gray of shape `(H, W)` with black at
//! 0 and white at 1. Objects with `__array_interface__` are converted by `numpy.asarray`.

mod elements;

pub(crate) use elements::{column, dtype, elements, kind, table, wrong_shape};

use crate::arrays::as_array;
use crate::errors::OrRaise;
use crate::{options, progress};
use elements::{finite_elements, first, real_array, shape_text};
use epipole::image::{GrayImage, ImageBuffer, Pixel, RgbImage};
use epipole::imaging::{self, Border, GrayImage32};
use epipole::stereo::DisparityImage;
use numpy::prelude::*;
use numpy::{Element, PyArray1, PyArray2, PyArray3, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Maximum deviation from [0, 1] that counts as the overshoot of a filter.
const OVERSHOOT: f32 = 0.5;

/// Maximum number of pixels of a result; more would exhaust memory.
const MAX_PIXELS: u64 = 1 << 32;

/// Image of any kind.
pub(crate) enum Image {
    /// uint8, shape `(H, W)`.
    Gray8(GrayImage),
    /// uint8, shape `(H, W, 3)`.
    Rgb8(RgbImage),
    /// float, shape `(H, W)`.
    Gray32(GrayImage32),
}

/// Computes an image of the same kind as its input.
macro_rules! same_kind {
    ($image:expr, |$pixels:ident| $run:expr) => {
        match $image {
            $crate::images::Image::Gray8($pixels) => $crate::images::Image::Gray8($run),
            $crate::images::Image::Rgb8($pixels) => $crate::images::Image::Rgb8($run),
            $crate::images::Image::Gray32($pixels) => $crate::images::Image::Gray32($run),
        }
    };
}
pub(crate) use same_kind;

impl Image {
    /// Reads an image.
    ///
    /// # Errors
    /// `TypeError` for an unsupported dtype, `ValueError` for a wrong shape, an empty image, NaN or
    /// infinity.
    pub(crate) fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let array = as_array(name, value, "(H, W) or (H, W, 3)")?;
        let is_bytes = dtype(&array)? == "uint8";
        if !is_bytes && kind(&array) != 'f' {
            return Err(wrong_dtype(name, &array)?);
        }
        let (height, width, is_color) = match *array.shape() {
            [height, width] => (height, width, false),
            [height, width, 3] if is_bytes => (height, width, true),
            [_, _, 3] => {
                return Err(PyValueError::new_err(format!(
                    "{name} must be gray if it is float, but has shape {}; color is uint8",
                    shape_text(&array)?
                )));
            }
            _ => return Err(wrong_shape(name, "(H, W) or (H, W, 3)", &array)?),
        };
        let (width, height) = (side(name, width, &array)?, side(name, height, &array)?);
        Ok(if !is_bytes {
            let values = finite_elements(name, &array, width as usize)?;
            Self::Gray32(filled(width, height, values))
        } else if is_color {
            Self::Rgb8(filled(width, height, elements(&array, "uint8")?))
        } else {
            Self::Gray8(filled(width, height, elements(&array, "uint8")?))
        })
    }

    /// Creates an array of the image's kind.
    pub(crate) fn give<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(match self {
            Self::Gray8(image) => from_gray(py, image)?.into_any(),
            Self::Rgb8(image) => from_rgb(py, image)?.into_any(),
            Self::Gray32(image) => from_gray(py, image)?.into_any(),
        })
    }
}

/// Gray image as floats, and whether it came as bytes, which are divided by 255.
pub(crate) struct Gray {
    /// The gray values.
    pub(crate) pixels: GrayImage32,
    is_bytes: bool,
}

impl Gray {
    /// Reads a gray image.
    ///
    /// # Errors
    /// As [`Image::read`], and `ValueError` for a color image.
    pub(crate) fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        match Image::read(name, value)? {
            Image::Gray8(image) => Ok(Self {
                pixels: imaging::gray_to_f32(&image),
                is_bytes: true,
            }),
            Image::Gray32(pixels) => Ok(Self {
                pixels,
                is_bytes: false,
            }),
            Image::Rgb8(_) => Err(not_gray(name)),
        }
    }

    /// Reads a border, with a constant in the image's own units.
    pub(crate) fn border(&self, border: Option<&Bound<'_, PyAny>>) -> PyResult<Border> {
        let border = match border {
            Some(border) => options::value("border", border)?,
            None => Border::default(),
        };
        Ok(match border {
            Border::Constant(value) if self.is_bytes => Border::Constant(value / 255.0),
            other => other,
        })
    }

    /// Creates an array of a result, with the dtype of the input.
    pub(crate) fn give<'py>(
        &self,
        py: Python<'py>,
        result: GrayImage32,
    ) -> PyResult<Bound<'py, PyAny>> {
        if self.is_bytes {
            let bytes = progress::detach(py, || imaging::gray_to_u8(&result));
            Ok(from_gray(py, bytes)?.into_any())
        } else {
            Ok(from_gray(py, result)?.into_any())
        }
    }
}

/// Reads a gray image with values of any range; uint8 values are divided by 255.
///
/// # Errors
/// As [`Gray::read`].
pub(crate) fn gray(name: &str, value: &Bound<'_, PyAny>) -> PyResult<GrayImage32> {
    Ok(Gray::read(name, value)?.pixels)
}

/// Reads a gray image for functions with thresholds for gray values in [0, 1].
///
/// # Errors
/// As [`Gray::read`], and `ValueError` for values far outside [0, 1].
pub(crate) fn unit_gray(name: &str, value: &Bound<'_, PyAny>) -> PyResult<GrayImage32> {
    let image = gray(name, value)?;
    require_unit(name, &image)?;
    Ok(image)
}

/// Reads a gray image as bytes; floats in [0, 1] are rounded.
///
/// # Errors
/// As [`unit_gray`].
pub(crate) fn gray8(name: &str, value: &Bound<'_, PyAny>) -> PyResult<GrayImage> {
    match Image::read(name, value)? {
        Image::Gray8(image) => Ok(image),
        Image::Gray32(image) => {
            require_unit(name, &image)?;
            Ok(imaging::gray_to_u8(&image))
        }
        Image::Rgb8(_) => Err(not_gray(name)),
    }
}

/// Reads a color image.
///
/// # Errors
/// As [`Image::read`], and `TypeError` or `ValueError` for a gray image.
pub(crate) fn rgb(name: &str, value: &Bound<'_, PyAny>) -> PyResult<RgbImage> {
    match Image::read(name, value)? {
        Image::Rgb8(image) => Ok(image),
        Image::Gray8(_) => Err(PyValueError::new_err(format!(
            "{name} must be a color image of shape (H, W, 3), but is gray"
        ))),
        Image::Gray32(_) => Err(PyTypeError::new_err(format!(
            "{name} must be a uint8 image of shape (H, W, 3), but is float"
        ))),
    }
}

/// Reads numbers of any real dtype on a grid, shape `(H, W)`, without scaling.
///
/// # Errors
/// As [`Image::read`].
pub(crate) fn field(name: &str, value: &Bound<'_, PyAny>) -> PyResult<GrayImage32> {
    let (array, width, height) = grid(name, value)?;
    let values = finite_elements(name, &array, width as usize)?;
    Ok(filled(width, height, values))
}

/// Reads disparities, shape `(H, W)`, NaN where unknown.
///
/// # Errors
/// As [`Image::read`], but NaN is allowed and integers are not.
pub(crate) fn disparity(name: &str, value: &Bound<'_, PyAny>) -> PyResult<DisparityImage> {
    let array = as_array(name, value, "(H, W)")?;
    if kind(&array) != 'f' {
        return Err(PyTypeError::new_err(format!(
            "{name} must be float, in pixels, but its dtype is {}; OpenCV's int16 disparities are \
             16 times the pixels",
            dtype(&array)?
        )));
    }
    let (array, width, height) = grid(name, &array)?;
    DisparityImage::from_raw(width, height, elements(&array, "float32")?).or_raise()
}

/// Returns an array of real numbers of shape `(H, W)`, with W and H.
fn grid<'py>(
    name: &str,
    value: &Bound<'py, PyAny>,
) -> PyResult<(Bound<'py, PyUntypedArray>, u32, u32)> {
    let array = real_array(name, value, "(H, W)")?;
    let [height, width] = *array.shape() else {
        return Err(wrong_shape(name, "(H, W)", &array)?);
    };
    let (width, height) = (side(name, width, &array)?, side(name, height, &array)?);
    Ok((array, width, height))
}

/// Creates an array of shape `(H, W)`.
pub(crate) fn from_gray<P>(
    py: Python<'_>,
    image: ImageBuffer<P, Vec<P::Subpixel>>,
) -> PyResult<Bound<'_, PyArray2<P::Subpixel>>>
where
    P: Pixel<Subpixel: Element>,
{
    let (width, height) = image.dimensions();
    PyArray1::from_vec(py, image.into_raw()).reshape([height as usize, width as usize])
}

/// Creates an array of shape `(H, W, 3)`.
pub(crate) fn from_rgb(py: Python<'_>, image: RgbImage) -> PyResult<Bound<'_, PyArray3<u8>>> {
    let (width, height) = image.dimensions();
    PyArray1::from_vec(py, image.into_raw()).reshape([height as usize, width as usize, 3])
}

/// Creates an array of disparities, shape `(H, W)`, NaN where unknown.
pub(crate) fn from_disparity(
    py: Python<'_>,
    disparity: DisparityImage,
) -> PyResult<Bound<'_, PyArray2<f32>>> {
    from_gray(py, disparity.into_image())
}

/// Rejects results too large to allocate.
///
/// # Errors
/// `ValueError` naming the size.
pub(crate) fn require_size(width: u32, height: u32) -> PyResult<()> {
    if u64::from(width) * u64::from(height) <= MAX_PIXELS {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "width and height must be at most {MAX_PIXELS} pixels together, but are {width} and \
         {height}"
    )))
}

fn filled<P: Pixel>(
    width: u32,
    height: u32,
    values: Vec<P::Subpixel>,
) -> ImageBuffer<P, Vec<P::Subpixel>> {
    ImageBuffer::from_raw(width, height, values).expect("the shape is that of the array")
}

fn side(name: &str, length: usize, array: &Bound<'_, PyUntypedArray>) -> PyResult<u32> {
    match u32::try_from(length) {
        Ok(0) => Err(PyValueError::new_err(format!(
            "{name} has no pixels: its shape is {}",
            shape_text(array)?
        ))),
        Ok(length) => Ok(length),
        Err(_) => Err(PyValueError::new_err(format!("{name} is too large"))),
    }
}

fn require_unit(name: &str, image: &GrayImage32) -> PyResult<()> {
    let range = -OVERSHOOT..=1.0 + OVERSHOOT;
    match first(image.as_raw(), |value| !range.contains(&value)) {
        None => Ok(()),
        Some(place) => Err(PyValueError::new_err(format!(
            "{name} must have gray values in [0, 1], but has {}; divide by the value of white",
            image.as_raw()[place]
        ))),
    }
}

fn not_gray(name: &str) -> PyErr {
    PyValueError::new_err(format!(
        "{name} must be gray, shape (H, W), but is a color image; convert it by \
         epipole.imaging.rgb_to_gray"
    ))
}

fn wrong_dtype(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<PyErr> {
    let dtype = dtype(array)?;
    let advice = match &*dtype {
        "uint16" => "; divide by 65535 for floats in [0, 1]",
        "bool" => "; convert it by astype(float)",
        _ => "",
    };
    Ok(PyTypeError::new_err(format!(
        "{name} must be uint8 or float, but its dtype is {dtype}{advice}"
    )))
}
