//! `bundle-adjustment`: disturbed cameras and points, and the loop that puts all of them right.

mod answer;
mod knobs;
mod model;
mod plots;
mod run;
mod scene;
mod view;
mod words;

pub(crate) use view::BundleAdjustmentView as View;
