//! Bundle adjustment of cameras with their lenses.

mod adjust;
mod focal;
mod gauge;
mod lens_state;
#[cfg(test)]
mod lens_tests;
mod observation;
mod options;
mod problem;
mod scene;
#[cfg(test)]
mod tests;

pub(super) use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
pub use adjust::adjust_bundle;
pub(in crate::sfm) use focal::focal_sensitivity;
pub use observation::BundleObservation;
pub(super) use observation::observation_pairs;
pub use options::{BundleOptions, Gauge, PositionPrior};
pub use scene::{Bundle, Sensor};
