//! `triangulate`: the place where two noisy rays all but meet, by four methods, and how far it is off.

mod estimates;
mod model;
mod uncertainty;
mod view;
mod words;

pub(super) use view::TriangulateView as View;
