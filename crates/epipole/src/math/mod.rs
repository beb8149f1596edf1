//! Small mathematics that every room needs.

mod line;
pub mod random;
mod svd3;

pub use line::Line2;
pub use svd3::{Svd3, svd3};
