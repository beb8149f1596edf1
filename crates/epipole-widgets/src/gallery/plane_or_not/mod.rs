//! `plane-or-not`: the homography of one plane predicts its points, and misses all others along
//! their epipolar lines.

mod model;
mod view;
mod words;

pub(super) use view::PlaneOrNotView as View;
