//! Minimal and linear solvers, and refinement.

use super::relative_pose::{EssentialWithFocal, RelativePose};
use crate::arrays::{
    exact_points, exactly, from_matrices, from_matrix, matrix, pixel_pairs, vector, vectors,
};
use crate::camera::{Camera, RigidTransform};
use crate::errors::OrRaise;
use crate::options;
use crate::record::record;
use epipole::epipolar;
use epipole::nalgebra::Point2;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;

record! {
    /// Fundamental matrix by the eight-point method, with intermediate results.
    "epipole.epipolar" EightPoint {
        /// F of rank 2, shape (3, 3).
        fundamental: Py<PyArray2<f64>>,
        /// Least-squares solution before its rank is reduced to 2, shape (3, 3).
        full_rank: Py<PyArray2<f64>>,
        /// Singular values of the linear system, largest first, shape (9,).
        singular_values: Py<PyArray1<f64>>,
        /// Ratio of the largest to the eighth singular value: amplification of data errors.
        condition_number: f64,
    }
}

fn eight_point(py: Python<'_>, found: &epipolar::EightPoint) -> PyResult<EightPoint> {
    Ok(EightPoint {
        fundamental: from_matrix(py, &found.fundamental)?.unbind(),
        full_rank: from_matrix(py, &found.full_rank)?.unbind(),
        singular_values: PyArray1::from_slice(py, &found.singular_values).unbind(),
        condition_number: found.condition_number,
    })
}

/// Computes the fundamental matrices of seven matches.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (7, 2)
///
/// Returns
/// -------
/// ndarray, shape (K, 3, 3)
///     K <= 3, and 0 for a degenerate sample.
#[pyfunction]
pub(super) fn fundamental_7point<'py>(
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let first = exact_points("pixels1", pixels1)?;
    let second = exact_points("pixels2", pixels2)?;
    from_matrices(pixels1.py(), &epipolar::fundamental_7point(&first, &second))
}

/// Fits a fundamental matrix by the normalized eight-point method, without outliers.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, N >= 8.
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 8 matches.
/// epipole.DegenerateError
///     If the matches do not determine F: on a plane or a line, equal, or from a camera that only
///     rotated.
#[pyfunction]
pub(super) fn fundamental_8point<'py>(
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let f = epipolar::fundamental_8point(&first, &second).or_raise()?;
    from_matrix(pixels1.py(), &f)
}

/// Returns the result of `fundamental_8point` with intermediate results.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, N >= 8.
///
/// Returns
/// -------
/// EightPoint
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 8 matches.
/// epipole.DegenerateError
///     If the matches do not determine F: on a plane or a line, equal, or from a camera that only
///     rotated.
#[pyfunction]
pub(super) fn fundamental_8point_explained(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
) -> PyResult<EightPoint> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let found = epipolar::fundamental_8point_explained(&first, &second).or_raise()?;
    eight_point(pixels1.py(), &found)
}

/// Applies the eight-point method without normalizing the pixels, for comparison.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, N >= 8.
///
/// Returns
/// -------
/// EightPoint
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 8 matches.
/// epipole.DegenerateError
///     If the matches do not determine F: on a plane or a line, equal, or from a camera that only
///     rotated.
#[pyfunction]
pub(super) fn fundamental_8point_unnormalized(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
) -> PyResult<EightPoint> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let found = epipolar::fundamental_8point_unnormalized(&first, &second).or_raise()?;
    eight_point(pixels1.py(), &found)
}

/// Computes the essential matrices of five pairs of rays.
///
/// Parameters
/// ----------
/// rays1, rays2 : array_like, shape (5, 3)
///
/// Returns
/// -------
/// ndarray, shape (K, 3, 3)
///     K <= 10, and 0 for a degenerate sample.
#[pyfunction]
pub(super) fn essential_5point<'py>(
    rays1: &Bound<'py, PyAny>,
    rays2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let first = exactly("rays1", rays1)?;
    let second = exactly("rays2", rays2)?;
    from_matrices(rays1.py(), &epipolar::essential_5point(&first, &second))
}

/// Fits an essential matrix to rays by linear least squares, without outliers.
///
/// Parameters
/// ----------
/// rays1, rays2 : array_like, shape (N, 3)
///     Pairs of rays, N >= 8.
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 8 pairs of rays.
/// epipole.DegenerateError
///     If the rays do not determine the matrix, as for a camera that only rotated.
/// ValueError
///     If a ray has length 0.
#[pyfunction]
pub(super) fn essential_8point<'py>(
    rays1: &Bound<'py, PyAny>,
    rays2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let first = vectors::<3>("rays1", rays1)?;
    let second = vectors::<3>("rays2", rays2)?;
    let e = epipolar::essential_8point(&first, &second).or_raise()?;
    from_matrix(rays1.py(), &e)
}

