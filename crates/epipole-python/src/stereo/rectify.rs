//! Rectification of a calibrated rig.

use super::pixel_map::PixelMap;
use crate::arrays::{Batch, from_matrices, from_matrix, matrix, points3};
use crate::camera::{Camera, Intrinsics, RigidTransform, rotation};
use crate::errors::OrRaise;
use crate::record::{plain_class, record};
use crate::{options, progress};
use epipole::Error;
use epipole::nalgebra::{Matrix3, Point2, Point3, Rotation3, Vector3};
use epipole::stereo;
use numpy::{PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Rectangle of pixel coordinates.
    "epipole.stereo" PixelRect {
        /// Left edge.
        u_min: f64,
        /// Top edge.
        v_min: f64,
        /// Right edge.
        u_max: f64,
        /// Bottom edge.
        v_max: f64,
    }
}

impl From<stereo::PixelRect> for PixelRect {
    fn from(rect: stereo::PixelRect) -> Self {
        Self {
            u_min: rect.u_min,
            v_min: rect.v_min,
            u_max: rect.u_max,
            v_max: rect.v_max,
        }
    }
}

impl PixelRect {
    fn core(&self) -> stereo::PixelRect {
        stereo::PixelRect {
            u_min: self.u_min,
            v_min: self.v_min,
            u_max: self.u_max,
            v_max: self.v_max,
        }
    }
}

/// Rectified rig: two virtual parallel cameras with the same focal length.
///
/// Matches share a row, or a column if `is_vertical`. Created by `rectify_calibrated`.
///
/// Parameters
/// ----------
/// cameras : tuple of Camera
///     Cameras of the photos.
/// rect_from_cam : array_like, shape (2, 3, 3)
///     Rotations of the cameras' rays into the rectified frame.
/// intrinsics : tuple of Intrinsics
///     Intrinsics of the rectified images.
/// homographies : array_like, shape (2, 3, 3)
///     Homographies from undistorted pixels of the photos to rectified pixels.
/// q : array_like, shape (4, 4)
///     ``(X, Y, Z, W) = q @ (u, v, d, 1)``.
/// is_vertical : bool
/// baseline_m : float
///     Distance between the cameras, meters.
/// width, height : int
///     Size of the rectified images, pixels.
/// valid : tuple of PixelRect
///     Part of each rectified image that its photo fills.
///
/// Raises
/// ------
/// ValueError
///     If a matrix in ``rect_from_cam`` is not a rotation.
#[pyclass(frozen, module = "epipole.stereo")]
pub(super) struct Rectification(pub(super) stereo::Rectification);

plain_class!(
    Rectification: cameras, rect_from_cam, intrinsics, homographies, q, is_vertical, baseline_m,
    width, height, valid
);

#[pymethods]
impl Rectification {
    #[new]
    #[allow(clippy::too_many_arguments)]
    fn new(
        cameras: (Camera, Camera),
        rect_from_cam: [Bound<'_, PyAny>; 2],
        intrinsics: (Intrinsics, Intrinsics),
        homographies: [Bound<'_, PyAny>; 2],
        q: &Bound<'_, PyAny>,
        is_vertical: bool,
        baseline_m: f64,
        width: u32,
        height: u32,
        valid: (PyRef<'_, PixelRect>, PyRef<'_, PixelRect>),
    ) -> PyResult<Self> {
        let read_rotation =
            |value| rotation("rect_from_cam", value).map(Rotation3::from_matrix_unchecked);
        let homography = |value| matrix::<3, 3>("homographies", value);
        Ok(Self(stereo::Rectification {
            cameras: [cameras.0.0, cameras.1.0],
            rect_from_cam: [
                read_rotation(&rect_from_cam[0])?,
                read_rotation(&rect_from_cam[1])?,
            ],
            intrinsics: [intrinsics.0.0, intrinsics.1.0],
            homographies: [homography(&homographies[0])?, homography(&homographies[1])?],
            q: matrix("q", q)?,
            is_vertical,
            baseline_m,
            width,
            height,
            valid: [valid.0.core(), valid.1.core()],
        }))
    }

    /// Cameras of the photos, a pair.
    #[getter]
    fn cameras(&self) -> (Camera, Camera) {
        self.0.cameras.map(Camera::from).into()
    }

    /// Rotations of the cameras' rays into the rectified frame, shape (2, 3, 3).
    #[getter]
    fn rect_from_cam<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let rotations: [Matrix3<f64>; 2] = self.0.rect_from_cam.map(Rotation3::into_inner);
        from_matrices(py, &rotations)
    }

    /// Intrinsics of the rectified images, a pair.
    #[getter]
    fn intrinsics(&self) -> (Intrinsics, Intrinsics) {
        self.0.intrinsics.map(Intrinsics::from).into()
    }

    /// Homographies from undistorted pixels of the photos to rectified pixels, shape (2, 3, 3).
    #[getter]
    fn homographies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        from_matrices(py, &self.0.homographies)
    }

