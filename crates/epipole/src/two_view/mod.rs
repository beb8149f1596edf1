//! Two views, whatever they show: a scene with depth, a plane, or a turn of the camera.

mod choice;
mod degeneracy;
mod motion;
mod options;
mod pairs;
mod rotation;
mod search;
mod through_lenses;
mod turn;
mod turn_and_focal;
mod turn_through_lenses;

pub use choice::{
    Configuration, TwoViewModel, TwoViewReport, estimate_two_view, estimate_two_view_calibrated,
};
pub use degeneracy::{Degeneracy, find_degeneracy, find_unmoved};
pub use options::{PHOTO_MAX_ERROR_PX, TwoViewOptions};
pub use rotation::{RotationEstimator, estimate_rotation};
pub(crate) use through_lenses::find_plane_through_lenses;
pub use turn::{ExplainingTurn, find_explaining_turn};
pub use turn_and_focal::{TurnAndFocal, find_turn_and_focal};
