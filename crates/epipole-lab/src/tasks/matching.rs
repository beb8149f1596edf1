//! Matches of two photographs.

use super::convert::sentence;
use super::{Described, Match, MatchOptions, Progress, Told};
use epipole::feature::{Descriptors, match_descriptors};

/// Matches descriptors.
///
/// # Errors
/// As [`match_descriptors`], if `progress` wants no more, too.
pub(super) fn matches(
    first: Described,
    second: Described,
    options: &MatchOptions,
    progress: Progress<'_>,
) -> Result<Vec<Match>, String> {
    let how = epipole::feature::MatchOptions::default()
        .with_max_ratio(Some(options.ratio))
        .with_mutual(options.mutual);
    let mut watch = |_| progress(Told::Share(0.0, ""));
    let (first, second) = (read(first)?, read(second)?);
    let found = match_descriptors(&first, &second, &how, &mut watch);
    let found = found.map_err(sentence)?;
    let plain = |m: &epipole::feature::Match| Match {
        first: m.index1 as u32,
        second: m.index2 as u32,
        ratio: m.ratio,
    };
    Ok(found.iter().map(plain).collect())
}

fn read(described: Described) -> Result<Descriptors, String> {
    let dimension = described.dimension as usize;
    Descriptors::from_bytes(dimension, described.values.0.to_vec())
        .map_err(|error| error.to_string())
}
