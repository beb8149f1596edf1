//! Camera calibration with boards: intrinsics, lens, and the pose of a second camera.
//!
//! 1. [`find_board`] finds the marks of a chessboard, circle grid, ChArUco board or AprilGrid in an
//!    image; [`detect_markers`] finds ArUco markers and AprilTags alone.
//! 2. [`calibrate`] computes K, the lens and the board's poses from several of these, with the
//!    uncertainty of each parameter.
//! 3. [`calibrate_rig`] adds the pose of a second camera relative to the first.
//! 4. [`render_board`] renders test images with exact ground truth.
//! 5. [`Undistortion`] undistorts images.
//!
//! The frame of a board has its plane at z = 0, x along its rows, y along its columns, and the
//! first corner at the origin.

mod advice;
mod blobs;
mod board;
mod board_markers;
mod board_search;
mod board_symmetries;
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
mod grown_marks;
mod lattice;
mod marker_board;
mod markers;
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
pub use synthetic::render_board;
pub use undistort::{Keep, Undistortion};
