//! `eight-point`: the fundamental matrix from exact or noisy matches, with and without
//! normalization, with and without rank 2.

mod estimate;
mod model;
mod question;
mod view;
mod words;

pub use view::EightPointView as View;
