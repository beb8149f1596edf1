//! `two-view-sfm`: from two photographs to a colored cloud, stage by stage.

pub(super) mod model;
pub(super) mod question;
mod surface;
mod verdict;
pub(super) mod view;
mod words;

pub(crate) use view::TwoViewSfmView as View;
