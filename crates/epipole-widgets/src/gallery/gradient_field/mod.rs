//! `gradient-field`: an edge or a photograph, and its gradient at every pixel.

mod field;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::GradientFieldView as View;
