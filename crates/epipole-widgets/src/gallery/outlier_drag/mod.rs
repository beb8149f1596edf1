//! `outlier-drag`: one match is dragged away, and F follows it with all epipolar lines.

mod fit;
mod model;
mod view;
mod words;

pub(super) use view::OutlierDragView as View;
