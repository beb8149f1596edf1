//! Cameras from photographs of a board: intrinsics, lens, and where a second camera stands.
//!
//! 1. [`find_board`] finds the marks of a chessboard, a grid of circles, a ChArUco board or an
//!    AprilGrid in a photograph; [`detect_markers`] finds ArUco markers and AprilTags alone.
//! 2. [`calibrate`] computes K, the lens and the board's poses from several of these, and says how
//!    sure each number is.
//! 3. [`calibrate_rig`] adds how a second camera stands beside the first.
//! 4. [`photograph_of_board`] makes photographs to try this on, with exact truth.
//! 5. [`Undistortion`] redraws photographs as a camera without distortion would show them.
//!
//! A board lies in its own plane z = 0: x along its columns, y along its rows, the first corner at
//! the origin.

mod advice;
mod blobs;
mod board;
mod board_markers;
mod board_search;
mod board_turns;
mod calibrate;
mod calibrated_view;
mod chessboard;
mod circle_grid;
mod closed_form;
mod contrast;
mod coverage;
mod crossing;
mod drawing;
mod find_board;
mod footprint;
mod lattice;
mod marker_board;
mod markers;
mod near_marks;
mod problem;
mod refine_mark;
mod rig;
mod saddles;
mod start;
mod synthetic;
mod uncertainty;
mod undistort;

pub use advice::CalibrationWarning;
pub use board::{Board, BoardView, Pattern};
pub use board_search::BoardSearch;
pub use calibrate::{Calibration, CalibrationOptions, calibrate};
pub use calibrated_view::CalibratedView;
pub use closed_form::intrinsics_from_planes;
pub use drawing::BoardDrawing;
pub use find_board::find_board;
pub use markers::{Marker, MarkerDictionary, MarkerOptions, detect_markers};
pub use rig::{RigCalibration, calibrate_rig};
pub use synthetic::photograph_of_board;
pub use undistort::{Keep, Undistortion};
