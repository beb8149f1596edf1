//! Robust estimations without the GIL, with Python objects as models.

use super::RansacReport;
use crate::arrays::{self, from_matrix, pixel_pairs};
use crate::errors::OrRaise;
use crate::{options, progress};
use epipole::nalgebra::{Matrix3, Point2};
use epipole::optim::RobustLoss;
use epipole::progress::Monitor;
use epipole::robust::{self, RansacOptions};
use numpy::PyArray2;
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

/// Reads the arguments `pixels1` and `pixels2`, and runs a robust estimation as [`estimate`] does.
pub(crate) fn estimate_matches<'py, M: Send>(
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
    give: impl FnOnce(Python<'py>, M) -> PyResult<Bound<'py, PyAny>>,
    work: impl FnOnce(
        &[Point2<f64>],
        &[Point2<f64>],
        &RansacOptions,
        &mut dyn Monitor,
    ) -> epipole::Result<robust::RansacReport<M>>
    + Send,
) -> PyResult<RansacReport> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    estimate(pixels1.py(), progress, options, give, |options, monitor| {
        work(&first, &second, options, monitor)
    })
}

/// Refines the matrix of two views from the arguments `pixels1` and `pixels2`.
pub(crate) fn refine_matrix<'py>(
    (name, matrix): (&str, &Bound<'py, PyAny>),
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
    loss: Option<&Bound<'py, PyAny>>,
    refine: impl FnOnce(
        &Matrix3<f64>,
        &[Point2<f64>],
        &[Point2<f64>],
        RobustLoss,
    ) -> epipole::Result<Matrix3<f64>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let initial = arrays::matrix(name, matrix)?;
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let loss = options::loss(loss)?;
    let refined = refine(&initial, &first, &second, loss).or_raise()?;
    from_matrix(matrix.py(), &refined)
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

/// Defines the Python function of an estimator for matches between calibrated cameras.
///
/// * `estimate`: function of the library
/// * `give`: converts a model to a Python object
macro_rules! calibrated_estimator {
    ($(#[doc = $doc:literal])* $name:ident: $estimate:path, $give:expr) => {
        $(#[doc = $doc])*
        #[pyfunction]
        #[pyo3(signature = (pixels1, pixels2, camera1, camera2, *, progress=None, **options))]
        pub(crate) fn $name(
            pixels1: &Bound<'_, PyAny>,
            pixels2: &Bound<'_, PyAny>,
            camera1: &$crate::camera::Camera,
            camera2: &$crate::camera::Camera,
            progress: Option<Py<PyAny>>,
            options: Option<&Bound<'_, PyDict>>,
        ) -> PyResult<$crate::robust::RansacReport> {
            let cameras = [&camera1.0, &camera2.0];
            $crate::robust::estimate_matches(
                pixels1,
                pixels2,
                progress,
                options,
                $give,
                |first, second, options, monitor| {
                    $estimate(first, second, cameras, options, monitor)
                },
            )
        }
    };
}

pub(crate) use calibrated_estimator;
