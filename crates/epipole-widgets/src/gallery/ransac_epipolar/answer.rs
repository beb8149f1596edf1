//! The long computation behind `ransac-epipolar`: two photographs, their features and the matches.

use crate::contract::{JobResult, Problem, Progress};
use crate::scenes::{self, still_life_pair};
use epipole::Error;
use epipole::feature::{
    Features, MatchOptions, SiftOptions, detect_sift_with_progress, match_descriptors_with_progress,
};
use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
use epipole::synthetic::Transfer;
use image::RgbImage;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// Size of the rendered photographs, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = (480, 360);
/// Where the second camera stands: meters to the right, meters forward, degrees to the left.
const MOTION: (f64, f64, f64) = (0.35, -0.25, 14.0);
/// The strongest features of a photograph; more make the picture fuller, not clearer.
const MAX_FEATURES: usize = 600;
/// A match is right if it is so near to where the scene's geometry puts it, pixels.
const RIGHT_WITHIN_PX: f64 = 3.0;

/// Where the photographs come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Request {
    /// The rendered still life.
    StillLife,
    /// The reader's own: width, height, RGB bytes of each.
    Own([(u32, u32, Vec<u8>); 2]),
}

/// A feature of photograph 1 and the one of photograph 2 that looks most alike, each the other's
/// nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Match {
    pub(super) pixel1: Point2<f64>,
    pub(super) pixel2: Point2<f64>,
    /// Lowe's ratio: distance of the descriptors over that of the second nearest.
    pub(super) ratio: f32,
    /// Whether it is right, where the truth is known.
    pub(super) is_right: Option<bool>,
}

/// What the computation finds, as it travels.
#[derive(Serialize, Deserialize)]
struct Wire {
    photographs: [(u32, u32, Vec<u8>); 2],
    matches: Vec<([f64; 4], f32, Option<bool>)>,
}

/// What the computation finds.
pub(super) struct Answer {
    pub(super) photographs: [RgbImage; 2],
    pub(super) matches: Vec<Match>,
}

impl Request {
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        postcard::to_allocvec(self).unwrap_or_default()
    }

    /// Carries out the computation.
    ///
    /// # Errors
    /// A sentence about the photographs.
    pub(super) fn compute(bytes: &[u8], progress: Progress<'_>) -> JobResult {
        // The still life never changes; posters of several sizes need it several times.
        static STILL_LIFE: OnceLock<Vec<u8>> = OnceLock::new();
        let unreadable = |_| Error::Degenerate {
            what: "the search for matches",
            why: "the request cannot be read",
        };
        if progress(0.0).is_break() {
            return Err(Error::Canceled.into());
        }
        match postcard::from_bytes(bytes).map_err(unreadable)? {
            Self::StillLife => match STILL_LIFE.get() {
                Some(known) => Ok(known.clone()),
                None => {
                    let found = still_life(progress)?;
                    Ok(STILL_LIFE.get_or_init(|| found).clone())
                }
            },
            Self::Own(photographs) => {
                let [first, second] = photographs.map(|(width, height, rgb)| {
                    RgbImage::from_raw(width, height, rgb).ok_or(Error::Degenerate {
                        what: "a photograph",
                        why: "its bytes do not fit its size",
                    })
                });
                let photographs = [first?, second?];
                let matches = find_matches(&photographs, &mut |share| progress(share))?;
                Ok(to_bytes(photographs, &matches))
            }
        }
    }
}

fn still_life(progress: Progress<'_>) -> Result<Vec<u8>, Problem> {
    let (right_m, forward_m, left_deg) = MOTION;
    let cameras = still_life_pair(STILL_LIFE_SIZE, right_m, forward_m, left_deg);
    let mut photograph = |camera, done: f64| {
        scenes::photograph(camera, STILL_LIFE_SIZE, &mut |share| {
            progress(done + 0.3 * share)
        })
    };
    let photographs = [photograph(&cameras[0], 0.0)?, photograph(&cameras[1], 0.3)?];
    let mut matches = find_matches(&photographs, &mut |share| progress(0.6 + 0.4 * share))?;
    let scene = scenes::still_life();
    for found in &mut matches {
        let truth = scene.transfer(&cameras[0], &cameras[1], &found.pixel1);
        found.is_right = Some(match truth {
            Transfer::Visible { pixel2, .. } => (pixel2 - found.pixel2).norm() < RIGHT_WITHIN_PX,
            _ => false,
        });
    }
    Ok(to_bytes(photographs, &matches))
}

/// SIFT on both photographs, then mutual nearest neighbors, told apart later by their ratio.
fn find_matches(photographs: &[RgbImage; 2], progress: Progress<'_>) -> Result<Vec<Match>, Error> {
    let mut go_on = |share: f64| progress(share) == ControlFlow::Continue(());
    let options = SiftOptions {
        max_features: MAX_FEATURES,
        ..SiftOptions::default()
    };
    let mut features = |photograph: &RgbImage, done: f64| -> Result<Features, Error> {
        let gray = rgb_to_gray_f32(photograph, &BT601_WEIGHTS);
        detect_sift_with_progress(&gray, &options, &mut |share| {
            go_on(done + 0.45 * f64::from(share))
        })
    };
    let (first, second) = (
        features(&photographs[0], 0.0)?,
        features(&photographs[1], 0.45)?,
    );
    let any_ratio = MatchOptions {
        max_ratio: None,
        ..MatchOptions::default()
    };
    let found = match_descriptors_with_progress(
        &first.descriptors,
        &second.descriptors,
        &any_ratio,
        &mut |share| go_on(0.9 + 0.1 * f64::from(share)),
    )?;
    let mut matches: Vec<Match> = Vec::with_capacity(found.len());
    for found in &found {
        let (pixel1, pixel2) = (
            first.keypoints[found.index1].point(),
            second.keypoints[found.index2].point(),
        );
        // A feature with two directions is one piece of evidence.
        let is_same = |other: &Match| other.pixel1 == pixel1 && other.pixel2 == pixel2;
        if !matches.iter().any(is_same) {
            matches.push(Match {
                pixel1,
                pixel2,
                ratio: found.ratio,
                is_right: None,
            });
        }
    }
    Ok(matches)
}

fn to_bytes(photographs: [RgbImage; 2], matches: &[Match]) -> Vec<u8> {
    let wire = Wire {
        photographs: photographs.map(|photograph| {
            (
                photograph.width(),
                photograph.height(),
                photograph.into_raw(),
            )
        }),
        matches: matches
            .iter()
            .map(|found| {
                let (p, q) = (found.pixel1, found.pixel2);
                ([p.x, p.y, q.x, q.y], found.ratio, found.is_right)
            })
            .collect(),
    };
    postcard::to_allocvec(&wire).unwrap_or_default()
}

impl Answer {
    /// Reads an answer; `None` if it is none.
    pub(super) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let wire: Wire = postcard::from_bytes(bytes).ok()?;
        let [first, second] = wire
            .photographs
            .map(|(width, height, rgb)| RgbImage::from_raw(width, height, rgb));
        let matches = wire
            .matches
            .into_iter()
            .map(|([u1, v1, u2, v2], ratio, is_right)| Match {
                pixel1: Point2::new(u1, v1),
                pixel2: Point2::new(u2, v2),
                ratio,
                is_right,
            });
        Some(Self {
            photographs: [first?, second?],
            matches: matches.collect(),
        })
    }
}
