//! `epipolar-click`: a point in one photograph, its epipolar line in the other.

mod model;
mod view;

pub(super) use view::EpipolarClickView;
