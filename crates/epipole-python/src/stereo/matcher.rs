//! Dense matchers: classes with the library's options as attributes.

use crate::images::{Image, from_disparity};
use crate::{options, progress};
use epipole::image::GrayImage;
use epipole::imaging::GrayImage32;
use epipole::progress::Monitor;
use epipole::stereo::{self, DisparityImage};
use numpy::PyArray2;
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use pythonize::pythonize;
use serde::Serialize;

/// Dense matcher of the library.
pub(super) trait Matcher: Sync {
    /// Computes disparities from bytes.
    fn bytes(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        monitor: &mut dyn Monitor,
    ) -> epipole::Result<DisparityImage>;

    /// Computes disparities from floats.
    fn floats(
        &self,
        left: &GrayImage32,
        right: &GrayImage32,
        monitor: &mut dyn Monitor,
    ) -> epipole::Result<DisparityImage>;
}

/// Runs a matcher on two arrays of equal dtype.
fn compute<'py>(
    matcher: &impl Matcher,
    left: &Bound<'py, PyAny>,
    right: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let py = left.py();
    let disparity = match (Image::read("left", left)?, Image::read("right", right)?) {
        (Image::Gray8(left), Image::Gray8(right)) => progress::run(py, progress, |monitor| {
            matcher.bytes(&left, &right, monitor)
        }),
        (Image::Gray32(left), Image::Gray32(right)) => progress::run(py, progress, |monitor| {
            matcher.floats(&left, &right, monitor)
        }),
        (Image::Rgb8(_), _) | (_, Image::Rgb8(_)) => Err(PyTypeError::new_err(
            "left and right must be gray, but are color images; convert them by \
             epipole.imaging.rgb_to_gray",
        )),
        _ => Err(PyTypeError::new_err(
            "left and right must be both uint8 or both float",
        )),
    };
    from_disparity(py, disparity?)
}

/// Returns options as a dictionary.
fn fields<'py>(py: Python<'py>, options: &impl Serialize) -> PyResult<Bound<'py, PyDict>> {
    Ok(pythonize(py, options)?.cast_into::<PyDict>()?)
}

/// Defines the class of a matcher: keyword constructor, attributes, equality, pickling, `compute`.
macro_rules! matcher {
    ($(#[doc = $doc:literal])* $class:ident) => {
        $(#[doc = $doc])*
        #[pyclass(frozen, eq, module = "epipole.stereo")]
        #[derive(PartialEq)]
        pub(super) struct $class(pub(super) stereo::$class);

        impl Matcher for stereo::$class {
            fn bytes(
                &self,
                left: &GrayImage,
                right: &GrayImage,
                monitor: &mut dyn Monitor,
            ) -> epipole::Result<DisparityImage> {
                self.compute(left, right, monitor)
            }

            fn floats(
                &self,
                left: &GrayImage32,
                right: &GrayImage32,
                monitor: &mut dyn Monitor,
            ) -> epipole::Result<DisparityImage> {
                self.compute_f32(left, right, monitor)
            }
        }

        #[pymethods]
        impl $class {
            #[new]
            #[pyo3(signature = (**options))]
            fn new(options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
                Ok(Self(options::read(options)?))
            }

            /// Computes disparities ``u_left - u_right`` of the pixels of `left`.
            ///
            /// Parameters
            /// ----------
            /// left, right : array_like, shape (H, W)
            ///     Rectified gray images whose matches share a row. Both uint8, or both float with
            ///     any range; their minimum and maximum are mapped to 0 and 255.
            /// progress : callable, optional
            ///     Called with the stage and the completed fraction.
            ///
            /// Returns
            /// -------
            /// ndarray of float32, shape (H, W)
            ///     Pixels; NaN where unknown.
            ///
            /// Raises
            /// ------
            /// ValueError
            ///     If an option is out of range, or the volume (pixels × disparities) is too large
            ///     for memory.
            #[pyo3(signature = (left, right, *, progress=None))]
            fn compute<'py>(
                &self,
                left: &Bound<'py, PyAny>,
                right: &Bound<'py, PyAny>,
                progress: Option<Py<PyAny>>,
            ) -> PyResult<Bound<'py, PyArray2<f32>>> {
                compute(&self.0, left, right, progress)
            }

            fn __getattr__<'py>(
                &self,
                name: &Bound<'py, PyString>,
            ) -> PyResult<Bound<'py, PyAny>> {
                match fields(name.py(), &self.0)?.get_item(name)? {
                    Some(value) => Ok(value),
                    None => Err(PyAttributeError::new_err(format!(
                        concat!(stringify!($class), " has no attribute {}"),
                        name
                    ))),
                }
            }

            fn __dir__<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<Bound<'py, PyAny>>> {
                let object = slf.py().get_type::<PyAny>();
                let inherited = object.call_method1("__dir__", (slf,))?;
                let mut names: Vec<Bound<'py, PyAny>> = inherited.extract()?;
                names.extend(fields(slf.py(), &slf.get().0)?.keys());
                Ok(names)
            }

            fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
                let mut parts = Vec::new();
                for (name, value) in fields(py, &self.0)? {
                    parts.push(format!("{name}={}", value.repr()?));
                }
                Ok(format!("{}({})", stringify!($class), parts.join(", ")))
            }

            fn __getnewargs_ex__<'py>(
                &self,
                py: Python<'py>,
            ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
                Ok((PyTuple::empty(py), fields(py, &self.0)?))
            }
        }
    };
}

matcher! {
    /// Fast dense stereo of a rectified pair by block matching.
    ///
    /// Parameters
    /// ----------
    /// **options : StereoBm
    ///     For example ``num_disparities``, ``min_disparity_px``, ``window_px`` (odd), and
    ///     ``filter``, a dict with entries such as ``"speckle_size"``. ``StereoBm()`` shows all
    ///     options with their defaults.
    StereoBm
}

matcher! {
    /// Dense stereo of a rectified pair by semi-global matching.
    ///
    /// Parameters
    /// ----------
    /// **options : StereoSgm
    ///     For example ``num_disparities``, ``min_disparity_px``, ``paths`` ("four", "five",
    ///     "eight"), and ``filter``, a dict with entries such as ``"speckle_size"``.
    ///     ``StereoSgm()`` shows all options with their defaults.
    StereoSgm
}
