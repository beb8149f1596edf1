//! Points from their images in two or more views.

use crate::arrays::{Pairs, from_matrix, from_vector, matrix, points2, vector};
use crate::camera::{PosedCamera, RigidTransform};
use crate::errors::OrRaise;
use crate::options;
use crate::record::record;
use crate::register::{classes, functions};
use epipole::nalgebra::{Matrix3, Matrix3x4, Point2, Point3, Vector3, Vector4};
use epipole::{camera, triangulation};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

record! {
    /// Point triangulated from several views.
    "epipole.triangulation" NviewPoint {
        /// Point, shape (3,).
        point_in_world: Py<PyArray1<f64>>,
        /// Root mean square of the distances between projections and pixels.
        rms_error_px: f64,
    }
}

/// Triangulates points of two views by linear least squares (DLT).
///
/// Parameters
/// ----------
/// p1, p2 : array_like, shape (3, 4)
///     Projection matrices.
/// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
///     Undistorted pixels.
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Rows of NaN for parallel rays and points behind a camera.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single match is given and its rays are parallel, its point is not in front of both
///     cameras, the cameras are at the same position, or a matrix has rank below 3.
#[pyfunction]
fn triangulate_dlt<'py>(
    p1: &Bound<'py, PyAny>,
    p2: &Bound<'py, PyAny>,
    pixel1: &Bound<'py, PyAny>,
    pixel2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let p1: Matrix3x4<f64> = matrix("p1", p1)?;
    let p2: Matrix3x4<f64> = matrix("p2", p2)?;
    Pairs::pixels(pixel1, pixel2)?.vectors(pixel1.py(), |a, b| {
        let (a, b) = (Point2::from(*a), Point2::from(*b));
        Ok(triangulation::triangulate_dlt(&p1, &p2, &a, &b)?.coords)
    })
}

/// Triangulates points from rays in the frames of their cameras.
fn triangulate_rays<'py>(
    cam2_from_cam1: &RigidTransform,
    ray1: &Bound<'py, PyAny>,
    ray2: &Bound<'py, PyAny>,
    triangulate: impl Fn(
        &camera::RigidTransform,
        &Vector3<f64>,
        &Vector3<f64>,
    ) -> epipole::Result<Point3<f64>>
    + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let motion = &cam2_from_cam1.0;
    let pairs = Pairs::<3, 3>::read(("ray1", ray1), ("ray2", ray2))?;
    pairs.vectors(ray1.py(), |a, b| Ok(triangulate(motion, a, b)?.coords))
}

/// Triangulates points of two views: the midpoints where rays are nearest to each other.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
/// ray1, ray2 : array_like, shape (3,) or (N, 3)
///     Rays in the frames of camera 1 and camera 2.
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Points in the frame of camera 1. Rows of NaN for parallel rays and points behind a camera.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pair is given and its rays are parallel or diverge, or the cameras are at the
///     same position.
/// ValueError
///     If a single pair is given and a ray has length 0.
///
/// Examples
/// --------
/// >>> from epipole import RigidTransform
/// >>> motion = RigidTransform(translation=[-1, 0, 0])
/// >>> triangulate_midpoint(motion, [0, 0, 1], [-0.25, 0, 1])
/// array([0., 0., 4.])
#[pyfunction]
fn triangulate_midpoint<'py>(
    cam2_from_cam1: &RigidTransform,
    ray1: &Bound<'py, PyAny>,
    ray2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let triangulate = triangulation::triangulate_midpoint;
    triangulate_rays(cam2_from_cam1, ray1, ray2, triangulate)
}

/// Triangulates points of two views: midpoints of rays, weighted by inverse depth.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
/// ray1, ray2 : array_like, shape (3,) or (N, 3)
///     Rays in the frames of camera 1 and camera 2.
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Same as for `triangulate_midpoint`.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pair is given and its rays are parallel or diverge, or the cameras are at the
///     same position; for several pairs, its row is NaN.
/// ValueError
///     If a single pair is given and a ray has length 0.
#[pyfunction]
fn triangulate_weighted_midpoint<'py>(
    cam2_from_cam1: &RigidTransform,
    ray1: &Bound<'py, PyAny>,
    ray2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let triangulate = triangulation::triangulate_weighted_midpoint;
    triangulate_rays(cam2_from_cam1, ray1, ray2, triangulate)
}

/// Triangulates points of two views with the smallest sum of angular errors.
///
/// Parameters
/// ----------
/// cam2_from_cam1 : RigidTransform
/// ray1, ray2 : array_like, shape (3,) or (N, 3)
///     Rays in the frames of camera 1 and camera 2.
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Same as for `triangulate_midpoint`.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single pair is given and its rays are parallel or diverge, or the cameras are at the
///     same position; for several pairs, its row is NaN.
/// ValueError
///     If a single pair is given and a ray has length 0.
#[pyfunction]
fn triangulate_angular<'py>(
    cam2_from_cam1: &RigidTransform,
    ray1: &Bound<'py, PyAny>,
    ray2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let triangulate = triangulation::triangulate_angular;
    triangulate_rays(cam2_from_cam1, ray1, ray2, triangulate)
}

