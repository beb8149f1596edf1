//! `new-figure`: say in a line what the figure is about.

mod model;
mod view;

pub use model::NewFigure;
pub use view::NewFigureView as View;
