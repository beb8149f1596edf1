//! `schur`: the blocks of the normal equations, and what is left once the points are eliminated.

mod blocks;
mod model;
mod view;
mod words;

pub(super) use view::SchurView as View;
