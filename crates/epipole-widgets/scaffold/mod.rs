//! `new-figure`: say in a line what the figure is about.

mod model;
mod view;
mod words;

pub(super) use view::NewFigureView as View;
