//! `epipolar-plane`: two cameras with their photographs in 3D, a point on its ray, and the plane
//! that rotates about the baseline.

mod model;
mod scenery;
mod view;
mod words;

pub(super) use view::EpipolarPlaneView as View;
