//! Detection of markers in an image.

use super::bits::{Cells, read_bits};
use super::dictionary::MarkerDictionary;
use super::outline::refine_outline;
use super::quads::{Sides, find_quads};
use crate::Result;
use crate::calibration::saddles::check_range;
use crate::homography::homography_4point;
use crate::imaging::{Border, GrayImage32, pyramid_down};
use crate::progress::{Monitor, Part, Stage, report};
use derive_setters::Setters;
use nalgebra::{Matrix3, Point2, center};

/// Maximum longer side of the coarsest image, pixels.
const COARSEST_SIDE: u32 = 320;
/// Maximum side of a marker in an image that has a coarser one, pixels.
const MOST_SIDE_PX: f64 = 90.0;
/// Minimum side of a cell, pixels.
const LEAST_CELL_PX: f64 = 1.5;
/// Reach of the profiles across edges in the image where a marker is found, pixels.
const REACH_PX: core::ops::Range<f64> = 2.0..4.0;
/// Reach of the profiles, relative to a cell's side.
const REACH: f64 = 0.8;

/// A square marker in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker {
    /// Number in the dictionary.
    pub id: usize,
    /// Corners of the black border, pixels: clockwise from the upper left one of an upright marker.
    pub corners: [Point2<f64>; 4],
    /// Number of bits that differ from the dictionary.
    pub hamming: u32,
}

/// Options of [`detect_markers`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct MarkerOptions {
    /// Maximum number of wrong bits; `None` for [`MarkerDictionary::max_hamming`].
    pub max_hamming: Option<u32>,
    /// Width of the black border, bits; at least 1.
    pub border_bits: usize,
    /// Minimum side, pixels; markers with less than 1.5 pixels per bit are never found.
    pub min_side_px: f64,
}

impl Default for MarkerOptions {
    /// Returns the dictionary's number of wrong bits, a border of one bit, and no minimum side.
    fn default() -> Self {
        Self {
            max_hamming: None,
            border_bits: 1,
            min_side_px: 0.0,
        }
    }
}

