//! `triangulate`: a point from two noisy rays by four methods, and its error.

mod estimates;
mod guess;
mod model;
mod uncertainty;
mod view;
mod words;

pub(super) use view::TriangulateView as View;
