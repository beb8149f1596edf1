//! Calibration of cameras and rigs.

use super::board::{Board, BoardView};
use crate::arrays::matrix;
use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::errors::OrRaise;
use crate::progress;
use crate::record::record;
use crate::sfm::wrapper::wrapper;
use epipole::calibration::{self, CalibrationWarning as Warning};
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Calibration result of one view.
///
/// Parameters
/// ----------
/// cam_from_board : RigidTransform
///     Pose of the board, meters.
/// rms_px : float
///     Root mean square of the reprojection errors of the view, pixels.
/// num_marks : int
///     Number of visible marks.
#[pyclass(frozen, module = "epipole.calibration")]
pub(crate) struct CalibratedView(calibration::CalibratedView);

wrapper!(CalibratedView: cam_from_board, rms_px, num_marks);

#[pymethods]
impl CalibratedView {
    #[new]
    fn new(cam_from_board: &RigidTransform, rms_px: f64, num_marks: usize) -> Self {
        Self(calibration::CalibratedView {
            cam_from_board: cam_from_board.0,
            rms_px,
            num_marks,
        })
    }

    /// Pose of the board, meters.
    #[getter]
    fn cam_from_board(&self) -> RigidTransform {
        self.0.cam_from_board.into()
    }

    /// Root mean square of the reprojection errors of the view, pixels.
    #[getter]
    fn rms_px(&self) -> f64 {
        self.0.rms_px
    }

    /// Number of visible marks.
    #[getter]
    fn num_marks(&self) -> usize {
        self.0.num_marks
    }
}

record! {
    /// Cause of uncertainty that the errors of a calibration do not reveal.
    "epipole.calibration" CalibrationWarning {
        /// "parallel", "uncertain_focal", "low_coverage" or "bad_view".
        kind: String,
        /// Cause in words, as a sentence.
        message: String,
    }
}

impl From<&Warning> for CalibrationWarning {
    fn from(warning: &Warning) -> Self {
        let kind = match warning {
            Warning::Parallel { .. } => "parallel",
            Warning::UncertainFocal { .. } => "uncertain_focal",
            Warning::LowCoverage { .. } => "low_coverage",
            Warning::BadView { .. } => "bad_view",
            _ => "other",
        };
        Self {
            kind: kind.to_owned(),
            message: warning.to_string(),
        }
    }
}

record! {
    /// Calibrated camera and its uncertainty.
    "epipole.calibration" Calibration {
        /// Camera.
        camera: Camera,
        /// Root mean square of all reprojection errors (distances), pixels.
        rms_px: f64,
        /// Standard deviation of fu, fv, cu, cv, pixels, shape (4,).
        std_dev_k: Py<PyArray1<f64>>,
        /// Standard deviation of each lens coefficient.
        std_dev_lens: Py<PyArray1<f64>>,
        /// Fraction of the image area covered by marks of some view, 0 to 1.
        coverage: f64,
        /// `CalibratedView` of each given view, or None where none was given.
        views: Vec<Option<Py<CalibratedView>>>,
        /// List of `CalibrationWarning`.
        warnings: Vec<Py<CalibrationWarning>>,
    }
}

/// Converts views to those of the library.
fn views(views: Vec<Option<BoardView>>) -> Vec<Option<calibration::BoardView>> {
    views.into_iter().map(|view| Some(view?.0)).collect()
}

