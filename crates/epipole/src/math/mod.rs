//! Basic mathematics for all modules.

mod geodetic;
mod length;
mod line;
pub(crate) mod monitored;
pub(crate) mod null_space;
pub(crate) mod order;
pub(crate) mod parallel;
pub(crate) mod polynomial;
pub mod random;
pub(crate) mod real_roots;
pub(crate) mod scaling;
pub(crate) mod simd;
pub(crate) mod svd3;
mod union_find;

pub use geodetic::{Geodetic, local_from_geodetic};
pub use length::length;
pub use line::Line2;
pub use null_space::right_singular_vectors;
pub(crate) use svd3::nearest_orthogonal;
pub use svd3::{Svd3, svd3};
pub(crate) use union_find::UnionFind;
