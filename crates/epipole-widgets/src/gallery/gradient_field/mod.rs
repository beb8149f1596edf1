//! `gradient-field`: an edge, a photograph, and the gradient at every pixel of it.

mod field;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::GradientFieldView as View;
