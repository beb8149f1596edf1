//! `rectify`: rotation of two cameras about their centers until epipolar lines become rows.

mod model;
mod turned;
mod view;
mod words;

pub(super) use view::RectifyView as View;
