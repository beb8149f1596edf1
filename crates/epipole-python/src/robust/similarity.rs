//! Similarities of the plane.

use super::{RansacReport, estimator, give_object};
use crate::arrays::{Batch, from_matrix, pixel_pairs};
use crate::errors::OrRaise;
use crate::record::record;
use epipole::nalgebra::Point2;
use epipole::robust;
use numpy::PyArray2;
use pyo3::prelude::*;

record! {
    /// Rotation, scale and shift in the plane: ``u' = a*u - b*v + tu``, ``v' = b*u + a*v + tv``.
    "epipole.robust" PlaneSimilarity {
        /// Scale times the cosine of the rotation angle.
        a: f64,
        /// Scale times the sine of the rotation angle.
        b: f64,
        /// Shift along u, pixels.
        tu: f64,
        /// Shift along v, pixels.
        tv: f64,
    }
}

impl PlaneSimilarity {
    pub(super) fn core(&self) -> robust::PlaneSimilarity {
        robust::PlaneSimilarity {
            a: self.a,
            b: self.b,
            tu: self.tu,
            tv: self.tv,
        }
    }
}

impl From<robust::PlaneSimilarity> for PlaneSimilarity {
    fn from(s: robust::PlaneSimilarity) -> Self {
        Self {
            a: s.a,
            b: s.b,
            tu: s.tu,
            tv: s.tv,
        }
    }
}

#[pymethods]
impl PlaneSimilarity {
    /// Maps points.
    ///
    /// Parameters
    /// ----------
    /// p : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray of the same shape
    fn apply<'py>(&self, p: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let similarity = self.core();
        let apply = |p: &_| Ok(similarity.apply(&Point2::from(*p)).coords);
        Batch::<2>::read("p", p)?.vectors(p.py(), apply)
    }

    /// Returns the scale.
    fn scale(&self) -> f64 {
        self.core().scale()
    }

    /// Returns the rotation angle from u towards v, radians.
    fn angle_rad(&self) -> f64 {
        self.core().angle_rad()
    }

    /// Returns the homogeneous matrix, shape (3, 3).
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.core().matrix())
    }
}

/// Fits a similarity to matches by least squares, without outliers.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, N >= 2.
///
/// Returns
/// -------
/// PlaneSimilarity
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 matches.
/// epipole.DegenerateError
///     If all points of image 1 are equal.
/// ValueError
///     If a coordinate is beyond 1e9 pixels.
///
/// Examples
/// --------
/// >>> fit_similarity([[0, 0], [1, 0]], [[3, 1], [3, 3]]).scale()
/// 2.0
#[pyfunction]
pub(super) fn fit_similarity(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
) -> PyResult<PlaneSimilarity> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    Ok(robust::fit_similarity(&first, &second).or_raise()?.into())
}

estimator! {
    /// Estimates a similarity from matches with outliers, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of PlaneSimilarity
    ///     Its model is a `PlaneSimilarity`.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 different matches.
    /// epipole.NoConsensusError
    ///     If no similarity has 2 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_similarity(pixels1, pixels2) -> PyResult<RansacReport> {
        robust::estimate_similarity, give_object::<_, PlaneSimilarity>
    }
}
