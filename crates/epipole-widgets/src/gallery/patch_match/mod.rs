//! `patch-match`: five features to be matched by eye, and what their descriptors say.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::PatchMatchView as View;
