//! Structure tensor and shifts of one window.

use crate::arrays::{vector, vectors};
use crate::errors::OrRaise;
use crate::images::{Gray, gray};
use crate::options;
use crate::record::record;
use epipole::feature;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Matrix ``M = sum [[Iu*Iu, Iu*Iv], [Iu*Iv, Iv*Iv]]`` of one window.
    "epipole.feature" WindowTensor {
        /// ``sum Iu*Iu``.
        uu: f64,
        /// ``sum Iu*Iv``.
        uv: f64,
        /// ``sum Iv*Iv``.
        vv: f64,
    }
}

impl From<feature::WindowTensor> for WindowTensor {
    fn from(tensor: feature::WindowTensor) -> Self {
        Self {
            uu: tensor.uu,
            uv: tensor.uv,
            vv: tensor.vv,
        }
    }
}

impl WindowTensor {
    fn core(&self) -> feature::WindowTensor {
        feature::WindowTensor {
            uu: self.uu,
            uv: self.uv,
            vv: self.vv,
        }
    }
}

#[pymethods]
impl WindowTensor {
    /// Computes the tensor from the gradients (Iu, Iv) of a window's pixels.
    ///
    /// Parameters
    /// ----------
    /// gradients : array_like, shape (N, 2)
    #[staticmethod]
    fn from_gradients(gradients: &Bound<'_, PyAny>) -> PyResult<Self> {
        let gradients = vectors::<2>("gradients", gradients)?;
        Ok(feature::WindowTensor::from_gradients(&gradients).into())
    }

    /// Computes the tensor at one pixel of an image, equal to that of `structure_tensor`.
    ///
    /// Parameters
    /// ----------
    /// image : array_like, shape (H, W)
    ///     Gray; uint8 values are divided by 255.
    /// pixel : tuple of int
    ///     Column and row.
    /// **options : StructureTensorOptions
    ///     See `structure_tensor`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the pixel is outside the image, a box window is outside 1 to 255 pixels, or a
    ///     Gaussian window is outside (0, 31].
    #[staticmethod]
    #[pyo3(signature = (image, pixel, **options))]
    fn at(
        image: &Bound<'_, PyAny>,
        pixel: (u32, u32),
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let (pixels, options) = (gray("image", image)?, options::read(options)?);
        let tensor = feature::WindowTensor::at(&pixels, pixel, &options).or_raise()?;
        Ok(tensor.into())
    }

    /// Returns the product of the eigenvalues.
    fn determinant(&self) -> f64 {
        self.core().determinant()
    }

    /// Returns the sum of the eigenvalues.
    fn trace(&self) -> f64 {
        self.core().trace()
    }

    /// Returns the eigenvalues, the larger first.
    fn eigenvalues(&self) -> (f64, f64) {
        self.core().eigenvalues()
    }

    /// Returns the direction of the larger eigenvalue, ``arctan2(v, u)`` with v down, radians.
    fn direction_rad(&self) -> f64 {
        self.core().direction_rad()
    }

    /// Returns the Harris response ``det M - k * trace(M)**2``.
    ///
    /// Parameters
    /// ----------
    /// k : float
    ///     Weight of the squared trace, such as 0.04.
    fn harris(&self, k: f64) -> f64 {
        self.core().harris(k)
    }

    /// Approximates the squared change of the window under a small shift.
    ///
    /// Parameters
    /// ----------
    /// shift : array_like, shape (2,)
    ///     Pixels.
    fn change(&self, shift: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.core().change(&vector::<2>("shift", shift)?))
    }
}

record! {
    /// Squared change of a window under integer shifts up to a maximum.
    "epipole.feature" ShiftSurface {
        /// Squared change under the shift (du, dv) at ``[reach + dv, reach + du]``, shape
        /// (2 * reach + 1, 2 * reach + 1).
        values: Py<PyArray2<f64>>,
    }
}

#[pymethods]
impl ShiftSurface {
    /// Maximum shift to each side, pixels.
    #[getter]
    fn reach(&self, py: Python<'_>) -> usize {
        self.values.bind(py).shape()[0] / 2
    }

    /// Returns the squared change for a shift (`du`, `dv`); None beyond the reach.
    ///
    /// Parameters
    /// ----------
    /// du, dv : int
    ///     Shift along columns and rows, pixels.
    fn at(&self, py: Python<'_>, du: i32, dv: i32) -> Option<f64> {
        let reach = i32::try_from(self.reach(py)).ok()?;
        let place = |shift: i32| usize::try_from(shift.checked_add(reach)?).ok();
        self.values.bind(py).get_owned([place(dv)?, place(du)?])
    }
}

/// Computes the squared change of a window of an image under shifts.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// center : tuple of int
///     Column and row of the window's center.
/// half_window : int
///     The window is ``2 * half_window + 1`` pixels wide; at most 127.
/// reach : int
///     Maximum shift to each side, pixels, at most 127.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// ShiftSurface
///
/// Raises
/// ------
/// ValueError
///     If ``center`` is outside the image, or ``half_window`` or ``reach`` is above 127.
#[pyfunction]
#[pyo3(signature = (image, center, half_window, reach, border=None))]
pub(super) fn shift_surface(
    image: &Bound<'_, PyAny>,
    center: (u32, u32),
    half_window: usize,
    reach: usize,
    border: Option<&Bound<'_, PyAny>>,
) -> PyResult<ShiftSurface> {
    let py = image.py();
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let surface = feature::shift_surface(&gray.pixels, center, half_window, reach, border);
    let surface = surface.or_raise()?;
    let shifts = |reach: usize| -(reach as i32)..=reach as i32;
    let mut values = Vec::new();
    for dv in shifts(surface.reach()) {
        values.extend(shifts(surface.reach()).filter_map(|du| surface.at(du, dv)));
    }
    let side = 2 * surface.reach() + 1;
    Ok(ShiftSurface {
        values: PyArray1::from_vec(py, values)
            .reshape([side, side])?
            .unbind(),
    })
}
