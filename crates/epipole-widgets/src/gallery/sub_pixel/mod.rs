//! `sub-pixel`: a corner between the pixels, from the gradients around it.

mod model;
mod patch;
mod view;
mod words;

pub(super) use view::SubPixelView as View;
