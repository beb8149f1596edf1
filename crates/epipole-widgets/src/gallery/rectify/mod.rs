//! `rectify`: turning two cameras about their own centers until epipolar lines are rows.

mod model;
mod turned;
mod view;
mod words;

pub(super) use view::RectifyView as View;
