//! Matches between the features of two images: exact nearest neighbors and tests of them.

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
