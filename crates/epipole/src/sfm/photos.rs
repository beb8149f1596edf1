//! The full pipeline from images to a reconstruction.

use super::bundle::PositionPrior;
use super::incremental::{SfmResult, reconstruct};
use super::options::{OF_IMAGES, SfmInput, SfmOptions, check_count};
use super::pair_selection::select_pairs;
use super::reconstruction::SfmImage;
use super::tracks::PairMatches;
use crate::camera::Camera;
use crate::feature::{
    Descriptors, FeatureOptions, Keypoint, Match, MatchOptions, detect_features, match_descriptors,
    photo_to_gray,
};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;
use image::RgbImage;

/// An image with a name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Photo {
    /// Name, such as the file name.
    pub name: String,
    /// Pixels.
    pub image: RgbImage,
    /// As [`SfmImage::lens`].
    pub lens: usize,
    /// As [`SfmImage::position`].
    pub position: Option<PositionPrior>,
}

/// Options of [`photo_features`] and [`match_features`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct PhotoOptions {
    /// RootSIFT, up to 8192 features, including faint ones.
    pub features: FeatureOptions,
    /// Ratio 0.8, mutual.
    pub matching: MatchOptions,
    /// Number of following images to match each one with, for frames in order of time. 0.
    pub neighbors: usize,
    /// Number of images to match each one with that look most like it; 0 for none, and all pairs if
    /// `neighbors` is 0 as well. By default 40 if `neighbors` is 0, else none.
    #[setters(strip_option)]
    pub similar: Option<usize>,
    /// Sort the matches of a pair by ambiguity, as PROSAC needs, rather than by the keypoints of
    /// the first image. False.
    pub best_first: bool,
}

/// Input of [`match_features`] for one image; its pixels are no longer needed.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotoFeatures {
    /// Size, keypoints and their colors.
    pub image: SfmImage,
    /// Descriptors of the keypoints, in the same order.
    pub descriptors: Descriptors,
    /// The keypoints with their scales and directions.
    pub keypoints: Vec<Keypoint>,
}

/// Detects keypoints of an image and computes their descriptors.
///
/// * `monitor`: the only stage is [`Stage::FeatureDetection`]
///
/// # Errors
/// As [`detect_features`](crate::feature::detect_features).
///
/// Source: Lowe 2004.
pub fn photo_features(
    photo: &Photo,
    options: &PhotoOptions,
    monitor: &mut dyn Monitor,
) -> Result<PhotoFeatures> {
    let (width, height) = photo.image.dimensions();
    let gray = photo_to_gray(&photo.image);
    let features = detect_features(&gray, &options.features, monitor)?;
    let color = |u: f64, v: f64| {
        let inside = |x: f64, size: u32| (x.round().max(0.0) as u32).min(size.max(1) - 1);
        photo.image.get_pixel(inside(u, width), inside(v, height)).0
    };
    let image = SfmImage {
        name: photo.name.clone(),
        colors: features.keypoints.iter().map(|k| color(k.u, k.v)).collect(),
        keypoints: features.keypoints.iter().map(|k| k.point()).collect(),
        lens: photo.lens,
        position: photo.position,
    };
    Ok(PhotoFeatures {
        image,
        descriptors: features.descriptors,
        keypoints: features.keypoints,
    })
}

