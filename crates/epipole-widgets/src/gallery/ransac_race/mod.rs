//! `ransac-race`: least squares against RANSAC on a hidden line.

mod model;
mod view;

pub use model::RansacRace;
pub use view::RansacRaceView as View;
