//! `bundle-adjustment`: perturbed cameras and points, and the loop that corrects them.

mod model;
mod question;
mod view;
mod words;

pub(crate) use view::BundleAdjustmentView as View;
