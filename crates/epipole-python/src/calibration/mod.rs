//! Calibration by boards.

mod board;
mod calibrate;
mod find;
mod undistort;

pub(crate) use undistort::Undistortion;

use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::calibration::MarkerOptions::default())?;
    crate::options::declare(module, &epipole::calibration::CalibrationOptions::default())?;
    module.add_class::<board::Board>()?;
    module.add_class::<board::BoardDrawing>()?;
    module.add_class::<board::BoardView>()?;
    module.add_class::<find::BoardSearch>()?;
    module.add_class::<find::Marker>()?;
    module.add_class::<find::MarkerDictionary>()?;
    module.add_class::<calibrate::CalibratedView>()?;
    module.add_class::<calibrate::CalibrationWarning>()?;
    module.add_class::<calibrate::Calibration>()?;
    module.add_class::<calibrate::RigCalibration>()?;
    module.add_class::<Undistortion>()?;
    module.add_function(wrap_pyfunction!(find::find_board, module)?)?;
    module.add_function(wrap_pyfunction!(find::detect_markers, module)?)?;
    module.add_function(wrap_pyfunction!(find::render_board, module)?)?;
    module.add_function(wrap_pyfunction!(calibrate::calibrate, module)?)?;
    module.add_function(wrap_pyfunction!(calibrate::calibrate_rig, module)?)?;
    module.add_function(wrap_pyfunction!(calibrate::intrinsics_from_planes, module)?)
}