/// Matches pairs of images: of some dozens all, of more those that look alike or are close in
/// order, as `options` say.
///
/// * `monitor`: the only stage is [`Stage::FeatureMatching`]
///
/// # Errors
/// As [`match_descriptors`].
///
/// Source: Lowe 2004; similar images by Jégou, Douze, Schmid & Pérez 2010, "Aggregating local
/// descriptors into a compact image representation", with a vocabulary of these images.
pub fn match_features(
    features: &[PhotoFeatures],
    options: &PhotoOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<PairMatches>> {
    let descriptors: Vec<_> = features.iter().map(|image| &image.descriptors).collect();
    let mut part = Part::new(monitor, 0.0, SELECTED);
    let selected = select_pairs(&descriptors, options.neighbors, options.similar, &mut part)?;
    let progress = |done: usize| SELECTED + (1.0 - SELECTED) * done as f32 / selected.len() as f32;
    let mut pairs = Vec::with_capacity(selected.len());
    for &(image1, image2) in &selected {
        let mut part = Part::new(monitor, progress(pairs.len()), progress(pairs.len() + 1));
        let (first, second) = (&features[image1], &features[image2]);
        pairs.push(PairMatches {
            image1,
            image2,
            matches: match_pair(first, second, options, &mut part)?,
        });
    }
    report(monitor, Stage::FeatureMatching, 1.0)?;
    Ok(pairs)
}

/// Progress of [`match_features`] when the pairs are chosen.
const SELECTED: f32 = 0.05;

/// Matches the two images of a rectified stereo pair, left first: keeps matches in the same row to
/// within 2 pixels that are further right in the left image.
///
/// # Errors
/// As [`match_descriptors`].
///
/// Source: Lowe 2004.
pub fn match_rectified(
    left: &PhotoFeatures,
    right: &PhotoFeatures,
    options: &PhotoOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Match>> {
    let mut matches = match_pair(left, right, options, monitor)?;
    matches.retain(|found| {
        let (a, b) = (
            left.image.keypoints[found.index1],
            right.image.keypoints[found.index2],
        );
        (a.y - b.y).abs() <= MAX_ROW_ERROR_PX && a.x > b.x
    });
    Ok(matches)
}

/// Maximum row error of a rectification.
const MAX_ROW_ERROR_PX: f64 = 2.0;

/// Matches the features of two images.
fn match_pair(
    first: &PhotoFeatures,
    second: &PhotoFeatures,
    options: &PhotoOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Match>> {
    let descriptors = (&first.descriptors, &second.descriptors);
    let mut matches = match_descriptors(descriptors.0, descriptors.1, &options.matching, monitor)?;
    if options.best_first {
        matches.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    }
    Ok(matches)
}

/// Computes keypoints of all images and matches between all pairs.
///
/// * `monitor`: the stages are [`Stage::FeatureDetection`] and [`Stage::FeatureMatching`]
///
/// # Errors
/// [`Error::TooFew`] for fewer than two images, and as [`photo_features`] and [`match_features`].
///
/// Source: as [`photo_features`] and [`match_features`].
pub fn match_photos(
    photos: &[Photo],
    options: &PhotoOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Vec<SfmImage>, Vec<PairMatches>)> {
    if photos.len() < 2 {
        return Err(Error::TooFew {
            what: OF_IMAGES,
            needed: 2,
            got: photos.len(),
        });
    }
    let fraction = |done: usize| DETECTED * done as f32 / photos.len() as f32;
    let mut features = Vec::new();
    for (index, photo) in photos.iter().enumerate() {
        let mut part = Part::new(monitor, fraction(index), fraction(index + 1));
        features.push(photo_features(photo, options, &mut part)?);
    }
    let mut part = Part::new(monitor, DETECTED, 1.0);
    let pairs = match_features(&features, options, &mut part)?;
    Ok((features.into_iter().map(|f| f.image).collect(), pairs))
}

/// Progress of [`match_photos`] when all features are found, measured with some dozens of images.
const DETECTED: f32 = 0.5;
/// Progress of [`reconstruct_photos`] when all is matched.
const MATCHED: f32 = 0.6;

/// Reconstructs cameras and points from images: features, matches, and [`reconstruct`].
///
/// * `cameras`: the camera of each image, or one for all
/// * `monitor`: the stages are those of [`match_photos`], then those of [`reconstruct`]
///
/// Also returns the keypoints and matches.
///
/// # Errors
/// As [`reconstruct`] and [`match_photos`].
///
/// Source: as [`reconstruct`].
pub fn reconstruct_photos(
    photos: &[Photo],
    cameras: &[Camera],
    photo_options: &PhotoOptions,
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<(SfmInput, SfmResult)> {
    check_count(photos.len(), cameras)?;
    let mut part = Part::new(monitor, 0.0, MATCHED);
    let (images, pairs) = match_photos(photos, photo_options, &mut part)?;
    let input = SfmInput {
        images,
        cameras: cameras.to_vec(),
        pairs,
    };
    let result = reconstruct(&input, options, &mut Part::new(monitor, MATCHED, 1.0))?;
    Ok((input, result))
}
