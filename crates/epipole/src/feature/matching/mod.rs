//! Matching of features between two images: exact nearest neighbors and filters.

mod dense;
mod dots;
mod floats;
mod hamming;
mod integers;
mod nearest;
mod neighbors;
mod options;
mod select;

pub use nearest::{match_descriptors, nearest_few, nearest_two};
pub use neighbors::Neighbors;
pub use options::MatchOptions;
pub use select::Match;
