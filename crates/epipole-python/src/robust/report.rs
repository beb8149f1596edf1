//! Report of a robust estimation.

use crate::record::record;
use epipole::robust::{self, StopReason};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyType;

record! {
    /// Result of a robust estimation.
    "epipole.robust" RansacReport {
        /// Best model.
        model: Py<PyAny>,
        /// Whether each data point is an inlier, boolean array of shape (N,).
        inliers: Py<PyArray1<bool>>,
        /// Number of inliers.
        num_inliers: usize,
        /// Number of unique inliers, which is the support of the model.
        num_unique_inliers: usize,
        /// Number of data points ignored because a coordinate is infinite or beyond 1e9 pixels.
        num_left_out: usize,
        /// Number of samples drawn.
        iterations: usize,
        /// Number of samples required at the final inlier ratio.
        required_iterations: u64,
        /// Inlier threshold, pixels.
        max_error_px: f64,
        /// Score of the model.
        score: f64,
        /// Expected number of models with this support by chance, as log10; None if unknown.
        log10_false_alarms: Option<f64>,
        /// Number of times a model was refined from its inliers.
        refinements: usize,
        /// Reason the search ended: "confident", "exhausted" or "interrupted".
        stop: String,
    }
}

#[pymethods]
impl RansacReport {
    /// Supports ``RansacReport[RelativePose]`` in annotations.
    #[classmethod]
    fn __class_getitem__(cls: &Bound<'_, PyType>, model: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        alias(cls, model)
    }

    /// Whether unrelated data might have this much support: the model is then not significant.
    fn could_be_random(&self) -> bool {
        let report = robust::RansacReport {
            model: (),
            inliers: Vec::new(),
            num_inliers: self.num_inliers,
            num_unique_inliers: self.num_unique_inliers,
            num_left_out: self.num_left_out,
            iterations: self.iterations,
            required_iterations: self.required_iterations,
            max_error_px: self.max_error_px,
            score: self.score,
            log10_false_alarms: self.log10_false_alarms,
            refinements: self.refinements,
            stop: StopReason::Confident,
        };
        report.could_be_random()
    }
}

/// Returns the generic alias of a class with its model type.
pub(super) fn alias(class: &Bound<'_, PyType>, model: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
    let types = class.py().import("types")?;
    Ok(types.call_method1("GenericAlias", (class, model))?.unbind())
}

/// Returns the name of the reason.
pub(crate) fn stop_reason(stop: StopReason) -> String {
    let name = match stop {
        StopReason::Confident => "confident",
        StopReason::Exhausted => "exhausted",
        StopReason::Interrupted => "interrupted",
    };
    name.to_owned()
}

impl RansacReport {
    /// Converts the report to Python objects.
    pub(super) fn give<'py, M>(
        py: Python<'py>,
        report: robust::RansacReport<M>,
        model: impl FnOnce(M) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        Ok(Self {
            model: model(report.model)?.unbind(),
            inliers: PyArray1::from_vec(py, report.inliers).unbind(),
            num_inliers: report.num_inliers,
            num_unique_inliers: report.num_unique_inliers,
            num_left_out: report.num_left_out,
            iterations: report.iterations,
            required_iterations: report.required_iterations,
            max_error_px: report.max_error_px,
            score: report.score,
            log10_false_alarms: report.log10_false_alarms,
            refinements: report.refinements,
            stop: stop_reason(report.stop),
        })
    }
}
