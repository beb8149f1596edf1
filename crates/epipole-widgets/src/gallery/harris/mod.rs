//! `harris`: an image and its corner response, with a probe for the structure tensor.

mod model;
mod question;
mod view;
mod words;

pub use view::HarrisView as View;
