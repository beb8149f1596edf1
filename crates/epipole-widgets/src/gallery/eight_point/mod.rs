//! `eight-point`: the fundamental matrix from exact or noisy matches, with and without
//! normalization, with and without rank 2.

mod estimate;
mod matches;
mod model;
mod view;

pub use model::EightPoint;
pub use view::EightPointView as View;
