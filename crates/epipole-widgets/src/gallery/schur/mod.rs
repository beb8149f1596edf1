//! `schur`: the blocks of the normal equations, and the system after elimination of the points.

mod blocks;
mod model;
mod view;
mod words;

pub(super) use view::SchurView as View;
