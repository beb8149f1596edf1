//! Poses of cameras from known points.

use crate::arrays::{exact_points, exactly, points2, points3, vector};
use crate::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use crate::errors::OrRaise;
use crate::options;
use crate::record::record;
use crate::register::{classes, functions};
use crate::robust::{RansacReport, estimate, give_object};
use epipole::absolute_pose;
use epipole::nalgebra::{Point2, Point3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Pose of a camera with its focal length.
    "epipole.absolute_pose" AbsolutePoseWithFocal {
        /// Pose.
        cam_from_world: RigidTransform,
        /// Focal length, pixels.
        focal_px: f64,
        /// Standard deviation of the focal length, pixels; None if the focal length has no effect.
        focal_std_px: Option<f64>,
    }
}

impl From<absolute_pose::AbsolutePoseWithFocal> for AbsolutePoseWithFocal {
    fn from(found: absolute_pose::AbsolutePoseWithFocal) -> Self {
        Self {
            cam_from_world: found.cam_from_world.into(),
            focal_px: found.focal_px,
            focal_std_px: found.focal_std_px,
        }
    }
}

#[pymethods]
impl AbsolutePoseWithFocal {
    /// Whether the points determine the focal length.
    fn constrains_focal(&self) -> bool {
        let found = absolute_pose::AbsolutePoseWithFocal {
            cam_from_world: self.cam_from_world.0,
            focal_px: self.focal_px,
            focal_std_px: self.focal_std_px,
        };
        found.constrains_focal()
    }
}

/// Points in the world and their pixels.
type Correspondences = (Vec<Point3<f64>>, Vec<Point2<f64>>);

/// Reads the arguments `points_in_world` and `pixels`.
fn points_with_pixels(
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
) -> PyResult<Correspondences> {
    let points = points3("points_in_world", points_in_world)?;
    Ok((points, points2("pixels", pixels)?))
}

/// Estimates the pose of a calibrated camera from points with outliers, by RANSAC.
///
/// Parameters
/// ----------
/// points_in_world : array_like, shape (N, 3)
/// pixels : array_like, shape (N, 2)
///     Where the camera sees the points.
/// camera : Camera
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of RigidTransform
///     Its model is ``cam_from_world``, a `RigidTransform`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 4 different matches.
/// epipole.NoConsensusError
///     If no pose has 3 inliers.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
#[pyfunction]
#[pyo3(signature = (points_in_world, pixels, camera, *, progress=None, **options))]
fn estimate_absolute_pose(
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    camera: &Camera,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    let camera = &camera.0;
    let give = give_object::<_, RigidTransform>;
    let py = points_in_world.py();
    estimate(py, progress, options, give, |options, monitor| {
        absolute_pose::estimate_absolute_pose(&points, &pixels, camera, options, monitor)
    })
}

/// Estimates pose and focal length of a camera from points with outliers, by RANSAC.
///
/// Parameters
/// ----------
/// points_in_world : array_like, shape (N, 3)
/// pixels : array_like, shape (N, 2)
///     Where the camera sees the points.
/// principal : array_like, shape (2,)
///     Principal point, pixels.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of AbsolutePoseWithFocal
///     Its model is an `AbsolutePoseWithFocal`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 5 different matches.
/// epipole.NoConsensusError
///     If no pose has 4 inliers.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
#[pyfunction]
#[pyo3(signature = (points_in_world, pixels, principal, *, progress=None, **options))]
fn estimate_absolute_pose_and_focal(
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    principal: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    let principal = Point2::from(vector("principal", principal)?);
    let give = give_object::<_, AbsolutePoseWithFocal>;
    let py = points_in_world.py();
    estimate(py, progress, options, give, |options, monitor| {
        absolute_pose::estimate_absolute_pose_and_focal(
            &points, &pixels, &principal, options, monitor,
        )
    })
}

/// Computes the poses from three rays and their points.
///
/// Parameters
/// ----------
/// rays : array_like, shape (3, 3)
///     A ray in each row.
/// points_in_world : array_like, shape (3, 3)
///     A point in each row.
///
/// Returns
/// -------
/// list of RigidTransform
///     At most 4, each ``cam_from_world``.
#[pyfunction]
fn pose_p3p(
    rays: &Bound<'_, PyAny>,
    points_in_world: &Bound<'_, PyAny>,
) -> PyResult<Vec<RigidTransform>> {
    let rays = exactly("rays", rays)?;
    let points = exact_points("points_in_world", points_in_world)?;
    let poses = absolute_pose::pose_p3p(&rays, &points);
    Ok(poses.into_iter().map(RigidTransform::from).collect())
}

/// Computes the poses and focal lengths from four points.
///
/// Parameters
/// ----------
/// pixels : array_like, shape (4, 2)
/// points_in_world : array_like, shape (4, 3)
/// principal : array_like, shape (2,)
///     Principal point, pixels.
///
/// Returns
/// -------
/// list of AbsolutePoseWithFocal
///     At most 7.
#[pyfunction]
fn pose_p4pf(
    pixels: &Bound<'_, PyAny>,
    points_in_world: &Bound<'_, PyAny>,
    principal: &Bound<'_, PyAny>,
) -> PyResult<Vec<AbsolutePoseWithFocal>> {
    let pixels = exact_points("pixels", pixels)?;
    let points = exact_points("points_in_world", points_in_world)?;
    let principal = Point2::from(vector("principal", principal)?);
    let poses = absolute_pose::pose_p4pf(&pixels, &points, &principal);
    Ok(poses.into_iter().map(AbsolutePoseWithFocal::from).collect())
}

