//! `panorama`: photographs of a camera that turned, joined by homographies.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::PanoramaView as View;
