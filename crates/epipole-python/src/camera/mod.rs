//! Cameras, lenses and rigid transforms.

mod calibrated;
mod intrinsics;
mod lens;
mod posed;
mod rigid;

pub(crate) use calibrated::Camera;
pub(crate) use intrinsics::Intrinsics;
pub(crate) use lens::Lens;
pub(crate) use posed::PosedCamera;
pub(crate) use rigid::{RigidTransform, rotation};

use crate::arrays::{Batch, from_matrix, vector};
use crate::errors::OrRaise;
use crate::register::{classes, functions};
use epipole::camera;
use epipole::nalgebra::{Point2, Point3};
use numpy::PyArray2;
use pyo3::prelude::*;

/// Returns the cross-product matrix: `cross_matrix(t) @ x == np.cross(t, x)`.
///
/// Parameters
/// ----------
/// t : array_like, shape (3,)
///
/// Returns
/// -------
/// ndarray, shape (3, 3)
#[pyfunction]
fn cross_matrix<'py>(t: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_matrix(t.py(), &camera::cross_matrix(&vector("t", t)?))
}

/// Computes the motion from the frame of camera 1 to that of camera 2.
///
/// Parameters
/// ----------
/// cam1_from_world, cam2_from_world : RigidTransform
///
/// Returns
/// -------
/// RigidTransform
///     ``cam2_from_cam1``
#[pyfunction]
fn relative_motion(
    cam1_from_world: &RigidTransform,
    cam2_from_world: &RigidTransform,
) -> RigidTransform {
    camera::relative_motion(&cam1_from_world.0, &cam2_from_world.0).into()
}

/// Computes the pose of an upright camera that looks at a point.
///
/// Parameters
/// ----------
/// center_in_world, target_in_world : array_like, shape (3,)
///     Center of the camera, and the point at which it looks.
/// up_in_world : array_like, shape (3,)
///     Up direction in the image.
///
/// Returns
/// -------
/// RigidTransform
///     ``cam_from_world``
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the target is at the center, or ``up_in_world`` is zero or parallel to the line of sight.
#[pyfunction]
fn look_at(
    center_in_world: &Bound<'_, PyAny>,
    target_in_world: &Bound<'_, PyAny>,
    up_in_world: &Bound<'_, PyAny>,
) -> PyResult<RigidTransform> {
    let center = Point3::from(vector("center_in_world", center_in_world)?);
    let target = Point3::from(vector("target_in_world", target_in_world)?);
    let up = vector("up_in_world", up_in_world)?;
    Ok(camera::look_at(&center, &target, &up).or_raise()?.into())
}

/// Converts pixels to COLMAP's convention, with pixel centers at half-integers.
///
/// Parameters
/// ----------
/// pixel : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray of the same shape
#[pyfunction]
fn pixel_to_colmap<'py>(pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let to_colmap = |p: &_| Ok(camera::pixel_to_colmap(&Point2::from(*p)).coords);
    Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), to_colmap)
}

/// Converts pixels from COLMAP's convention, with pixel centers at half-integers.
///
/// Parameters
/// ----------
/// pixel : array_like, shape (2,) or (N, 2)
///
/// Returns
/// -------
/// ndarray of the same shape
#[pyfunction]
fn pixel_from_colmap<'py>(pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let from_colmap = |p: &_| Ok(camera::pixel_from_colmap(&Point2::from(*p)).coords);
    Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), from_colmap)
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: Camera, Intrinsics, Lens, PosedCamera, RigidTransform);
    functions!(module: cross_matrix, relative_motion, look_at, pixel_to_colmap, pixel_from_colmap);
    Ok(())
}