/// Computes a pose by linear least squares (DLT), without outliers.
///
/// Parameters
/// ----------
/// points_in_world : array_like, shape (N, 3)
///     N >= 6, not on a plane.
/// pixels : array_like, shape (N, 2)
/// intrinsics : Intrinsics
///
/// Returns
/// -------
/// RigidTransform
///     ``cam_from_world``
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 6 points.
/// epipole.DegenerateError
///     If the points lie on a plane, or are otherwise degenerate.
#[pyfunction]
fn pose_dlt(
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    intrinsics: &Intrinsics,
) -> PyResult<RigidTransform> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    Ok(absolute_pose::pose_dlt(&points, &pixels, &intrinsics.0)
        .or_raise()?
        .into())
}

/// Computes the pose with the least reprojection error, without outliers.
///
/// Parameters
/// ----------
/// points_in_world : array_like, shape (N, 3)
/// pixels : array_like, shape (N, 2)
/// camera : Camera
///
/// Returns
/// -------
/// RigidTransform
///     ``cam_from_world``
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 4 points.
/// epipole.DegenerateError
///     If the points lie on a line, no pose has all of them in front of the camera, or a pixel has
///     no ray.
#[pyfunction]
fn fit_absolute_pose(
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    camera: &Camera,
) -> PyResult<RigidTransform> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    Ok(
        absolute_pose::fit_absolute_pose(&points, &pixels, &camera.0)
            .or_raise()?
            .into(),
    )
}

/// Finds a second pose that explains a plane nearly as well.
///
/// Parameters
/// ----------
/// cam_from_world : RigidTransform
///     Known pose.
/// points_in_world : array_like, shape (N, 3)
/// pixels : array_like, shape (N, 2)
/// camera : Camera
///
/// Returns
/// -------
/// RigidTransform or None
///
/// Raises
/// ------
/// epipole.TooFewError
///     If fewer than 3 points are in front of the flipped camera.
/// epipole.DegenerateError
///     If a pixel has no ray.
#[pyfunction]
fn find_flipped_pose(
    cam_from_world: &RigidTransform,
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    camera: &Camera,
) -> PyResult<Option<RigidTransform>> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    let pose = &cam_from_world.0;
    let flipped = absolute_pose::find_flipped_pose(pose, &points, &pixels, &camera.0);
    Ok(flipped.or_raise()?.map(RigidTransform::from))
}

/// Refines a pose by minimizing the reprojection errors.
///
/// Parameters
/// ----------
/// cam_from_world : RigidTransform
/// points_in_world : array_like, shape (N, 3)
/// pixels : array_like, shape (N, 2)
/// camera : Camera
/// loss : str or dict, optional
///     ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
///
/// Returns
/// -------
/// RigidTransform
///     ``cam_from_world``
///
/// Raises
/// ------
/// epipole.TooFewError
///     If fewer than 3 points are in front of the camera.
/// epipole.DegenerateError
///     If a pixel has no ray.
/// ValueError
///     If the loss width is not above 0.
#[pyfunction]
#[pyo3(signature = (cam_from_world, points_in_world, pixels, camera, loss=None))]
fn refine_absolute_pose(
    cam_from_world: &RigidTransform,
    points_in_world: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
    camera: &Camera,
    loss: Option<&Bound<'_, PyAny>>,
) -> PyResult<RigidTransform> {
    let (points, pixels) = points_with_pixels(points_in_world, pixels)?;
    let loss = options::loss(loss)?;
    let pose = &cam_from_world.0;
    let refined = absolute_pose::refine_absolute_pose(pose, &points, &pixels, &camera.0, loss);
    Ok(refined.or_raise()?.into())
}

/// Computes the distances between projected points and pixels.
///
/// Parameters
/// ----------
/// camera : PosedCamera
/// point_in_world : array_like, shape (3,) or (N, 3)
/// pixel : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
///     Pixels; infinite for a point that the camera does not see.
///
/// Examples
/// --------
/// >>> from epipole import Camera, Intrinsics, PosedCamera, RigidTransform
/// >>> camera = Camera.pinhole(Intrinsics(100, 100, 50, 50), 101, 101)
/// >>> reprojection_error_px(PosedCamera(camera, RigidTransform()), [0, 0, 2], [53, 54])
/// 5.0
#[pyfunction]
fn reprojection_error_px<'py>(
    camera: &PosedCamera,
    point_in_world: &Bound<'py, PyAny>,
    pixel: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let pairs =
        crate::arrays::Pairs::<3, 2>::read(("point_in_world", point_in_world), ("pixel", pixel))?;
    pairs.numbers(pixel.py(), |x, p| {
        absolute_pose::reprojection_error_px(&camera.0, &Point3::from(*x), &Point2::from(*p))
    })
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: AbsolutePoseWithFocal);
    functions!(module:
        estimate_absolute_pose, estimate_absolute_pose_and_focal, pose_p3p, pose_p4pf, pose_dlt,
        fit_absolute_pose, find_flipped_pose, refine_absolute_pose, reprojection_error_px
    );
    Ok(())
}
