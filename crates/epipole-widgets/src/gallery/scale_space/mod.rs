//! `scale-space`: a photograph at increasing blur, and the sizes of its blobs.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::ScaleSpaceView as View;
