//! `ransac-epipolar`: the core's RANSAC on the matches of two photographs, sample by sample.

mod answer;
mod knobs;
mod model;
mod run;
mod view;
mod words;

pub use model::RansacEpipolar;
pub use view::RansacEpipolarView as View;