/// Calibrates a camera: estimates intrinsics, lens and board poses with minimal error.
///
/// Parameters
/// ----------
/// board : Board
/// views : list of BoardView or None
///     Marks in each photo; None for a photo without a board.
/// size : tuple of int
///     Width and height of all photos, pixels.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : CalibrationOptions
///     ``lens``, the lens model, such as ``"brown"`` or ``"fisheye"``; ``max_iterations``.
///
/// Returns
/// -------
/// Calibration
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 views, or a view has fewer than 4 marks.
/// epipole.DegenerateError
///     If the marks of a view lie on a line, or the boards are parallel or fit no camera.
/// ValueError
///     If the image size is 0.
#[pyfunction]
#[pyo3(signature = (board, views, size, *, progress=None, **options))]
pub(super) fn calibrate(
    py: Python<'_>,
    board: &Board,
    views: Vec<Option<BoardView>>,
    size: (u32, u32),
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Calibration> {
    let (board, views) = (&board.board, self::views(views));
    let found = progress::run_with(py, progress, options, |options, monitor| {
        calibration::calibrate(board, &views, size, options, monitor)
    })?;
    let view = |view: Option<calibration::CalibratedView>| {
        view.map(|view| Py::new(py, CalibratedView(view)))
            .transpose()
    };
    let warnings = found.warnings.iter();
    let warnings = warnings.map(|warning| Py::new(py, CalibrationWarning::from(warning)));
    Ok(Calibration {
        camera: found.camera.into(),
        rms_px: found.rms_px,
        std_dev_k: PyArray1::from_slice(py, &found.std_dev_k).unbind(),
        std_dev_lens: PyArray1::from_vec(py, found.std_dev_lens).unbind(),
        coverage: found.coverage,
        views: found.views.into_iter().map(view).collect::<PyResult<_>>()?,
        warnings: warnings.collect::<PyResult<_>>()?,
    })
}

record! {
    /// Calibrated rig of two cameras.
    "epipole.calibration" RigCalibration {
        /// ``x_in_right = right_from_left @ x_in_left``, meters.
        right_from_left: RigidTransform,
        /// Distance between the cameras, meters.
        baseline_m: f64,
        /// Root mean square of the reprojection errors in both cameras, pixels.
        rms_px: f64,
        /// Standard deviation of the rotation about the axes of the right camera, radians, shape
        /// (3,).
        std_dev_rotation_rad: Py<PyArray1<f64>>,
        /// Standard deviation of the translation, meters, shape (3,).
        std_dev_translation_m: Py<PyArray1<f64>>,
        /// Root mean square of each pair, pixels; None unless both cameras see the board.
        pairs_rms_px: Vec<Option<f64>>,
    }
}

/// Calibrates the relative pose of two calibrated cameras that see the same boards.
///
/// Parameters
/// ----------
/// board : Board
/// cameras : tuple of Camera
///     Left and right camera.
/// left, right : list of BoardView or None
///     Marks in the photos of each camera, in pairs.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// RigCalibration
///
/// Raises
/// ------
/// epipole.TooFewError
///     If the cameras see no board in common, or a view has fewer than 4 marks.
/// epipole.DegenerateError
///     If the marks of a view lie on a line, or not on a plane in front of the camera.
/// ValueError
///     If the image size of the camera is 0.
#[pyfunction]
#[pyo3(signature = (board, cameras, left, right, *, progress=None))]
pub(super) fn calibrate_rig(
    py: Python<'_>,
    board: &Board,
    cameras: [Camera; 2],
    left: Vec<Option<BoardView>>,
    right: Vec<Option<BoardView>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<RigCalibration> {
    let cameras = cameras.map(|camera| camera.0);
    let (board, left, right) = (&board.board, views(left), views(right));
    let rig = progress::run(py, progress, |monitor| {
        calibration::calibrate_rig(board, &cameras, &left, &right, monitor)
    })?;
    Ok(RigCalibration {
        right_from_left: rig.right_from_left.into(),
        baseline_m: rig.baseline_m,
        rms_px: rig.rms_px,
        std_dev_rotation_rad: rig.std_dev_rotation_rad.to_pyarray(py).unbind(),
        std_dev_translation_m: rig.std_dev_translation_m.to_pyarray(py).unbind(),
        pairs_rms_px: rig.pairs_rms_px,
    })
}

/// Computes K from homographies of planes, in closed form (Zhang).
///
/// Parameters
/// ----------
/// pixels_from_plane : array_like, shape (N, 3, 3)
///     Homographies from a plane, in its own unit, to pixels, N >= 3.
///
/// Returns
/// -------
/// Intrinsics
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 homographies.
/// epipole.DegenerateError
///     If the planes are parallel, or the noise is so strong that no camera fits.
#[pyfunction]
pub(super) fn intrinsics_from_planes(pixels_from_plane: &Bound<'_, PyAny>) -> PyResult<Intrinsics> {
    let planes = pixels_from_plane.try_iter()?.enumerate();
    let read = |(place, plane): (usize, PyResult<Bound<'_, PyAny>>)| {
        matrix::<3, 3>(&format!("pixels_from_plane[{place}]"), &plane?)
    };
    let planes: Vec<_> = planes.map(read).collect::<PyResult<_>>()?;
    Ok(calibration::intrinsics_from_planes(&planes)
        .or_raise()?
        .into())
}
