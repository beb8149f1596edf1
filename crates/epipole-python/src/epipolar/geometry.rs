//! Distances, lines, epipoles; F and E from cameras and from each other.

use super::relative_pose::SelectedPose;
use crate::arrays::{
    Batch, Pairs, from_matrix, from_vector, match_error, matrix, pixel_pairs, vector,
};
use crate::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use crate::errors::OrRaise;
use epipole::epipolar::{self, Epipole};
use epipole::nalgebra::{Matrix3, Point2, SVector};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

match_error! {
    /// Computes the Sampson distances of matches from a fundamental matrix.
    ///
    /// Parameters
    /// ----------
    /// fundamental : array_like, shape (3, 3)
    /// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// float or ndarray, shape (N,)
    ///     Pixels.
    ///
    /// Examples
    /// --------
    /// >>> sideways = [[0, 0, 0], [0, 0, -1], [0, 1, 0]]
    /// >>> sampson_px(sideways, [[0, 0], [10, 20]], [[5, 0], [14, 20]])
    /// array([0., 0.])
    fn sampson_px(fundamental, pixel1, pixel2) -> PyResult<Bound<'py, PyAny>> {
        epipolar::sampson_px
    }
}

/// Computes the tangent Sampson errors of matches between cameras with any lens.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
///     The length of its translation does not matter.
/// camera1, camera2 : Camera
/// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
///     Pixels of both images; inf where the rays cannot meet in front of both cameras, NaN where a
///     pixel has no ray. Nearly equal to `sampson_px` for pinhole cameras.
#[pyfunction]
pub(super) fn tangent_sampson_px<'py>(
    cam2_from_cam1: &RigidTransform,
    camera1: &Camera,
    camera2: &Camera,
    pixel1: &Bound<'py, PyAny>,
    pixel2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    Pairs::pixels(pixel1, pixel2)?.numbers(pixel1.py(), |p, q| {
        let observation1 = camera1.0.observe(&Point2::from(*p));
        let observation2 = camera2.0.observe(&Point2::from(*q));
        match (observation1, observation2) {
            (Ok(observation1), Ok(observation2)) => {
                epipolar::tangent_sampson_px(&cam2_from_cam1.0, &observation1, &observation2)
            }
            _ => f64::NAN,
        }
    })
}

match_error! {
    /// Computes the symmetric epipolar distances of matches from a fundamental matrix.
    ///
    /// Parameters
    /// ----------
    /// fundamental : array_like, shape (3, 3)
    /// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// float or ndarray, shape (N,)
    ///     Pixels.
    fn symmetric_epipolar_px(fundamental, pixel1, pixel2) -> PyResult<Bound<'py, PyAny>> {
        epipolar::symmetric_epipolar_px
    }
}

/// Returns the rows of the eight-point system: ``row @ F.ravel() == x2 @ F @ x1``.
///
/// Parameters
/// ----------
/// x1, x2 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray, shape (9,) or (N, 9)
///
/// Examples
/// --------
/// >>> epipolar_row([2, 3], [5, 7])
/// array([10., 15.,  5., 14., 21.,  7.,  2.,  3.,  1.])
#[pyfunction]
pub(super) fn epipolar_row<'py>(
    x1: &Bound<'py, PyAny>,
    x2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let row = |p: &_, q: &_| {
        let row = epipolar::epipolar_row(&Point2::from(*p), &Point2::from(*q));
        Ok(SVector::<f64, 9>::from(row))
    };
    Pairs::<2, 2>::read(("x1", x1), ("x2", x2))?.vectors(x1.py(), row)
}

/// Computes the epipolar lines in image 1 of pixels in image 2.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// pixel2 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Lines (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``. Rows of NaN for
///     epipoles.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pixel is given and it is the epipole or its line is at infinity.
#[pyfunction]
pub(super) fn epipolar_line1<'py>(
    fundamental: &Bound<'py, PyAny>,
    pixel2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let f: Matrix3<f64> = matrix("fundamental", fundamental)?;
    let line = |p: &_| Ok(epipolar::epipolar_line1(&f, &Point2::from(*p))?.homogeneous());
    Batch::<2>::read("pixel2", pixel2)?.vectors(pixel2.py(), line)
}

/// Computes the epipolar lines in image 2 of pixels in image 1.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// pixel1 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Lines (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``. Rows of NaN for
///     epipoles.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pixel is given and it is the epipole or its line is at infinity.
#[pyfunction]
pub(super) fn epipolar_line2<'py>(
    fundamental: &Bound<'py, PyAny>,
    pixel1: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let f: Matrix3<f64> = matrix("fundamental", fundamental)?;
    let line = |p: &_| Ok(epipolar::epipolar_line2(&f, &Point2::from(*p))?.homogeneous());
    Batch::<2>::read("pixel1", pixel1)?.vectors(pixel1.py(), line)
}

/// Computes the epipoles of image 1 and image 2.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
///
/// Returns
/// -------
/// epipole1, epipole2 : ndarray, shape (3,)
///     (u, v, 1), or (u, v, 0) with a unit direction for an epipole at infinity.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix has rank 1 or 0.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub(super) fn epipoles<'py>(
    fundamental: &Bound<'py, PyAny>,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
    let py = fundamental.py();
    let (e1, e2) = epipolar::epipoles(&matrix("fundamental", fundamental)?).or_raise()?;
    let homogeneous = |epipole| match epipole {
        Epipole::Finite(at) => from_vector(py, &at.coords.push(1.0)),
        Epipole::AtInfinity(direction) => from_vector(py, &direction.push(0.0)),
    };
    Ok((homogeneous(e1), homogeneous(e2)))
}

