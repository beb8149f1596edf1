//! `optimal-plane`: the plane through the baseline that passes both pixels of a match most closely.

mod model;
mod pencil;
mod view;
mod words;

pub(super) use view::OptimalPlaneView as View;
