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
        board::{Board, BoardDrawing, BoardView},
        find::{BoardSearch, Marker, MarkerDictionary},
        calibrate::{CalibratedView, CalibrationWarning, Calibration, RigCalibration},
        undistort::{Undistortion}
    );
    functions!(module:
        find::{find_board, detect_markers, render_board},
        calibrate::{calibrate, calibrate_rig, intrinsics_from_planes}
    );
    Ok(())
}
