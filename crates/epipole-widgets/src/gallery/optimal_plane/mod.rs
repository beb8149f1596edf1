//! `optimal-plane`: the plane through the baseline that passes closest to both pixels of a match.

mod model;
mod pencil;
mod view;
mod words;

pub(super) use view::OptimalPlaneView as View;
