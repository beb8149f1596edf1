//! `epipolar-click`: a point in one photograph, its epipolar line in the other.

mod model;
mod view;
mod words;

pub(crate) use view::EpipolarClickView as View;
