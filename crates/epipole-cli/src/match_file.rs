//! Files of points and matches.

use crate::failure::Failure;
use crate::files;
use epipole_io::matches::{
    MatchLayout, PixelsAndPoints, read_matches, read_points, read_points_with_pixels,
    write_matches, write_points,
};
use nalgebra::Point2;
use std::path::Path;

fn read<T>(path: &Path, parse: fn(&[u8]) -> epipole_io::Result<T>) -> Result<T, Failure> {
    let bytes = files::read_bytes(path)?;
    parse(&bytes).map_err(|error| Failure::from(error).about(path))
}

/// Reads the matches of two images, as pixels of each.
///
/// # Errors
/// A failure that names the file and the line.
pub(crate) fn matches(path: &Path) -> Result<[Vec<Point2<f64>>; 2], Failure> {
    read(path, read_matches)
}

/// Reads the points of an image.
///
/// # Errors
/// As [`matches`].
pub(crate) fn points(path: &Path) -> Result<Vec<Point2<f64>>, Failure> {
    read(path, read_points)
}

/// Reads points of the world and their pixels.
///
/// # Errors
/// As [`matches`].
pub(crate) fn points_with_pixels(path: &Path) -> Result<PixelsAndPoints, Failure> {
    read(path, read_points_with_pixels)
}

/// Returns the text of matches, with descriptor distances and ratios if there are any.
pub(crate) fn text(
    path: &Path,
    pixels: [&[Point2<f64>]; 2],
    distances_and_ratios: &[[f32; 2]],
) -> String {
    write_matches(layout(path), pixels, distances_and_ratios)
}

/// Returns the text of the inliers of matches, or of points if the second list is empty.
pub(crate) fn inliers(path: &Path, pixels: [&[Point2<f64>]; 2], mask: &[bool]) -> String {
    let selected = pixels.map(|list| -> Vec<Point2<f64>> {
        let selected = list.iter().zip(mask).filter(|(_, is_inlier)| **is_inlier);
        selected.map(|(pixel, _)| *pixel).collect()
    });
    match pixels {
        [_, []] => write_points(layout(path), &selected[0]),
        _ => text(path, [&selected[0], &selected[1]], &[]),
    }
}

/// Returns the layout: commas if the name of the file ends in `.csv`.
fn layout(path: &Path) -> MatchLayout {
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("csv") => MatchLayout::Csv,
        _ => MatchLayout::Text,
    }
}