/// Computes one matrix from another, the argument `name`.
fn convert<'py>(
    (name, value): (&str, &Bound<'py, PyAny>),
    compute: impl FnOnce(&Matrix3<f64>) -> epipole::Result<Matrix3<f64>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_matrix(value.py(), &compute(&matrix(name, value)?).or_raise()?)
}

/// Returns the nearest matrix of rank 2, with unit norm.
///
/// Parameters
/// ----------
/// matrix : array_like, shape (3, 3)
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
#[pyfunction]
pub(super) fn enforce_rank2<'py>(
    matrix: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    convert(("matrix", matrix), epipolar::enforce_rank2)
}

/// Returns the nearest essential matrix, with unit norm.
///
/// Parameters
/// ----------
/// matrix : array_like, shape (3, 3)
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix has rank 1 or 0.
#[pyfunction]
pub(super) fn project_to_essential<'py>(
    matrix: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    convert(("matrix", matrix), epipolar::project_to_essential)
}

/// Decomposes an essential matrix into its four motions.
///
/// Parameters
/// ----------
/// essential : array_like, shape (3, 3)
///
/// Returns
/// -------
/// list of RigidTransform
///     Each ``cam2_from_cam1`` with a translation of length 1.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix has rank 1 or 0.
#[pyfunction]
pub(super) fn decompose_essential(essential: &Bound<'_, PyAny>) -> PyResult<Vec<RigidTransform>> {
    let motions = epipolar::decompose_essential(&matrix("essential", essential)?).or_raise()?;
    Ok(motions.into_iter().map(RigidTransform::from).collect())
}

/// Selects the motion that puts most points in front of both cameras.
///
/// Parameters
/// ----------
/// motions : sequence of RigidTransform
///     Candidates, such as those from `decompose_essential`.
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches without outliers.
/// k1, k2 : Intrinsics
///
/// Returns
/// -------
/// SelectedPose
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no motions or no matches.
#[pyfunction]
pub(super) fn select_pose(
    motions: Vec<RigidTransform>,
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> PyResult<SelectedPose> {
    let motions: Vec<_> = motions.into_iter().map(|motion| motion.0).collect();
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    let selected = epipolar::select_pose(&motions, &pixels1, &pixels2, &k1.0, &k2.0).or_raise()?;
    Ok(SelectedPose {
        cam2_from_cam1: selected.cam2_from_cam1.into(),
        num_in_front: selected.num_in_front,
        second_num_in_front: selected.second_num_in_front,
    })
}

/// Computes the essential matrix of a motion, with unit norm.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the motion has no translation.
#[pyfunction]
pub(super) fn essential_from_motion<'py>(
    py: Python<'py>,
    cam2_from_cam1: &RigidTransform,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_matrix(
        py,
        &epipolar::essential_from_motion(&cam2_from_cam1.0).or_raise()?,
    )
}

/// Computes the fundamental matrix of two cameras, with unit norm, for undistorted pixels.
///
/// Parameters
/// ----------
/// cam1, cam2 : PosedCamera
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If both cameras are at the same position.
#[pyfunction]
pub(super) fn fundamental_from_cameras<'py>(
    py: Python<'py>,
    cam1: &PosedCamera,
    cam2: &PosedCamera,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_matrix(
        py,
        &epipolar::fundamental_from_cameras(&cam1.0, &cam2.0).or_raise()?,
    )
}

/// Computes the fundamental matrix of an essential matrix, with unit norm.
///
/// Parameters
/// ----------
/// essential : array_like, shape (3, 3)
/// k1, k2 : Intrinsics
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix is zero.
#[pyfunction]
pub(super) fn fundamental_from_essential<'py>(
    essential: &Bound<'py, PyAny>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    convert(("essential", essential), |e| {
        epipolar::fundamental_from_essential(e, &k1.0, &k2.0)
    })
}

/// Computes the essential matrix ``K2.T @ F @ K1``, with unit norm.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// k1, k2 : Intrinsics
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix is zero.
#[pyfunction]
pub(super) fn essential_from_fundamental<'py>(
    fundamental: &Bound<'py, PyAny>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    convert(("fundamental", fundamental), |f| {
        epipolar::essential_from_fundamental(f, &k1.0, &k2.0)
    })
}

/// Computes the focal lengths of two cameras from their fundamental matrix.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// principal1, principal2 : array_like, shape (2,)
///     Principal points, pixels.
///
/// Returns
/// -------
/// focal1_px, focal2_px : float
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the optical axes meet or are parallel, or noise makes a squared focal length negative.
#[pyfunction]
pub(super) fn focal_lengths_from_fundamental(
    fundamental: &Bound<'_, PyAny>,
    principal1: &Bound<'_, PyAny>,
    principal2: &Bound<'_, PyAny>,
) -> PyResult<(f64, f64)> {
    let f = matrix("fundamental", fundamental)?;
    let principal1 = Point2::from(vector("principal1", principal1)?);
    let principal2 = Point2::from(vector("principal2", principal2)?);
    let focals = epipolar::focal_lengths_from_fundamental(&f, &principal1, &principal2);
    Ok(focals.or_raise()?.into())
}
