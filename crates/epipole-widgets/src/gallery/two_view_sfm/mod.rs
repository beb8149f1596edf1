//! `two-view-sfm`: from two photographs to a colored cloud, stage by stage.

mod model;
mod question;
mod verdict;
mod view;
mod words;

pub(crate) use view::TwoViewSfmView as View;
