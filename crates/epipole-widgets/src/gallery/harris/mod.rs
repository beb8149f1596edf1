//! `harris`: an image and its corner response, with a probe for the structure tensor.

mod answer;
mod model;
mod view;

pub use model::Harris;
pub use view::HarrisView as View;
