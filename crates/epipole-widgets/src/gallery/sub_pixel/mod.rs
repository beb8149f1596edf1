//! `sub-pixel`: a corner at subpixel accuracy, from the gradients around it.

mod model;
mod patch;
mod view;
mod words;

pub(super) use view::SubPixelView as View;
