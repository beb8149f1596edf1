//! `outlier-drag`: the reader drags one match away, and F with all epipolar lines follows it.

mod fit;
mod model;
mod view;
mod words;

pub(super) use view::OutlierDragView as View;
