//! `panorama`: photographs of a rotating camera, joined by homographies.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::PanoramaView as View;
