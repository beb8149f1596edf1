//! Two views, whatever they show: a scene with depth, a plane, or a turn of the camera.

mod choice;
mod choice_of_rays;
mod degeneracy;
mod motion;
mod options;
mod pairs;
mod rotation;
mod search;
mod turn;
mod turn_and_focal;
mod turn_of_rays;

pub use choice::{
    Configuration, TwoViewModel, TwoViewReport, estimate_two_view, estimate_two_view_calibrated,
};
pub use choice_of_rays::estimate_two_view_of_rays;
pub(crate) use choice_of_rays::plane_of_rays;
pub use degeneracy::{Degeneracy, find_degeneracy, find_unmoved};
pub use options::{PHOTO_MAX_ERROR_PX, TwoViewOptions};
pub use rotation::{RotationEstimator, estimate_rotation};
pub use turn::{ExplainingTurn, find_explaining_turn};
pub use turn_and_focal::{TurnAndFocal, find_turn_and_focal};
pub use turn_of_rays::find_explaining_turn_of_rays;
