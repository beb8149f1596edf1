//! Geometry of two views of any scene: with depth, a plane, or under pure rotation.

mod choice;
mod degeneracy;
mod explaining_rotation;
mod motion;
mod options;
mod pairs;
mod report;
mod rotation;
mod rotation_and_focal;
mod rotation_search;
mod rotation_through_lenses;
mod search;
mod through_lenses;

pub use choice::{estimate_two_view, estimate_two_view_calibrated};
pub use degeneracy::{Degeneracy, find_degeneracy, find_unmoved};
pub use explaining_rotation::ExplainingRotation;
pub use options::{PHOTO_MAX_ERROR_PX, TwoViewOptions};
pub use report::{Configuration, TwoViewModel, TwoViewReport};
pub(crate) use rotation::align_rays;
pub use rotation::{RotationEstimator, estimate_rotation};
pub use rotation_and_focal::{RotationAndFocal, find_rotation_and_focal};
pub use rotation_search::find_explaining_rotation;
pub(crate) use through_lenses::find_plane_through_lenses;
