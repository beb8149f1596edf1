//! `cover`: the pipeline of the book in five steps, from two photographs to a cloud of points.

mod model;
mod view;
mod words;

pub(super) use view::CoverView as View;
