//! Depths and points from disparities.

use crate::arrays::{from_points, matrix};
use crate::errors::OrRaise;
use crate::images::{column, disparity as read, from_gray, rgb};
use crate::progress;
use crate::record::{plain_class, record};
use epipole::nalgebra::Matrix4;
use epipole::stereo;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

record! {
    /// Depths compatible with an uncertain disparity.
    "epipole.stereo" DepthInterval {
        /// Smallest depth, meters.
        near_m: f64,
        /// Largest depth, meters; None if the interval reaches infinity.
        far_m: Option<f64>,
    }
}

/// Points in space.
///
/// Parameters
/// ----------
/// points : ndarray of float64, shape (N, 3)
/// colors : ndarray of uint8, shape (N, 3), optional
///     Red, green, blue.
/// normals : ndarray of float64, shape (N, 3), optional
///     Unit normals.
/// confidences : ndarray of float32, shape (N,), optional
///     Number of photos that agree on each point.
#[pyclass(frozen, get_all, module = "epipole.stereo")]
pub(crate) struct PointCloud {
    /// Points, shape (N, 3).
    points: Py<PyArray2<f64>>,
    /// Colors, uint8 of shape (N, 3), or None.
    colors: Option<Py<PyArray2<u8>>>,
    /// Unit normals, shape (N, 3), or None.
    normals: Option<Py<PyArray2<f64>>>,
    /// Number of photos that agree on each point, float32 of shape (N,), or None.
    confidences: Option<Py<PyArray1<f32>>>,
}

plain_class!(PointCloud: points, colors, normals, confidences);

#[pymethods]
impl PointCloud {
    #[new]
    #[pyo3(signature = (points, colors=None, normals=None, confidences=None))]
    fn new(
        points: Py<PyArray2<f64>>,
        colors: Option<Py<PyArray2<u8>>>,
        normals: Option<Py<PyArray2<f64>>>,
        confidences: Option<Py<PyArray1<f32>>>,
    ) -> Self {
        Self {
            points,
            colors,
            normals,
            confidences,
        }
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.points.bind(py).shape()[0]
    }
}

/// Computes the depth of points in a rectified pair, ``focal_px * baseline_m / disparity_px``.
///
/// Parameters
/// ----------
/// focal_px : float
///     Focal length of both cameras, pixels, > 0.
/// baseline_m : float
///     Distance between the cameras, meters, > 0.
/// disparity_px : float or array_like, shape (N,)
///     ``u_left - u_right``, pixels; see `depth_image` for images.
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
///     Meters. NaN for disparities <= 0.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a single disparity is given and is not above 0.
/// ValueError
///     If the focal length or baseline is not above 0.
///
/// Examples
/// --------
/// >>> depth_from_disparity(500.0, 0.1, 25.0)
/// 2.0
#[pyfunction]
pub(super) fn depth_from_disparity<'py>(
    py: Python<'py>,
    focal_px: f64,
    baseline_m: f64,
    disparity_px: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let depth = |disparity| stereo::depth_from_disparity(focal_px, baseline_m, disparity);
    if let Ok(disparity) = disparity_px.extract::<f64>() {
        return Ok(depth(disparity).or_raise()?.into_pyobject(py)?.into_any());
    }
    let disparities = column("disparity_px", disparity_px)?;
    // An error of the rig is not an error of a disparity.
    depth(1.0).or_raise()?;
    let depths = disparities
        .into_iter()
        .map(|d| depth(f64::from(d)).unwrap_or(f64::NAN));
    Ok(PyArray1::from_vec(py, depths.collect()).into_any())
}

/// Computes the depths between ``f * B / (d + error_px)`` and ``f * B / (d - error_px)``.
///
/// Parameters
/// ----------
/// focal_px : float
///     Focal length of both cameras, pixels, > 0.
/// baseline_m : float
///     Distance between the cameras, meters, > 0.
/// disparity_px : float
///     Pixels.
/// error_px : float
///     Maximum error of the disparity, pixels, >= 0.
///
/// Returns
/// -------
/// DepthInterval
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If no depth is possible, because ``disparity_px + error_px <= 0``.
/// ValueError
///     If the focal length or baseline is not above 0, or ``error_px`` is below 0.
#[pyfunction]
pub(super) fn depth_interval(
    focal_px: f64,
    baseline_m: f64,
    disparity_px: f64,
    error_px: f64,
) -> PyResult<DepthInterval> {
    let interval = stereo::depth_interval(focal_px, baseline_m, disparity_px, error_px);
    let interval = interval.or_raise()?;
    Ok(DepthInterval {
        near_m: interval.near_m,
        far_m: interval.far_m,
    })
}

/// Computes the depth of every pixel, ``focal_px * baseline_m / disparity``.
///
/// Parameters
/// ----------
/// disparity : array_like of float, shape (H, W)
///     Pixels; NaN where unknown.
/// focal_px : float
///     Focal length of both cameras, pixels, > 0.
/// baseline_m : float
///     Distance between the cameras, meters, > 0.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     Meters; NaN where the disparity is unknown or <= 0.
///
/// Raises
/// ------
/// ValueError
///     If the focal length or baseline is not above 0.
#[pyfunction]
pub(super) fn depth_image<'py>(
    disparity: &Bound<'py, PyAny>,
    focal_px: f64,
    baseline_m: f64,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let py = disparity.py();
    let disparity = read("disparity", disparity)?;
    let depth = progress::detach(py, || stereo::depth_image(&disparity, focal_px, baseline_m));
    from_gray(py, depth.or_raise()?)
}

/// Computes points in the first camera's frame, ``(X, Y, Z, W) = Q @ (u, v, d, 1)``.
///
/// Parameters
/// ----------
/// disparity : array_like of float, shape (H, W)
///     Pixels; NaN where unknown.
/// q : array_like, shape (4, 4)
///     `Rectification.q`, or the result of `q_from_rig`.
/// colors : array_like, shape (H, W, 3), optional
///     Rectified first image, uint8.
///
/// Returns
/// -------
/// PointCloud
///     Omits pixels without disparity, points at infinity and points behind the camera.
#[pyfunction]
#[pyo3(signature = (disparity, q, colors=None))]
pub(super) fn point_cloud(
    disparity: &Bound<'_, PyAny>,
    q: &Bound<'_, PyAny>,
    colors: Option<&Bound<'_, PyAny>>,
) -> PyResult<PointCloud> {
    let py = disparity.py();
    let disparity = read("disparity", disparity)?;
    let q: Matrix4<f64> = matrix("q", q)?;
    let colors = colors.map(|colors| rgb("colors", colors)).transpose()?;
    let cloud = progress::detach(py, || stereo::point_cloud(&disparity, &q, colors.as_ref()));
    let cloud = cloud.or_raise()?;
    let num_points = cloud.points.len();
    let colors = match colors {
        Some(_) => {
            let bytes = PyArray1::from_vec(py, cloud.colors.into_flattened());
            Some(bytes.reshape([num_points, 3])?.unbind())
        }
        None => None,
    };
    Ok(PointCloud {
        points: from_points(py, &cloud.points)?.unbind(),
        colors,
        normals: None,
        confidences: None,
    })
}
