//! `bundle-adjustment`: disturbed cameras and points, and the loop that corrects all of them.

mod model;
mod question;
mod view;
mod words;

pub(crate) use view::BundleAdjustmentView as View;
