//! `ransac-race`: least squares against RANSAC on a hidden line.

mod knobs;
mod model;
mod run;
mod view;
mod words;

pub use model::RansacRace;
pub use view::RansacRaceView as View;
