//! The job of `panorama`: features, overlaps, rotations with the focal length, and the stitched
//! picture.

use crate::contract::{Problem, Progress};
use crate::kit::features::features_of;
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use crate::kit::scenes::{photograph, still_life_pair};
use epipole::Error;
use epipole::camera::{Intrinsics, PosedCamera};
use epipole::feature::{Features, MatchOptions, match_descriptors};
use epipole::homography::transfer_error_px;
use epipole::stitch::{
    Blend, Overlap, OverlapOptions, Panorama, RenderOptions, Surface, estimate_panorama,
    find_overlap, render_panorama,
};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Size of the rendered photographs, pixels.
pub(super) const SIZE: (u32, u32) = (480, 360);
/// Maximum number of photographs.
pub(super) const MAX_PHOTOS: usize = 3;
pub(super) const SURFACES: [Surface; 2] = [Surface::Plane, Surface::Cylinder];
pub(super) const BLENDS: [Blend; 3] = [Blend::Seams, Blend::Feather, Blend::Bands];
/// Focal length guessed for all photographs, in units of the longer side.
const GUESSED_FOCAL: f64 = 1.0;
/// Maximum number of pixels of the panorama.
const MAX_PIXELS: u64 = 1_500_000;
/// Exposure factors of three photographs with automatic exposure.
const EXPOSURES: [f64; MAX_PHOTOS] = [0.72, 1.0, 1.3];

/// The photographs to join.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Source {
    /// Rendered, from a camera that rotates by an angle and translates sideways before each
    /// photograph.
    Rendered {
        turn_deg: f64,
        step_m: f64,
        /// Whether exposures differ.
        is_automatic: bool,
    },
    /// Photographs of the reader.
    Own(Vec<Picture>),
}

/// Photographs, surface, blending and gains.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) source: Source,
    /// Index in [`SURFACES`].
    pub(super) surface: usize,
    /// Index in [`BLENDS`].
    pub(super) blend: usize,
    pub(super) gains: bool,
}

/// Matches of two neighbors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Joint {
    pub(super) num_matches: usize,
    pub(super) num_inliers: usize,
}

/// The panorama, and the accuracy of its alignment.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photographs: Vec<Picture>,
    pub(super) panorama: Picture,
    /// Estimated focal length, pixels.
    pub(super) focal_px: f64,
    /// Rotation of each photograph to the right of the first, degrees; `None` if it is not
    /// connected.
    pub(super) turns_deg: Vec<Option<f64>>,
    pub(super) joints: Vec<Joint>,
    /// Root mean square distance of a match from its position predicted by the rotations, pixels.
    pub(super) misfit_px: f64,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Joining the photographs";
    const FAILED: &'static str = "There is no panorama";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let photographs = self
            .source
            .photographs(&mut |share| progress(0.5 * share))?;
        let mut features = Vec::new();
        for photograph in &photographs {
            tell(progress, 0.5 + 0.1 * features.len() as f64)?;
            features.push(features_of(photograph.image(), progress)?);
        }
        let overlaps = overlaps(&features)?;
        tell(progress, 0.9)?;
        let guesses: Result<Vec<_>, Error> = photographs
            .iter()
            .map(|photograph| {
                let (width, height) = photograph.size();
                let focal_px = GUESSED_FOCAL * f64::from(width.max(height));
                Intrinsics::centered(focal_px, width, height)
            })
            .collect();
        let found = estimate_panorama(&guesses?, &overlaps, true, &mut ())?;
        let images: Vec<_> = photographs.iter().map(Picture::image).collect();
        let options = RenderOptions::default()
            .with_surface(*at(&SURFACES, self.surface)?)
            .with_blend(*at(&BLENDS, self.blend)?)
            .with_gains(self.gains)
            .with_max_pixels(MAX_PIXELS);
        let panorama = render_panorama(&found, &images, &options, &mut ())?;
        Ok(Answer {
            focal_px: found.scale_px,
            turns_deg: turns_deg(&found),
            misfit_px: misfit_px(&found, &overlaps),
            joints: overlaps.iter().map(Joint::from).collect(),
            panorama: panorama.into(),
            photographs,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let count = answer.photographs.len();
        let numbers = [answer.focal_px, answer.misfit_px];
        let turns = answer.turns_deg.iter().flatten();
        (2..=MAX_PHOTOS).contains(&count)
            && answer.turns_deg.len() == count
            && numbers.iter().chain(turns).all(|number| number.is_finite())
    }
}

