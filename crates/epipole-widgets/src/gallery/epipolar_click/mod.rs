//! `epipolar-click`: a point in one photograph, its epipolar line in the other.

mod knobs;
mod model;
mod view;
mod words;

pub(super) use view::EpipolarClickView;