/// Finds ArUco markers and AprilTags, by number.
///
/// A marker is a dark quadrilateral in an image of the pyramid; lines fitted to its sides give its
/// corners with sub-pixel accuracy, and its bits the closest marker of the dictionary in any of
/// four orientations. Markers that are cut off or partly hidden at their border are not found.
///
/// * `image`: gray values in [0, 1]
/// * `monitor`: notified after each image of the pyramid, in the only stage,
///   [`Stage::FeatureDetection`]
///
/// # Errors
/// [`Error::NotFinite`](crate::Error::NotFinite) for an invalid pixel,
/// [`Error::OutOfRange`](crate::Error::OutOfRange) for gray values far from [0, 1],
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Garrido-Jurado et al. 2014, "Automatic generation and detection of highly reliable
/// fiducial markers under occlusion"; the threshold of bits is that of Olson 2011, "AprilTag: a
/// robust and flexible visual fiducial system".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{MarkerDictionary, MarkerOptions, detect_markers};
/// use epipole::imaging::GrayImage32;
/// // Marker 7, 8 pixels per bit, with its corner between the pixels 15 and 16.
/// let dictionary = MarkerDictionary::Aruco4x4_50;
/// let image = GrayImage32::from_fn(80, 80, |u, v| {
///     let cell = |x: u32| (x as usize / 8).checked_sub(2).filter(|cell| *cell < 6);
///     let (Some(row), Some(column)) = (cell(v), cell(u)) else {
///         return image::Luma([1.0]);
///     };
///     let bit = dictionary.is_white(7, row.wrapping_sub(1), column.wrapping_sub(1));
///     image::Luma([f32::from(bit.unwrap_or(false))])
/// });
/// let found = detect_markers(&image, dictionary, &MarkerOptions::default(), &mut ())?;
/// assert_eq!((found.len(), found[0].id, found[0].hamming), (1, 7, 0));
/// assert!((found[0].corners[0] - nalgebra::Point2::new(15.5, 15.5)).norm() < 0.1);
/// # Ok(()) }
/// ```
#[doc(alias = "ArucoDetector")]
#[doc(alias = "detectMarkers")]
pub fn detect_markers(
    image: &GrayImage32,
    dictionary: MarkerDictionary,
    options: &MarkerOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Marker>> {
    check_range(image)?;
    let cells = Cells {
        bits: dictionary.num_bits(),
        border: options.border_bits.clamp(1, 50),
    };
    let max_hamming = options.max_hamming.unwrap_or(dictionary.max_hamming());
    let least_px = LEAST_CELL_PX * cells.side() as f64;
    let mut found: Vec<Marker> = Vec::new();
    let mut level: Option<GrayImage32> = None;
    let mut scale = 1.0;
    // A level costs a quarter of the previous one.
    let mut fraction = 0.0;
    loop {
        report(monitor, Stage::FeatureDetection, fraction)?;
        let (from, middle) = (fraction, fraction + 0.4 * (1.0 - fraction));
        fraction += 0.75 * (1.0 - fraction);
        let here = level.as_ref().unwrap_or(image);
        let is_last = here.width().max(here.height()) <= COARSEST_SIDE;
        let sides = Sides {
            least: least_px.max(options.min_side_px / scale),
            most: if is_last { f64::INFINITY } else { MOST_SIDE_PX },
        };
        let quads = find_quads(here, sides, &mut Part::new(monitor, from, middle))?;
        for (k, quad) in quads.iter().enumerate() {
            let done = middle + (fraction - middle) * k as f32 / quads.len() as f32;
            report(monitor, Stage::FeatureDetection, done)?;
            let Some((corners, bits)) = read_quad(here, quad, cells) else {
                continue;
            };
            let Some((id, quarters, hamming)) = dictionary.nearest(bits, max_hamming) else {
                continue;
            };
            let at_full_size = corners.map(|p| p * scale);
            let reach_px = reach_px(&at_full_size, cells, REACH_PX.end * scale);
            let Some(corners) = refine_outline(image, &at_full_size, reach_px) else {
                continue;
            };
            keep(
                &mut found,
                Marker {
                    id,
                    corners: core::array::from_fn(|k| corners[(k + quarters) % 4]),
                    hamming,
                },
            );
        }
        if is_last {
            break;
        }
        level = Some(pyramid_down(here, Border::Reflect101));
        scale *= 2.0;
    }
    found.sort_by_key(|marker| marker.id);
    Ok(found)
}

/// Reads the corners and bits of a marker whose outline is known to about a pixel.
fn read_quad(
    image: &GrayImage32,
    quad: &[Point2<f64>; 4],
    cells: Cells,
) -> Option<([Point2<f64>; 4], u64)> {
    let mut corners = *quad;
    for _ in 0..2 {
        let reach_px = reach_px(&corners, cells, REACH_PX.end);
        corners = refine_outline(image, &corners, reach_px)?;
    }
    let bits = read_bits(image, &pixel_from_marker(&corners)?, cells)?;
    Some((corners, bits))
}

/// Returns half the length of the profiles across the edges of a marker.
fn reach_px(corners: &[Point2<f64>; 4], cells: Cells, most_px: f64) -> f64 {
    let lengths = [0, 1, 2, 3].map(|k| (corners[(k + 1) % 4] - corners[k]).norm());
    let shortest = lengths.into_iter().fold(f64::INFINITY, f64::min);
    (REACH * shortest / cells.side() as f64).clamp(REACH_PX.start, most_px.max(REACH_PX.start))
}

/// Returns the homography from the square with corners (0, 0) and (1, 1) to a marker's outline.
fn pixel_from_marker(corners: &[Point2<f64>; 4]) -> Option<Matrix3<f64>> {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Point2::from);
    homography_4point(&square, corners).pop()
}

/// Adds a marker, unless it was found there with fewer wrong bits.
fn keep(found: &mut Vec<Marker>, marker: Marker) {
    let middle = |m: &Marker| center(&center(&m.corners[0], &m.corners[2]), &m.corners[1]);
    let half = 0.5 * (marker.corners[2] - marker.corners[0]).norm();
    let same = found.iter_mut().find(|other| {
        let apart = (middle(other) - middle(&marker)).norm();
        apart < half.min(0.5 * (other.corners[2] - other.corners[0]).norm())
    });
    match same {
        None => found.push(marker),
        Some(other) if marker.hamming < other.hamming => *other = marker,
        Some(_) => {}
    }
}