/// Returns one of several options.
fn at<T>(options: &[T], index: usize) -> Result<&T, Error> {
    options.get(index).ok_or(Error::Degenerate {
        what: "the question of a figure",
        why: "it names an option that does not exist",
    })
}

impl From<&Overlap> for Joint {
    fn from(overlap: &Overlap) -> Self {
        Self {
            num_matches: overlap.num_matches,
            num_inliers: overlap.pixels[0].len(),
        }
    }
}

impl Source {
    fn photographs(&self, progress: Progress<'_>) -> Result<Vec<Picture>, Error> {
        let (turn_deg, step_m, is_automatic) = match self {
            Self::Own(own) => return Ok(own.clone()),
            Self::Rendered {
                turn_deg,
                step_m,
                is_automatic,
            } => (*turn_deg, *step_m, *is_automatic),
        };
        let mut taken = Vec::new();
        for (index, factor) in EXPOSURES.into_iter().enumerate() {
            let camera = camera(index, turn_deg, step_m);
            let done = index as f64;
            let mut image = photograph(&camera, SIZE, &mut |share| {
                progress((done + share) / MAX_PHOTOS as f64)
            })?;
            if is_automatic {
                for level in image.iter_mut() {
                    // The cast saturates.
                    *level = (f64::from(*level) * factor + 0.5) as u8;
                }
            }
            taken.push(image.into());
        }
        Ok(taken)
    }
}

/// Returns the camera of one of three photographs: the middle one is that of the still life.
pub(super) fn camera(index: usize, turn_deg: f64, step_m: f64) -> PosedCamera {
    let steps = index as f64 - 1.0;
    let [_, camera] = still_life_pair(SIZE, steps * step_m, 0.0, -steps * turn_deg);
    camera
}

/// Finds the overlaps of neighbors, in the order of the photographs.
fn overlaps(features: &[Features]) -> Result<Vec<Overlap>, Error> {
    let mut found = Vec::new();
    for (index, pair) in features.windows(2).enumerate() {
        let [one, two] = [&pair[0], &pair[1]];
        let options = MatchOptions::default();
        let matches = match_descriptors(&one.descriptors, &two.descriptors, &options, &mut ())?;
        let places = matches.iter().map(|found| {
            let [place1, place2] = [&one.keypoints[found.index1], &two.keypoints[found.index2]];
            (place1.point(), place2.point())
        });
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = places.unzip();
        let options = OverlapOptions::default();
        let images = [index, index + 1];
        found.extend(find_overlap(images, &pixels1, &pixels2, &options, &mut ())?);
    }
    Ok(found)
}

/// Returns the rotation of each photograph relative to the first connected one, to the right.
fn turns_deg(panorama: &Panorama) -> Vec<Option<f64>> {
    let ahead = |rotation: &Matrix3<f64>| {
        let axis = rotation.row(2);
        libm::atan2(axis[0], axis[2]).to_degrees()
    };
    let first = panorama
        .rotations
        .iter()
        .flatten()
        .next()
        .map_or(0.0, ahead);
    let rotations = panorama.rotations.iter();
    rotations
        .map(|rotation| rotation.as_ref().map(|rotation| ahead(rotation) - first))
        .collect()
}

/// Returns the root mean square distance of inliers from their positions predicted by the
/// rotations.
fn misfit_px(panorama: &Panorama, overlaps: &[Overlap]) -> f64 {
    let mut errors_sq = Vec::new();
    for overlap in overlaps {
        let [one, two] = overlap
            .images
            .map(|index| panorama.pixel_from_direction[index]);
        let (Some(one), Some(two)) = (one.and_then(|one| one.try_inverse()), two) else {
            continue;
        };
        let homography = two * one;
        let [pixels1, pixels2] = &overlap.pixels;
        let pairs = pixels1.iter().zip(pixels2);
        errors_sq.extend(pairs.map(|(pixel1, pixel2)| {
            let error_px = transfer_error_px(&homography, pixel1, pixel2);
            error_px * error_px
        }));
    }
    libm::sqrt(errors_sq.iter().sum::<f64>() / errors_sq.len().max(1) as f64)
}
