//! Matches between the features of two images: exact nearest neighbors and tests of them.

mod dense;
mod dots;
mod euclidean;
mod floats;
mod hamming;
mod integers;
mod neighbors;
mod options;
mod select;

pub use euclidean::{match_descriptors, nearest_few, nearest_two};
pub use hamming::{BinaryDescriptors, match_hamming, nearest_two_hamming};
pub use neighbors::Neighbors;
pub use options::MatchOptions;
pub use select::Match;
