//! A keypoint's window before and after a change of the photograph, and the distance of each
//! descriptor from its original.

use super::prints::{Prints, SIGMA_PX};
use crate::contract::{Problem, Progress};
use crate::kit::changed::{Change, MIDDLE};
use crate::kit::features::Pair;
use crate::kit::patch::Spot;
use crate::kit::question::tell;
use epipole::Error;
use epipole::feature::nearest_few;
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// Number of other keypoints for comparison: the strongest features.
const NUM_OTHERS: usize = 200;
/// Minimum distance of these from the keypoint, pixels, since windows of nearer ones overlap too
/// much.
const OTHERS_BEYOND_PX: f64 = 12.0;
/// Half size of the shown window, pixels.
pub(super) const SHOWN_PX: u32 = 48;
/// Side of the shown window, pixels.
const SIDE_PX: u32 = 2 * SHOWN_PX + 1;

/// Input of the comparison.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Subject {
    /// Position of the keypoint, pixels.
    pub(super) place: (f64, f64),
    pub(super) change: Change,
    /// Whether SIFT rotates its window, and whether it scales it.
    pub(super) turns: bool,
    pub(super) scales: bool,
}

/// A window of a photograph and its SIFT descriptor.
#[derive(Serialize, Deserialize)]
pub(super) struct Look {
    /// Gray levels of a square around the keypoint, row by row.
    levels: Vec<u8>,
    /// Orientation assigned by SIFT.
    pub(super) angle_rad: f64,
    /// Scale σ that SIFT assumes, pixels.
    scale_px: f64,
    /// Histogram by row of cells, column and direction.
    pub(super) histogram: Vec<f32>,
}

/// Distances of a descriptor, in its own unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Distance {
    pub(super) original: f64,
    /// Distance from the nearest descriptor of another keypoint.
    pub(super) other: f64,
}

/// Both windows, and the distances of a raw patch, of a normalized patch and of SIFT's descriptor.
#[derive(Serialize, Deserialize)]
pub(super) struct Comparison {
    /// Windows before and after the change.
    pub(super) looks: [Look; 2],
    pub(super) distances: [Distance; 3],
}

/// Cached constants: the photograph in gray, and the descriptors of the other keypoints.
struct Known {
    gray: GrayImage32,
    places: Vec<(f64, f64)>,
    others: Prints,
}

impl Distance {
    /// Returns the ratio of both distances, as in the ratio test.
    pub(super) fn ratio(&self) -> f64 {
        self.original / self.other.max(1e-9)
    }
}

impl Look {
    fn new(piece: &GrayImage32, prints: &Prints) -> Self {
        let first = MIDDLE as u32 - SHOWN_PX;
        let pixels = (0..SIDE_PX * SIDE_PX).map(|k| (first + k % SIDE_PX, first + k / SIDE_PX));
        let level = |(u, v)| (255.0 * piece.get_pixel(u, v).0[0]).round() as u8;
        Self {
            levels: pixels.map(level).collect(),
            angle_rad: prints.angle_rad,
            scale_px: prints.scale_px,
            histogram: prints.histogram(),
        }
    }

    /// Returns the window around the keypoint.
    pub(super) fn picture(&self) -> image::RgbImage {
        let level = |u: u32, v: u32| self.levels[(v * SIDE_PX + u) as usize];
        image::RgbImage::from_fn(SIDE_PX, SIDE_PX, |u, v| image::Rgb([level(u, v); 3]))
    }

    /// Returns the feature in the window, pixels.
    pub(super) fn spot(&self) -> Spot {
        Spot {
            place: [MIDDLE; 2],
            scale_px: self.scale_px,
            angle_rad: self.angle_rad,
        }
    }

    fn is_sound(&self) -> bool {
        self.levels.len() == (SIDE_PX * SIDE_PX) as usize
            && self.histogram.len() == 128
            && self.histogram.iter().all(|value| value.is_finite())
            && self.angle_rad.is_finite()
            && self.scale_px.is_finite()
    }
}

impl Comparison {
    /// Returns whether it is valid: of the right size, without NaN.
    pub(super) fn is_sound(&self) -> bool {
        let is_finite = |distance: &Distance| {
            [distance.original, distance.other]
                .iter()
                .all(|far| far.is_finite())
        };
        self.looks.iter().all(Look::is_sound) && self.distances.iter().all(is_finite)
    }

    /// Compares the photograph before and after its change.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
    pub(super) fn of(subject: &Subject, progress: Progress<'_>) -> Result<Self, Problem> {
        let known = Known::find(&mut |share| progress(0.9 * share))?;
        let scale_px = match subject.scales {
            true => SIGMA_PX * subject.change.zoom,
            false => SIGMA_PX,
        };
        let look = |change: Change, scale_px: f64| -> Result<(Look, Prints), Error> {
            let piece = change.piece(&known.gray, subject.place)?;
            let prints = Prints::of(&piece, &[(MIDDLE, MIDDLE)], scale_px, subject.turns)?;
            Ok((Look::new(&piece, &prints), prints))
        };
        let (before, prints_before) = look(Change::NONE, SIGMA_PX)?;
        let (after, prints_after) = look(subject.change, scale_px)?;
        let mut distances = [Distance {
            original: 0.0,
            other: 0.0,
        }; 3];
        for (way, distance) in distances.iter_mut().enumerate() {
            let query = prints_after.lists[way].get(0).unwrap_or_default();
            let original = nearest_few(&query, &prints_before.lists[way], 1)?;
            let others = &known.others.lists[way];
            let ranked = nearest_few(&query, others, others.len())?;
            let is_other = |(index, _): &&(usize, f32)| {
                let (u, v) = known.places[*index];
                libm::hypot(u - subject.place.0, v - subject.place.1) > OTHERS_BEYOND_PX
            };
            let in_units = |found: Option<&(usize, f32)>| {
                Prints::in_units(way, found.map_or(0.0, |(_, far)| f64::from(*far)))
            };
            *distance = Distance {
                original: in_units(original.first()),
                other: in_units(ranked.iter().find(is_other)),
            };
        }
        Ok(Self {
            looks: [before, after],
            distances,
        })
    }
}

impl Known {
    fn find(progress: Progress<'_>) -> Result<&'static Self, Problem> {
        static FOUND: OnceLock<Known> = OnceLock::new();
        if let Some(found) = FOUND.get() {
            return Ok(found);
        }
        let features = Pair::features(0, &mut |share| progress(0.9 * share))?;
        tell(progress, 0.9)?;
        let mut places: Vec<(f64, f64)> = Vec::new();
        for keypoint in &features.keypoints {
            let is_new = |(u, v): &(f64, f64)| libm::hypot(u - keypoint.u, v - keypoint.v) > 4.0;
            if places.len() < NUM_OTHERS && places.iter().all(is_new) {
                places.push((keypoint.u, keypoint.v));
            }
        }
        let photograph = Pair::photograph(0, progress)?;
        let gray = rgb_to_gray_f32(photograph, &BT601_WEIGHTS);
        let others = Prints::of(&gray, &places, SIGMA_PX, true)?;
        Ok(FOUND.get_or_init(|| Self {
            gray,
            places,
            others,
        }))
    }
}