    /// Q, ``(X, Y, Z, W) = Q @ (u, v, d, 1)`` in camera 1's rectified frame, shape (4, 4).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.q)
    }

    /// Whether matches share a column: the second camera is above or below the first.
    #[getter]
    fn is_vertical(&self) -> bool {
        self.0.is_vertical
    }

    /// Distance between the cameras, meters.
    #[getter]
    fn baseline_m(&self) -> f64 {
        self.0.baseline_m
    }

    /// Width of the rectified images, pixels.
    #[getter]
    fn width(&self) -> u32 {
        self.0.width
    }

    /// Height of the rectified images, pixels.
    #[getter]
    fn height(&self) -> u32 {
        self.0.height
    }

    /// Large rectangles of the rectified images that are full of image content, a pair.
    #[getter]
    fn valid(&self) -> (PixelRect, PixelRect) {
        self.0.valid.map(PixelRect::from).into()
    }

    /// Maps pixels of photo 0 or 1 to rectified pixels.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     0 or 1.
    /// pixel : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray of the same shape
    ///     Rows of NaN for pixels behind the rectified camera.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single pixel is given and has no ray, or its ray is behind the rectified camera.
    /// ValueError
    ///     If ``index`` is not 0 or 1.
    fn rectify_pixel<'py>(
        &self,
        index: usize,
        pixel: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.require_index(index)?;
        let rectify = |p: &_| Ok(self.0.rectify_pixel(index, &Point2::from(*p))?.coords);
        Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), rectify)
    }

    /// Maps rectified pixels to pixels of photo 0 or 1.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     0 or 1.
    /// rectified : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray of the same shape
    ///     Rows of NaN for pixels outside the camera's view.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single pixel is given and the camera does not see it.
    /// ValueError
    ///     If ``index`` is not 0 or 1.
    fn source_pixel<'py>(
        &self,
        index: usize,
        rectified: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.require_index(index)?;
        let source = |p: &_| match self.0.source_pixel(index, &Point2::from(*p))? {
            Some(pixel) => Ok(pixel.coords),
            None => Err(unseen("the pixel of the photo")),
        };
        Batch::<2>::read("rectified", rectified)?.vectors(rectified.py(), source)
    }

    /// Creates the map that rectifies photo 0 or 1.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     0 for the first camera, 1 for the second.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If ``index`` is not 0 or 1.
    #[pyo3(signature = (index, *, progress=None))]
    fn map(&self, py: Python<'_>, index: usize, progress: Option<Py<PyAny>>) -> PyResult<PixelMap> {
        Ok(PixelMap(progress::run(py, progress, |monitor| {
            self.0.map(index, monitor)
        })?))
    }

    /// Projects points into the first rectified image, with their disparities.
    ///
    /// Parameters
    /// ----------
    /// place : array_like, shape (3,) or (N, 3)
    ///     Points in the frame of the first photo's camera, in the unit of the baseline.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (3,) or (N, 3)
    ///     (u, v, disparity), pixels. Rows of NaN for points behind the camera.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single point is given and a camera does not see it.
    fn disparity_of<'py>(&self, place: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let disparity = |x: &_| match self.0.disparity_of(&Point3::from(*x)) {
            Some((pixel, disparity)) => Ok(Vector3::new(pixel.x, pixel.y, disparity)),
            None => Err(unseen("the disparity of the point")),
        };
        Batch::<3>::read("place", place)?.vectors(place.py(), disparity)
    }

    /// Returns the minimum and maximum disparity to search, pixels, from points in both photos.
    ///
    /// Parameters
    /// ----------
    /// places : array_like, shape (N, 3)
    ///     Points in the frame of the first photo's camera, in the unit of the baseline.
    ///
    /// Returns
    /// -------
    /// first, last : int
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If the first image shows fewer than 8 points.
    fn disparity_range(&self, places: &Bound<'_, PyAny>) -> PyResult<(i32, i32)> {
        let range = self.0.disparity_range(&points3("places", places)?);
        Ok(range.or_raise()?.into())
    }
}

