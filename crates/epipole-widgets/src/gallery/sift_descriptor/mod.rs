//! `sift-descriptor`: a patch of a photograph and its descriptor, while the photograph changes.

mod comparison;
mod model;
mod prints;
mod question;
mod view;
mod words;

pub(super) use view::SiftDescriptorView as View;
