//! Two views, whatever they show: a scene with depth, a plane, or a turn of the camera.

mod choice;
mod motion;
mod rotation;

pub use choice::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view,
    estimate_two_view_calibrated,
};
pub use rotation::{RotationEstimator, find_rotation};
