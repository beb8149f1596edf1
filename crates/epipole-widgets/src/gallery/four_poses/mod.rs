//! `four-poses`: the four camera poses of an essential matrix, from above.

mod model;
mod poses;
mod view;
mod words;

pub(crate) use view::FourPosesView as View;