/// Computes the essential matrices and common focal lengths of six matches.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (6, 2)
/// principal1, principal2 : array_like, shape (2,)
///     Principal points, pixels.
///
/// Returns
/// -------
/// list of EssentialWithFocal
///     At most 15.
#[pyfunction]
pub(super) fn essential_6point(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    principal1: &Bound<'_, PyAny>,
    principal2: &Bound<'_, PyAny>,
) -> PyResult<Vec<EssentialWithFocal>> {
    let py = pixels1.py();
    let first = exact_points("pixels1", pixels1)?;
    let second = exact_points("pixels2", pixels2)?;
    let principal1 = Point2::from(vector("principal1", principal1)?);
    let principal2 = Point2::from(vector("principal2", principal2)?);
    let found = epipolar::essential_6point(&first, &second, &principal1, &principal2);
    let to_python = |e: epipolar::EssentialWithFocal| {
        Ok(EssentialWithFocal {
            essential: from_matrix(py, &e.essential)?.unbind(),
            focal_px: e.focal_px,
        })
    };
    found.into_iter().map(to_python).collect()
}

/// Computes the motions from three pairs of rays and known directions of gravity.
///
/// Parameters
/// ----------
/// rays1, rays2 : array_like, shape (3, 3)
///     A ray in each row.
/// gravity1, gravity2 : array_like, shape (3,)
///     Direction of gravity in each camera's frame.
///
/// Returns
/// -------
/// list of RigidTransform
///     At most 4, each ``cam2_from_cam1`` with a translation of length 1.
#[pyfunction]
pub(super) fn relative_pose_3point(
    rays1: &Bound<'_, PyAny>,
    rays2: &Bound<'_, PyAny>,
    gravity1: &Bound<'_, PyAny>,
    gravity2: &Bound<'_, PyAny>,
) -> PyResult<Vec<RigidTransform>> {
    let first = exactly("rays1", rays1)?;
    let second = exactly("rays2", rays2)?;
    let gravity1 = vector("gravity1", gravity1)?;
    let gravity2 = vector("gravity2", gravity2)?;
    let motions = epipolar::relative_pose_3point(&first, &second, &gravity1, &gravity2);
    Ok(motions.into_iter().map(RigidTransform::from).collect())
}

/// Refines a fundamental matrix by minimizing the Sampson errors of matches.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// pixels1, pixels2 : array_like, shape (N, 2)
/// loss : str or dict, optional
///     ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 7 different matches.
/// epipole.DegenerateError
///     If the matrix has rank 1 or 0.
/// ValueError
///     If the loss width is not above 0, or a coordinate is beyond 1e9 pixels.
#[pyfunction]
#[pyo3(signature = (fundamental, pixels1, pixels2, loss=None))]
pub(super) fn refine_fundamental<'py>(
    fundamental: &Bound<'py, PyAny>,
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
    loss: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let f = matrix("fundamental", fundamental)?;
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let loss = options::loss(loss)?;
    let refined = epipolar::refine_fundamental(&f, &first, &second, loss).or_raise()?;
    from_matrix(pixels1.py(), &refined)
}

/// Refines a relative pose by minimizing the Sampson errors of matches.
///
/// Parameters
/// ----------
/// pose : RelativePose
/// pixels1, pixels2 : array_like, shape (N, 2)
/// camera1, camera2 : Camera
/// loss : str or dict, optional
///     ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
///
/// Returns
/// -------
/// RelativePose
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 5 different matches.
/// epipole.DegenerateError
///     If a pixel has no ray.
/// ValueError
///     If the loss width is not above 0, or a coordinate is beyond 1e9 pixels.
#[pyfunction]
#[pyo3(signature = (pose, pixels1, pixels2, camera1, camera2, loss=None))]
pub(super) fn refine_relative_pose(
    pose: &RelativePose,
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    loss: Option<&Bound<'_, PyAny>>,
) -> PyResult<RelativePose> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let loss = options::loss(loss)?;
    let cameras = [&camera1.0, &camera2.0];
    let refined = epipolar::refine_relative_pose(&pose.0, &first, &second, cameras, loss);
    Ok(refined.or_raise()?.into())
}
