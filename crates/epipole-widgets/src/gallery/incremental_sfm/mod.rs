//! `incremental-sfm`: photographs on an arc are registered one after the other.

mod model;
mod question;
mod steps;
mod view;
mod words;

pub(super) use view::IncrementalSfmView as View;
