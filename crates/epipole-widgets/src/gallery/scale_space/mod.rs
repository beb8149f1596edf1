//! `scale-space`: a photograph blurred more and more, and how large the things in it are.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::ScaleSpaceView as View;
