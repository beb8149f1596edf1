//! COLMAP's cameras alone: `cameras.txt` or `cameras.bin`. A camera's name is its ID.
//!
//! Source: COLMAP's documentation, "Output format".

use super::named::Cameras;
use crate::Result;
use crate::colmap::cameras::{
    ListedCamera, read_cameras_binary, read_cameras_text, write_cameras_text,
};
use std::collections::BTreeSet;

/// Returns whether the first line with content is `ID MODEL WIDTH …`.
pub(super) fn is_text(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    let mut words = first.unwrap_or_default().split_whitespace();
    let is_model = |word: &str| word.bytes().all(|b| b.is_ascii_uppercase() || b == b'_');
    words.next().is_some_and(|id| id.parse::<u32>().is_ok())
        && words.next().is_some_and(is_model)
        && words.next().is_some()
}

/// Returns whether bytes begin with a number of cameras that they can hold.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let count = bytes.first_chunk().map(|first| u64::from_le_bytes(*first));
    let room = (bytes.len() / 24) as u64;
    bytes.contains(&0) && count.is_some_and(|count| (1..=room).contains(&count))
}

pub(super) fn read_text(text: &str) -> Result<Cameras> {
    with_names(read_cameras_text(text)?)
}

pub(super) fn read_binary(bytes: &[u8]) -> Result<Cameras> {
    with_names(read_cameras_binary(bytes)?)
}

fn with_names(cameras: Vec<ListedCamera>) -> Result<Cameras> {
    let named = cameras.into_iter();
    Cameras::of_list(named.map(|(id, camera)| (id.to_string(), camera)))
}

/// Writes `cameras.txt`. Names that are distinct IDs are kept; otherwise IDs count from 1.
pub(super) fn write(cameras: &Cameras) -> String {
    let named = &cameras.cameras;
    let ids: Vec<u32> = named.iter().flat_map(|named| named.name.parse()).collect();
    let are_distinct = ids.iter().collect::<BTreeSet<_>>().len() == named.len();
    let numbered = named
        .iter()
        .enumerate()
        .map(|(n, named)| match are_distinct {
            true => (ids[n], named.camera),
            false => (n as u32 + 1, named.camera),
        });
    write_cameras_text(&numbered.collect::<Vec<_>>())
}
