//! `ransac-epipolar`: the core's RANSAC on the matches of two photographs, sample by sample.

mod matches;
mod model;
mod question;
mod view;
mod votes;
mod words;

pub use view::RansacEpipolarView as View;
