//! `scale-space`: a photograph at increasing blur, and the sizes of the things in it.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::ScaleSpaceView as View;
