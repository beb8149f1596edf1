//! Two photographs of the still life with their SIFT features and ground-truth matches.
//!
//! Shared by all figures that match features, so that a reader meets the same matches again.

use crate::contract::Progress;
use crate::kit::scenes::{self, photograph, still_life_pair};
use epipole::Error;
use epipole::camera::PosedCamera;
use epipole::feature::{Features, SiftOptions, detect_sift};
use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
use epipole::progress::Status;
use epipole_scenes::Transfer;
use image::RgbImage;
use nalgebra::Point2;
use std::sync::OnceLock;

/// Size of the rendered photographs, pixels.
pub(crate) const SIZE: (u32, u32) = (480, 360);
/// Pose of the second camera: meters to the right, meters forward, degrees to the left.
const MOTION: (f64, f64, f64) = (0.35, -0.25, 14.0);
/// Maximum number of features per photograph, the strongest; more would only crowd the picture.
const MAX_FEATURES: usize = 600;
/// Maximum distance of a correct match from its true position, pixels.
pub(crate) const RIGHT_WITHIN_PX: f64 = 3.0;

/// The still life from two positions, cached for posters of several sizes and for several figures.
pub(crate) struct Pair {
    pub(crate) photographs: [&'static RgbImage; 2],
    pub(crate) features: [&'static Features; 2],
    /// True position in photograph 2 of each feature of photograph 1; `None` if it is not visible.
    pub(crate) truths: Vec<Option<Point2<f64>>>,
}

impl Pair {
    /// Renders the photographs and detects their features on the first call.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
    pub(crate) fn of_still_life(progress: Progress<'_>) -> Result<&'static Self, Error> {
        static FOUND: OnceLock<Pair> = OnceLock::new();
        if let Some(found) = FOUND.get() {
            return Ok(found);
        }
        let cameras = cameras();
        let mut photographs =
            |index, done| Self::photograph(index, &mut |share| progress(done + 0.3 * share));
        let photographs = [photographs(0, 0.0)?, photographs(1, 0.3)?];
        let mut features =
            |index, done| Self::features(index, &mut |share| progress(done + 0.2 * share));
        let features = [features(0, 0.6)?, features(1, 0.8)?];
        let (scene, [camera1, camera2]) = (scenes::still_life(), &cameras);
        let truth = |pixel1: Point2<f64>| match scene.transfer(camera1, camera2, &pixel1) {
            Transfer::Visible { pixel2, .. } => Some(pixel2),
            _ => None,
        };
        let places = features[0].keypoints.iter();
        let pair = Self {
            truths: places.map(|keypoint| truth(keypoint.point())).collect(),
            photographs,
            features,
        };
        Ok(FOUND.get_or_init(|| pair))
    }

    /// Returns one of the photographs, 0 or 1.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
    pub(crate) fn photograph(
        index: usize,
        progress: Progress<'_>,
    ) -> Result<&'static RgbImage, Error> {
        static TAKEN: [OnceLock<RgbImage>; 2] = [const { OnceLock::new() }; 2];
        if let Some(taken) = TAKEN[index].get() {
            return Ok(taken);
        }
        let taken = photograph(&cameras()[index], SIZE, progress)?;
        Ok(TAKEN[index].get_or_init(|| taken))
    }

    /// Returns the features of one of the photographs, 0 or 1.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
    pub(crate) fn features(
        index: usize,
        progress: Progress<'_>,
    ) -> Result<&'static Features, Error> {
        static FOUND: [OnceLock<Features>; 2] = [const { OnceLock::new() }; 2];
        if let Some(found) = FOUND[index].get() {
            return Ok(found);
        }
        let photograph = Self::photograph(index, &mut |share| progress(0.5 * share))?;
        let found = features_of(photograph, &mut |share| progress(0.5 + 0.5 * share))?;
        Ok(FOUND[index].get_or_init(|| found))
    }

    /// Returns whether two features, by their indices in photographs 1 and 2, are a correct match.
    pub(crate) fn is_right(&self, index1: usize, index2: usize) -> bool {
        let place2 = self.features[1].keypoints[index2].point();
        self.truths[index1].is_some_and(|truth| (truth - place2).norm() < RIGHT_WITHIN_PX)
    }
}

/// Detects the strongest SIFT features of two photographs.
///
/// # Errors
/// As [`detect_sift`].
pub(crate) fn detect(
    photographs: [&RgbImage; 2],
    progress: Progress<'_>,
) -> Result<[Features; 2], Error> {
    Ok([
        features_of(photographs[0], &mut |share| progress(0.5 * share))?,
        features_of(photographs[1], &mut |share| progress(0.5 + 0.5 * share))?,
    ])
}

/// Detects the strongest SIFT features of a photograph.
///
/// # Errors
/// As [`detect_sift`].
pub(crate) fn features_of(
    photograph: &RgbImage,
    progress: Progress<'_>,
) -> Result<Features, Error> {
    let options = SiftOptions::default().with_max_features(MAX_FEATURES);
    let gray = rgb_to_gray_f32(photograph, &BT601_WEIGHTS);
    detect_sift(&gray, &options, &mut |status: Status| {
        progress(f64::from(status.fraction))
    })
}

fn cameras() -> [PosedCamera; 2] {
    let (right_m, forward_m, left_deg) = MOTION;
    still_life_pair(SIZE, right_m, forward_m, left_deg)
}
