//! Robust estimations without the GIL, with Python objects as models.

use super::RansacReport;
use crate::arrays::from_matrix;
use crate::progress;
use epipole::nalgebra::Matrix3;
use epipole::progress::Monitor;
use epipole::robust::{self, RansacOptions};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Runs a robust estimation and converts its report to Python objects.
///
/// * `give`: converts a model to a Python object
///
/// # Errors
/// As [`progress::run_with`].
pub(crate) fn estimate<'py, M: Send>(
    py: Python<'py>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
    give: impl FnOnce(Python<'py>, M) -> PyResult<Bound<'py, PyAny>>,
    work: impl FnOnce(&RansacOptions, &mut dyn Monitor) -> epipole::Result<robust::RansacReport<M>>
    + Send,
) -> PyResult<RansacReport> {
    let report = progress::run_with(py, progress, options, work)?;
    RansacReport::give(py, report, |model| give(py, model))
}

/// Converts a model that is a matrix.
pub(crate) fn give_matrix(py: Python<'_>, model: Matrix3<f64>) -> PyResult<Bound<'_, PyAny>> {
    Ok(from_matrix(py, &model)?.into_any())
}

/// Converts a model to an object of class `C`.
pub(crate) fn give_object<'py, M, C>(py: Python<'py>, model: M) -> PyResult<Bound<'py, PyAny>>
where
    C: From<M> + IntoPyObject<'py>,
{
    C::from(model).into_bound_py_any(py)
}

/// Defines the Python function of an estimator for matches, of calibrated cameras or not.
///
/// * `estimate`: function of the library
/// * `give`: converts a model to a Python object
macro_rules! estimator {
    (
        $(#[doc = $doc:literal])*
        fn $name:ident(pixels1, pixels2) -> $result:ty { $estimate:path, $give:expr }
    ) => {
        $(#[doc = $doc])*
        #[pyfunction]
        #[pyo3(signature = (pixels1, pixels2, *, progress=None, **options))]
        pub(crate) fn $name(
            pixels1: &Bound<'_, PyAny>,
            pixels2: &Bound<'_, PyAny>,
            progress: Option<Py<PyAny>>,
            options: Option<&Bound<'_, pyo3::types::PyDict>>,
        ) -> $result {
            let py = pixels1.py();
            let [first, second] = $crate::arrays::pixel_pairs(pixels1, pixels2)?;
            $crate::robust::estimate(py, progress, options, $give, |options, monitor| {
                $estimate(&first, &second, options, monitor)
            })
        }
    };
    (
        $(#[doc = $doc:literal])*
        fn $name:ident(pixels1, pixels2, camera1, camera2) -> $result:ty {
            $estimate:path, $give:expr
        }
    ) => {
        $(#[doc = $doc])*
        #[pyfunction]
        #[pyo3(signature = (pixels1, pixels2, camera1, camera2, *, progress=None, **options))]
        pub(crate) fn $name(
            pixels1: &Bound<'_, PyAny>,
            pixels2: &Bound<'_, PyAny>,
            camera1: &$crate::camera::Camera,
            camera2: &$crate::camera::Camera,
            progress: Option<Py<PyAny>>,
            options: Option<&Bound<'_, pyo3::types::PyDict>>,
        ) -> $result {
            let py = pixels1.py();
            let [first, second] = $crate::arrays::pixel_pairs(pixels1, pixels2)?;
            let cameras = [&camera1.0, &camera2.0];
            $crate::robust::estimate(py, progress, options, $give, |options, monitor| {
                $estimate(&first, &second, cameras, options, monitor)
            })
        }
    };
}

pub(crate) use estimator;
