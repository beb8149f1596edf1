//! `same-picture`: a mug that grows along its ray, and an unchanged photograph.

mod model;
mod view;
mod words;

pub(super) use view::SamePictureView as View;
