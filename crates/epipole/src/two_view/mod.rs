//! Geometry of two views of any scene: with depth, a plane, or under pure rotation.

mod choice;
mod degeneracy;
mod explaining_turn;
mod motion;
mod options;
mod pairs;
mod report;
mod rotation;
mod search;
mod through_lenses;
mod turn;
mod turn_and_focal;
mod turn_through_lenses;

pub use choice::{estimate_two_view, estimate_two_view_calibrated};
pub use degeneracy::{Degeneracy, find_degeneracy, find_unmoved};
pub use explaining_turn::ExplainingTurn;
pub use options::{PHOTO_MAX_ERROR_PX, TwoViewOptions};
pub use report::{Configuration, TwoViewModel, TwoViewReport};
pub(crate) use rotation::align_rays;
pub use rotation::{RotationEstimator, estimate_rotation};
pub(crate) use through_lenses::find_plane_through_lenses;
pub use turn::find_explaining_turn;
pub use turn_and_focal::{TurnAndFocal, find_turn_and_focal};
