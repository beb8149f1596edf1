//! `homography-drag`: four corners of a rectangle rectify its plane, and a ruler measures on it.

mod model;
mod view;
mod words;

pub(super) use view::HomographyDragView as View;
