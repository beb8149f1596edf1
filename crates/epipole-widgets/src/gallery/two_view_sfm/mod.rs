//! `two-view-sfm`: from two photographs to a colored cloud, stage by stage.

mod answer;
mod model;
mod pipeline;
mod view;
mod words;

pub(crate) use view::TwoViewSfmView as View;
