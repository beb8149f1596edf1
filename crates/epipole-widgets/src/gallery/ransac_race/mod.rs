//! `ransac-race`: least squares against RANSAC on a hidden line.

mod fits;
mod model;
mod view;
mod words;

pub use view::RansacRaceView as View;
