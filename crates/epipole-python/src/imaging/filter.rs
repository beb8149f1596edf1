//! Filters with small kernels.

use crate::errors::OrRaise;
use crate::images::{Gray, column, field, from_gray};
use crate::progress;
use epipole::imaging;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

/// Correlates an image with a kernel, which is not flipped.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// kernel : array_like, shape (K, L)
///     Weights, with odd side lengths.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///
/// Raises
/// ------
/// ValueError
///     If a side of the kernel is even.
#[pyfunction]
#[pyo3(signature = (image, kernel, border=None, *, progress=None))]
pub(super) fn correlate<'py>(
    image: &Bound<'py, PyAny>,
    kernel: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let gray = Gray::read("image", image)?;
    let kernel = field("kernel", kernel)?;
    let border = gray.border(border)?;
    let result = progress::run(image.py(), progress, |monitor| {
        imaging::correlate(&gray.pixels, &kernel, border, monitor)
    });
    from_gray(image.py(), result?)
}

/// Correlates an image with ``np.outer(kernel_v, kernel_u)``, which is not flipped.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// kernel_u, kernel_v : array_like, shape (K,)
///     Weights along the rows and along the columns, an odd number each.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///
/// Raises
/// ------
/// ValueError
///     If the length of the kernel is even.
#[pyfunction]
#[pyo3(signature = (image, kernel_u, kernel_v, border=None, *, progress=None))]
pub(super) fn separable_filter<'py>(
    image: &Bound<'py, PyAny>,
    kernel_u: &Bound<'py, PyAny>,
    kernel_v: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let gray = Gray::read("image", image)?;
    let (along_u, along_v) = (column("kernel_u", kernel_u)?, column("kernel_v", kernel_v)?);
    let border = gray.border(border)?;
    let result = progress::run(image.py(), progress, |monitor| {
        imaging::separable_filter(&gray.pixels, &along_u, &along_v, border, monitor)
    });
    from_gray(image.py(), result?)
}

/// Computes the noise gain of a filter: standard deviation of its response to unit white noise.
///
/// Parameters
/// ----------
/// weights : array_like, shape (N,)
///
/// Returns
/// -------
/// float
#[pyfunction]
pub(super) fn noise_gain(weights: &Bound<'_, PyAny>) -> PyResult<f64> {
    Ok(imaging::noise_gain(&column("weights", weights)?))
}

/// Samples a Gaussian, with a sum of 1.
///
/// Parameters
/// ----------
/// sigma_px : float
///     Standard deviation, pixels, in (0, 1000].
/// size : int
///     Odd number of samples.
///
/// Returns
/// -------
/// ndarray of float32, shape (size,)
///
/// Raises
/// ------
/// ValueError
///     If ``sigma_px`` is outside (0, 1000], or ``size`` is even or above 20001.
///
/// Examples
/// --------
/// >>> [round(float(sample), 4) for sample in gaussian_kernel(1.0, 3)]
/// [0.2741, 0.4519, 0.2741]
#[pyfunction]
pub(super) fn gaussian_kernel(
    py: Python<'_>,
    sigma_px: f64,
    size: usize,
) -> PyResult<Bound<'_, PyArray1<f32>>> {
    let kernel = imaging::gaussian_kernel(sigma_px, size).or_raise()?;
    Ok(PyArray1::from_vec(py, kernel))
}

/// Returns the kernels of `gaussian_derivative`: a Gaussian and its derivative.
///
/// Parameters
/// ----------
/// sigma_px : float
///     Standard deviation, pixels, in (0, 1000].
///
/// Returns
/// -------
/// smooth, slope : ndarray of float32, shape (N,)
///     ``smooth`` sums to 1; ``slope`` has the response 1 to a ramp of slope 1.
///
/// Raises
/// ------
/// ValueError
///     If ``sigma_px`` is outside (0, 1000].
#[pyfunction]
#[allow(clippy::type_complexity)]
pub(super) fn gaussian_derivative_kernels(
    py: Python<'_>,
    sigma_px: f64,
) -> PyResult<(Bound<'_, PyArray1<f32>>, Bound<'_, PyArray1<f32>>)> {
    let (smooth, slope) = imaging::gaussian_derivative_kernels(sigma_px).or_raise()?;
    Ok((
        PyArray1::from_vec(py, smooth),
        PyArray1::from_vec(py, slope),
    ))
}

/// Blurs an image by a Gaussian, truncated at about 4 sigma.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// sigma_px : float
///     Standard deviation, pixels, in (0, 1000].
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (H, W)
///     uint8 for a uint8 image, else float32.
///
/// Raises
/// ------
/// ValueError
///     If ``sigma_px`` is outside (0, 1000].
#[pyfunction]
#[pyo3(signature = (image, sigma_px, border=None, *, progress=None))]
pub(super) fn gaussian_blur<'py>(
    image: &Bound<'py, PyAny>,
    sigma_px: f64,
    border: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let blurred = progress::run(image.py(), progress, |monitor| {
        imaging::gaussian_blur(&gray.pixels, sigma_px, border, monitor)
    });
    gray.give(image.py(), blurred?)
}

/// Computes the mean of the ``size x size`` window around each pixel.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// size : int
///     Odd number of pixels, at most 1001.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (H, W)
///     uint8 for a uint8 image, else float32.
///
/// Raises
/// ------
/// ValueError
///     If ``size`` is even or above 1001.
#[pyfunction]
#[pyo3(signature = (image, size, border=None, *, progress=None))]
pub(super) fn box_filter<'py>(
    image: &Bound<'py, PyAny>,
    size: usize,
    border: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let mean = progress::run(image.py(), progress, |monitor| {
        imaging::box_filter(&gray.pixels, size, border, monitor)
    });
    gray.give(image.py(), mean?)
}