impl Rectification {
    /// Rejects an invalid index even where errors of single pixels become NaN.
    fn require_index(&self, index: usize) -> PyResult<()> {
        (self.0.source_pixel(index, &Point2::origin())).or_raise()?;
        Ok(())
    }
}

fn unseen(what: &'static str) -> Error {
    Error::Degenerate {
        what,
        why: "the camera does not see it",
    }
}

/// Rectifies two calibrated cameras.
///
/// Parameters
/// ----------
/// camera1, camera2 : Camera
///     Cameras of the first (left) and second (right) photo, with equal image sizes.
/// cam2_from_cam1 : RigidTransform
///     Translation in meters.
/// **options : RectifyOptions
///     ``alpha=0.0``: from 0, only valid pixels, to 1, all pixels of the photos; ``size=(width,
///     height)`` of the rectified images, pixels; ``zero_disparity_at_infinity=True``.
///
/// Returns
/// -------
/// Rectification
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the cameras are at the same position, the baseline is more than 60° off the image plane,
///     a camera looks along the baseline, or the lens model folds less than halfway to the border.
/// ValueError
///     If the cameras differ in image size, ``alpha`` is outside [0, 1], or a side is shorter than
///     2 pixels.
#[pyfunction]
#[pyo3(signature = (camera1, camera2, cam2_from_cam1, **options))]
pub(super) fn rectify_calibrated(
    py: Python<'_>,
    camera1: &Camera,
    camera2: &Camera,
    cam2_from_cam1: &RigidTransform,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Rectification> {
    let options = options::read(options)?;
    let (cameras, motion) = ([camera1.0, camera2.0], cam2_from_cam1.0);
    let rig = progress::detach(py, || {
        stereo::rectify_calibrated(&cameras, &motion, &options)
    });
    Ok(Rectification(rig.or_raise()?))
}

/// Computes Q of a rectified pair with common focal length and principal point.
///
/// Parameters
/// ----------
/// focal_px : float
///     Focal length, pixels, > 0.
/// baseline_m : float
///     Distance between the cameras, meters, > 0.
/// cu_px, cv_px : float
///     Principal point, pixels.
///
/// Returns
/// -------
/// ndarray, shape (4, 4)
///     ``(X, Y, Z, W) = Q @ (u, v, d, 1)``
///
/// Raises
/// ------
/// ValueError
///     If the focal length or baseline is not above 0.
#[pyfunction]
pub(super) fn q_from_rig(
    py: Python<'_>,
    focal_px: f64,
    baseline_m: f64,
    cu_px: f64,
    cv_px: f64,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let q = stereo::q_from_rig(focal_px, baseline_m, cu_px, cv_px);
    from_matrix(py, &q.or_raise()?)
}
