//! `plane-or-not`: the homography of a plane predicts its points, and is wrong for all others along
//! their epipolar lines.

mod model;
mod view;
mod words;

pub(super) use view::PlaneOrNotView as View;
