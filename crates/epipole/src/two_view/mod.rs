//! Two views, whatever they show: a scene with depth, a plane, or a turn of the camera.

mod choice;
mod motion;
mod options;
mod pairs;
mod rotation;
mod search;
mod turn;

pub use choice::{
    Configuration, TwoViewModel, TwoViewReport, estimate_two_view, estimate_two_view_calibrated,
    estimate_two_view_calibrated_with, estimate_two_view_with,
};
pub use options::{PHOTO_MAX_ERROR_PX, TwoViewOptions};
pub use rotation::{RotationEstimator, estimate_rotation};
pub use search::{TwoViewObserver, TwoViewSearch, TwoViewTrial};
pub use turn::{ExplainingTurn, find_explaining_turn};
