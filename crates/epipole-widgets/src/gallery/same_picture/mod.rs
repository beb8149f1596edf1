//! `same-picture`: a mug that grows along its ray, and the photograph that never changes.

mod model;
mod view;
mod words;

pub(super) use view::SamePictureView as View;
