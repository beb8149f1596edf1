//! `bundle-adjustment`: disturbed cameras and points, and the loop that puts all of them right.

mod model;
mod question;
mod view;
mod words;

pub(crate) use view::BundleAdjustmentView as View;
