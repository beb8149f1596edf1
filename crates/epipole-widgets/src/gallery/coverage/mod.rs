//! `coverage`: focal length and distortion, estimated from boards that cover a part of the image.

mod boards;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::CoverageView as View;
