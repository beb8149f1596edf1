//! Homographies.

use crate::arrays::{
    Batch, exact_points, from_matrices, from_matrix, match_error, matrix, pixel_pairs, vector,
};
use crate::camera::{Intrinsics, RigidTransform};
use crate::errors::OrRaise;
use crate::options;
use crate::record::record;
use crate::register::{classes, functions};
use crate::robust::{RansacReport, estimator, give_matrix};
use epipole::nalgebra::{Matrix3, Point2};
use epipole::{Error, homography};
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;

record! {
    /// Motion and plane of a homography.
    "epipole.homography" PlaneMotion {
        /// Motion; its translation is in units of the plane's distance from camera 1.
        cam2_from_cam1: RigidTransform,
        /// Unit normal of the plane in the frame of camera 1, shape (3,).
        normal_in_cam1: Py<PyArray1<f64>>,
    }
}

estimator! {
    /// Estimates a homography from matches with outliers, by RANSAC.
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
    /// RansacReport of ndarray
    ///     Its model is H, shape (3, 3), with ``x2 ~ H @ x1``.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 4 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image are on a line.
    /// epipole.NoConsensusError
    ///     If no homography has 4 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_homography(pixels1, pixels2) -> PyResult<RansacReport> {
        homography::estimate_homography, give_matrix
    }
}

estimator! {
    /// Estimates a homography between the rays of two calibrated cameras, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// camera1, camera2 : Camera
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of ndarray
    ///     Its model is the H that maps rays, shape (3, 3).
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If fewer than 4 different matches are within the range of both lenses.
    /// epipole.DegenerateError
    ///     If all pixels of an image of a pinhole camera are on a line.
    /// epipole.NoConsensusError
    ///     If no homography has 4 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_homography_calibrated(
        pixels1, pixels2, camera1, camera2
    ) -> PyResult<RansacReport> {
        homography::estimate_homography_calibrated, give_matrix
    }
}

/// Computes the homographies of four matches.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (4, 2)
///
/// Returns
/// -------
/// ndarray, shape (K, 3, 3)
///     K is 1, or 0 for a degenerate sample.
#[pyfunction]
fn homography_4point<'py>(
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let first = exact_points("pixels1", pixels1)?;
    let second = exact_points("pixels2", pixels2)?;
    from_matrices(
        pixels1.py(),
        &homography::homography_4point(&first, &second),
    )
}

/// Fits a homography to matches by linear least squares, without outliers.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, N >= 4.
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 4 matches.
/// epipole.DegenerateError
///     If all points, or all but one, are on a line.
#[pyfunction]
fn fit_homography<'py>(
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    from_matrix(
        pixels1.py(),
        &homography::fit_homography(&first, &second).or_raise()?,
    )
}

/// Refines a homography from matches.
///
/// Parameters
/// ----------
/// homography : array_like, shape (3, 3)
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
///     If there are fewer than 4 different matches.
/// ValueError
///     If the loss width is not above 0, a coordinate is beyond 1e9 pixels, or the initial
///     homography maps a pixel to infinity.
#[pyfunction]
#[pyo3(signature = (homography, pixels1, pixels2, loss=None))]
fn refine_homography<'py>(
    homography: &Bound<'py, PyAny>,
    pixels1: &Bound<'py, PyAny>,
    pixels2: &Bound<'py, PyAny>,
    loss: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let h = matrix("homography", homography)?;
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let loss = options::loss(loss)?;
    let refined = homography::refine_homography(&h, &first, &second, loss).or_raise()?;
    from_matrix(pixels1.py(), &refined)
}

/// Maps pixels of image 1 to image 2 by a homography.
///
/// Parameters
/// ----------
/// homography : array_like, shape (3, 3)
/// pixel1 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray of the same shape
///     Rows of NaN for pixels mapped to infinity.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pixel is given and is mapped to infinity.
///
/// Examples
/// --------
/// >>> transfer([[2, 0, 1], [0, 2, 0], [0, 0, 1]], [3, 4])
/// array([7., 8.])
#[pyfunction]
fn transfer<'py>(
    homography: &Bound<'py, PyAny>,
    pixel1: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let h: Matrix3<f64> = matrix("homography", homography)?;
    let transfer = |p: &_| match homography::transfer(&h, &Point2::from(*p)) {
        Some(pixel2) => Ok(pixel2.coords),
        None => Err(Error::Degenerate {
            what: "the pixel in image 2",
            why: "the homography maps it to infinity",
        }),
    };
    Batch::<2>::read("pixel1", pixel1)?.vectors(pixel1.py(), transfer)
}

match_error! {
    /// Computes the distances in image 2 between mapped pixels and their matches.
    ///
    /// Parameters
    /// ----------
    /// homography : array_like, shape (3, 3)
    /// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// float or ndarray, shape (N,)
    ///     Pixels.
    fn transfer_error_px(homography, pixel1, pixel2) -> PyResult<Bound<'py, PyAny>> {
        homography::transfer_error_px
    }
}

match_error! {
    /// Computes the Sampson distances of matches from a homography.
    ///
    /// Parameters
    /// ----------
    /// homography : array_like, shape (3, 3)
    /// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// float or ndarray, shape (N,)
    ///     Pixels.
    fn homography_sampson_px(homography, pixel1, pixel2) -> PyResult<Bound<'py, PyAny>> {
        homography::homography_sampson_px
    }
}

/// Decomposes a homography into its possible motions and planes.
///
/// Parameters
/// ----------
/// homography : array_like, shape (3, 3)
/// k1, k2 : Intrinsics
///
/// Returns
/// -------
/// list of PlaneMotion
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the matrix is singular.
#[pyfunction]
fn decompose_homography(
    py: Python<'_>,
    homography: &Bound<'_, PyAny>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> PyResult<Vec<PlaneMotion>> {
    let h = matrix("homography", homography)?;
    let motions = homography::decompose_homography(&h, &k1.0, &k2.0).or_raise()?;
    let to_python = |motion: homography::PlaneMotion| PlaneMotion {
        cam2_from_cam1: motion.cam2_from_cam1.into(),
        normal_in_cam1: crate::arrays::from_vector(py, &motion.normal_in_cam1).unbind(),
    };
    Ok(motions.into_iter().map(to_python).collect())
}

/// Computes the homography of a plane between two cameras.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
/// normal_in_cam1 : array_like, shape (3,)
///     Unit normal: points of the plane satisfy ``normal @ x == -distance``.
/// distance : float
///     Distance of the plane from camera 1.
/// k1, k2 : Intrinsics
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
#[pyfunction]
fn homography_from_motion<'py>(
    cam2_from_cam1: &RigidTransform,
    normal_in_cam1: &Bound<'py, PyAny>,
    distance: f64,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let normal = vector("normal_in_cam1", normal_in_cam1)?;
    let motion = &cam2_from_cam1.0;
    let h = homography::homography_from_motion(motion, &normal, distance, &k1.0, &k2.0);
    from_matrix(normal_in_cam1.py(), &h)
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: PlaneMotion);
    functions!(module:
        estimate_homography, estimate_homography_calibrated, homography_4point, fit_homography,
        refine_homography, transfer, transfer_error_px, homography_sampson_px, decompose_homography,
        homography_from_motion
    );
    Ok(())
}
