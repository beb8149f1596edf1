//! `patch-match`: five features to match by eye, and the distances of their descriptors.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::PatchMatchView as View;