/// Triangulates points of two views with the smallest reprojection error.
///
/// Parameters
/// ----------
/// cam1, cam2 : PosedCamera
/// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray, shape (3,) or (N, 3)
///     Rows of NaN for parallel rays and points behind a camera.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single match is given and its rays are parallel or diverge, it is an epipole, a pixel
///     has no ray, or the cameras are at the same position.
#[pyfunction]
fn triangulate_optimal<'py>(
    cam1: &PosedCamera,
    cam2: &PosedCamera,
    pixel1: &Bound<'py, PyAny>,
    pixel2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    Pairs::pixels(pixel1, pixel2)?.vectors(pixel1.py(), |a, b| {
        let (a, b) = (Point2::from(*a), Point2::from(*b));
        Ok(triangulation::triangulate_optimal(&cam1.0, &cam2.0, &a, &b)?.coords)
    })
}

/// Computes the nearest matches that satisfy the epipolar constraint exactly.
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// pixel1, pixel2 : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray, shape (4,) or (N, 4)
///     Corrected (u1, v1, u2, v2). Rows of NaN for matches at an epipole.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single match is given and it consists of the two epipoles or its lines are at infinity,
///     or if the matrix is zero.
#[pyfunction]
fn correct_matches<'py>(
    fundamental: &Bound<'py, PyAny>,
    pixel1: &Bound<'py, PyAny>,
    pixel2: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let f: Matrix3<f64> = matrix("fundamental", fundamental)?;
    Pairs::pixels(pixel1, pixel2)?.vectors(pixel1.py(), |a, b| {
        let (a, b) = triangulation::correct_matches(&f, &Point2::from(*a), &Point2::from(*b))?;
        Ok(Vector4::new(a.x, a.y, b.x, b.y))
    })
}

/// Triangulates a point of several views by linear least squares.
///
/// Parameters
/// ----------
/// cameras : sequence of PosedCamera
///     At least 2.
/// pixels : array_like, shape (N, 2)
///     Pixel in each camera.
///
/// Returns
/// -------
/// ndarray, shape (3,)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 views.
/// epipole.DegenerateError
///     If the rays are parallel, the cameras are at the same position, a camera does not see the
///     point, or a pixel has no ray.
#[pyfunction]
fn triangulate_nview_dlt<'py>(
    cameras: Vec<PosedCamera>,
    pixels: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let found = triangulation::triangulate_nview_dlt(&cores(&cameras), &points2("pixels", pixels)?);
    Ok(from_vector(pixels.py(), &found.or_raise()?.coords))
}

/// Triangulates a point of several views with the smallest reprojection error.
///
/// Parameters
/// ----------
/// cameras : sequence of PosedCamera
///     At least 2.
/// pixels : array_like, shape (N, 2)
///     Pixel in each camera.
/// loss : str or dict, optional
///     ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
///
/// Returns
/// -------
/// NviewPoint
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 views.
/// epipole.DegenerateError
///     If the rays are parallel, the cameras are at the same position, a camera does not see the
///     point, or a pixel has no ray.
/// ValueError
///     If the loss width is not above 0.
#[pyfunction]
#[pyo3(signature = (cameras, pixels, loss=None))]
fn triangulate_nview(
    cameras: Vec<PosedCamera>,
    pixels: &Bound<'_, PyAny>,
    loss: Option<&Bound<'_, PyAny>>,
) -> PyResult<NviewPoint> {
    let py = pixels.py();
    let pixels = points2("pixels", pixels)?;
    let loss = options::loss(loss)?;
    let found = triangulation::triangulate_nview(&cores(&cameras), &pixels, loss).or_raise()?;
    Ok(NviewPoint {
        point_in_world: from_vector(py, &found.point_in_world.coords).unbind(),
        rms_error_px: found.rms_error_px,
    })
}

/// Computes the angle between the rays that meet in a point.
///
/// Parameters
/// ----------
/// center1_in_world, center2_in_world : array_like, shape (3,)
///     Centers of the cameras.
/// point_in_world : array_like, shape (3,) or (N, 3)
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
///     Radians.
#[pyfunction]
fn triangulation_angle_rad<'py>(
    center1_in_world: &Bound<'py, PyAny>,
    center2_in_world: &Bound<'py, PyAny>,
    point_in_world: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let center1 = Point3::from(vector("center1_in_world", center1_in_world)?);
    let center2 = Point3::from(vector("center2_in_world", center2_in_world)?);
    let points = crate::arrays::Batch::<3>::read("point_in_world", point_in_world)?;
    points.numbers(point_in_world.py(), |x| {
        triangulation::triangulation_angle_rad(&center1, &center2, &Point3::from(*x))
    })
}

/// Computes the covariance of a triangulated point, to first order.
///
/// Parameters
/// ----------
/// cameras : sequence of PosedCamera
/// point_in_world : array_like, shape (3,)
/// sigma_px : float
///     Standard deviation of each pixel coordinate.
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a camera does not see the point, or the views do not constrain it along a ray.
/// ValueError
///     If ``sigma_px`` is not above 0.
#[pyfunction]
fn point_covariance<'py>(
    cameras: Vec<PosedCamera>,
    point_in_world: &Bound<'py, PyAny>,
    sigma_px: f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let point = Point3::from(vector("point_in_world", point_in_world)?);
    let found = triangulation::point_covariance(&cores(&cameras), &point, sigma_px).or_raise()?;
    from_matrix(point_in_world.py(), &found)
}

fn cores(cameras: &[PosedCamera]) -> Vec<camera::PosedCamera> {
    cameras.iter().map(|camera| camera.0).collect()
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: NviewPoint);
    functions!(module:
        triangulate_dlt, triangulate_midpoint, triangulate_weighted_midpoint, triangulate_angular,
        triangulate_optimal, correct_matches, triangulate_nview_dlt, triangulate_nview,
        triangulation_angle_rad, point_covariance
    );
    Ok(())
}
