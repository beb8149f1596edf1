//! Calibration by boards.

mod board;
mod calibrate;
mod find;
mod undistort;

pub(crate) use undistort::Undistortion;

use crate::register::{classes, functions};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::calibration::MarkerOptions::default())?;
    crate::options::declare(module, &epipole::calibration::CalibrationOptions::default())?;
    classes!(module:
        board::Board, board::BoardDrawing, board::BoardView, find::BoardSearch, find::Marker,
        find::MarkerDictionary, calibrate::CalibratedView, calibrate::CalibrationWarning,
        calibrate::Calibration, calibrate::RigCalibration, Undistortion
    );
    functions!(module:
        find::find_board, find::detect_markers, find::render_board, calibrate::calibrate,
        calibrate::calibrate_rig, calibrate::intrinsics_from_planes
    );
    Ok(())
}
