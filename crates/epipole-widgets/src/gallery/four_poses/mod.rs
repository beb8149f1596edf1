//! `four-poses`: what an essential matrix says of two cameras, four times, from above.

mod model;
mod poses;
mod view;
mod words;

pub(crate) use view::FourPosesView as View;
