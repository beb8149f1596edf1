//! `epipolar-plane`: two cameras with their photographs in space, a point on its ray, and the plane
//! that hinges about the baseline.

mod model;
mod scenery;
mod view;
mod words;

pub(super) use view::EpipolarPlaneView as View;
