//! `four-poses`: the four poses that an essential matrix allows, and the one in front.

mod model;
mod view;

pub(crate) use view::FourPosesView as View;
