//! `four-poses`: a top view of the four camera poses of an essential matrix.

mod model;
mod poses;
mod view;
mod words;

pub(crate) use view::FourPosesView as View;
