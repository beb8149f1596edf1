//! `two-view-sfm`: from two photographs to a colored cloud, stage by stage.

mod model;
mod view;
mod words;

pub(super) use view::TwoViewSfmView as View;
