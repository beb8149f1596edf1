//! The whole way from photographs to a reconstruction.

use super::bundle::PositionPrior;
use super::incremental::{
    OF_PHOTOGRAPHS, SfmInput, SfmObserver, SfmOptions, SfmResult, SfmStep, reconstruct,
};
use super::reconstruction::SfmImage;
use super::shares::{Begin, Shares};
use super::tracks::PairMatches;
use crate::camera::Intrinsics;
use crate::feature::{
    AnyDescriptors, FeatureOptions, Keypoint, Match, MatchOptions, detect_features_with_progress,
    match_any_descriptors, photo_to_gray,
};
use crate::progress::Progress;
use crate::{Error, Result};
use image::RgbImage;
use std::ops::ControlFlow;

/// A photograph with a name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Photo {
    /// Its name, such as that of its file.
    pub name: String,
    /// Its pixels.
    pub image: RgbImage,
    /// As [`SfmImage::lens`].
    pub lens: usize,
    /// As [`SfmImage::position`].
    pub position: Option<PositionPrior>,
}

/// How features are found and matched.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PhotoOptions {
    /// RootSIFT, up to 8192 features, faint ones too.
    pub features: FeatureOptions,
    /// Ratio 0.8, mutual.
    pub matching: MatchOptions,
    /// Match each photograph with so many after it; 0 for all. For frames in order of time.
    pub neighbors: usize,
    /// Whether the least ambiguous matches of a pair come first, as PROSAC wants them, rather than in the
    /// order of the first photograph's keypoints. False.
    pub best_first: bool,
}

/// What [`match_features`] needs to know about a photograph; its pixels are no longer needed.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotoFeatures {
    /// Size, keypoints and their colors.
    pub image: SfmImage,
    /// What the keypoints look like, in the same order.
    pub descriptors: AnyDescriptors,
    /// The keypoints once more, with their scales and directions.
    pub keypoints: Vec<Keypoint>,
}

/// Keypoints and descriptors of a photograph.
///
/// # Errors
/// As [`detect_features`](crate::feature::detect_features).
///
/// Source: Lowe 2004.
pub fn photo_features(photo: &Photo, options: &PhotoOptions) -> Result<PhotoFeatures> {
    photo_features_with_progress(photo, options, &mut |_| ControlFlow::Continue(()))
}

/// [`photo_features`] that reports how far it is and can be stopped.
///
/// * `progress`: as of [`detect_features_with_progress`]
///
/// # Errors
/// As [`photo_features`], and [`Error::Canceled`] if `progress` said so.
///
/// Source: as [`photo_features`].
///
/// ```
/// use epipole::sfm::{Photo, PhotoOptions, photo_features_with_progress};
/// use std::ops::ControlFlow;
/// let photo = Photo { image: image::RgbImage::new(64, 48), ..Photo::default() };
/// let stop = &mut |_| ControlFlow::Break(());
/// let stopped = photo_features_with_progress(&photo, &PhotoOptions::default(), stop);
/// assert_eq!(stopped.err(), Some(epipole::Error::Canceled));
/// ```
pub fn photo_features_with_progress(
    photo: &Photo,
    options: &PhotoOptions,
    progress: Progress<'_>,
) -> Result<PhotoFeatures> {
    let (width, height) = photo.image.dimensions();
    let gray = photo_to_gray(&photo.image);
    let features = detect_features_with_progress(&gray, &options.features, progress)?;
    let color = |u: f64, v: f64| {
        let inside = |x: f64, size: u32| (x.round().max(0.0) as u32).min(size.max(1) - 1);
        photo.image.get_pixel(inside(u, width), inside(v, height)).0
    };
    let image = SfmImage {
        name: photo.name.clone(),
        width,
        height,
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

/// Matches between all pairs of photographs, or between those that are near in order.
///
/// * `observer`: hears of every pair
///
/// Returns `None` if the observer did not want to wait.
///
/// # Errors
/// As [`match_any_descriptors`].
///
/// Source: Lowe 2004; all pairs are compared, which suits some dozens of photographs.
pub fn match_features(
    features: &[PhotoFeatures],
    options: &PhotoOptions,
    observer: SfmObserver<'_>,
) -> Result<Option<Vec<PairMatches>>> {
    let reach = if options.neighbors == 0 {
        features.len()
    } else {
        options.neighbors
    };
    let after = |image: usize| image + 1..features.len().min(image.saturating_add(reach + 1));
    let total = (0..features.len()).map(|image| after(image).len()).sum();
    let mut pairs = Vec::new();
    for image1 in 0..features.len() {
        for image2 in after(image1) {
            pairs.push(PairMatches {
                image1,
                image2,
                matches: match_pair(&features[image1], &features[image2], options)?,
            });
            let step = SfmStep::Matched {
                done: pairs.len(),
                total,
            };
            if observer(&step).is_break() {
                return Ok(None);
            }
        }
    }
    Ok(Some(pairs))
}

/// Matches between the two pictures of a rectified stereo pair, left first: those that share a
/// row to within 2 pixels and are further right in the left picture.
///
/// # Errors
/// As [`match_any_descriptors`].
///
/// Source: Lowe 2004.
pub fn match_rectified(
    left: &PhotoFeatures,
    right: &PhotoFeatures,
    options: &PhotoOptions,
) -> Result<Vec<(u32, u32)>> {
    let mut matches = match_pair(left, right, options)?;
    matches.retain(|&(i, j)| {
        let (a, b) = (
            left.image.keypoints[i as usize],
            right.image.keypoints[j as usize],
        );
        (a.y - b.y).abs() <= MAX_ROW_ERROR_PX && a.x > b.x
    });
    Ok(matches)
}

/// How far a rectification may be off.
const MAX_ROW_ERROR_PX: f64 = 2.0;

/// Matches between two photographs, as indices of their keypoints.
///
/// # Errors
/// As [`match_any_descriptors`].
///
/// Source: Lowe 2004.
pub fn match_pair(
    first: &PhotoFeatures,
    second: &PhotoFeatures,
    options: &PhotoOptions,
) -> Result<Vec<(u32, u32)>> {
    let descriptors = (&first.descriptors, &second.descriptors);
    let mut matches = match_any_descriptors(descriptors.0, descriptors.1, &options.matching)?;
    if options.best_first {
        matches.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    }
    let pair = |m: &Match| (m.index1 as u32, m.index2 as u32);
    Ok(matches.iter().map(pair).collect())
}

/// Keypoints of all photographs and matches between all pairs of them.
///
/// * `observer`: hears of every photograph and every pair
///
/// Returns `None` in place of matches that the observer did not want to wait for.
///
/// # Errors
/// As [`photo_features`] and [`match_features`].
///
/// Source: as these.
pub fn match_photos(
    photos: &[Photo],
    options: &PhotoOptions,
    observer: SfmObserver<'_>,
) -> Result<(Vec<SfmImage>, Option<Vec<PairMatches>>)> {
    let images = |features: Vec<PhotoFeatures>| features.into_iter().map(|f| f.image).collect();
    let mut features = Vec::new();
    for (index, photo) in photos.iter().enumerate() {
        features.push(photo_features(photo, options)?);
        let step = SfmStep::Detected {
            done: index + 1,
            total: photos.len(),
        };
        if observer(&step).is_break() {
            return Ok((images(features), None));
        }
    }
    let pairs = match_features(&features, options, observer)?;
    Ok((images(features), pairs))
}

/// Cameras and points from photographs: features, matches, and [`reconstruct`].
///
/// * `intrinsics`: of each photograph, or one for all
///
/// Returns the keypoints and matches, too. A result that was canceled before all were known has
/// no components.
///
/// # Errors
/// As [`reconstruct`] and [`match_photos`].
///
/// Source: as [`reconstruct`].
pub fn reconstruct_photos(
    photos: &[Photo],
    intrinsics: &[Intrinsics],
    photo_options: &PhotoOptions,
    options: &SfmOptions,
    observer: SfmObserver<'_>,
) -> Result<(SfmInput, SfmResult)> {
    if photos.len() < 2 {
        return Err(Error::TooFew {
            what: OF_PHOTOGRAPHS,
            needed: 2,
            got: photos.len(),
        });
    }
    if intrinsics.len() != 1 && intrinsics.len() != photos.len() {
        return Err(Error::SizeMismatch {
            what: "the lists of photographs and of their intrinsics",
            first: photos.len(),
            second: intrinsics.len(),
        });
    }
    let (images, pairs) = match_photos(photos, photo_options, observer)?;
    let canceled = pairs.is_none();
    let input = SfmInput {
        images,
        intrinsics: intrinsics.to_vec(),
        pairs: pairs.unwrap_or_default(),
    };
    if canceled {
        let result = SfmResult {
            unregistered: (0..photos.len()).collect(),
            canceled,
            ..SfmResult::default()
        };
        return Ok((input, result));
    }
    let result = reconstruct(&input, options, observer)?;
    Ok((input, result))
}

/// As [`reconstruct_photos`], with the same result, telling `progress` how far it is.
///
/// Its stages are [`Stage::FeatureDetection`](crate::progress::Stage::FeatureDetection),
/// [`Stage::FeatureMatching`](crate::progress::Stage::FeatureMatching), and those of
/// [`reconstruct_with_progress`](super::reconstruct_with_progress). Whoever breaks gets what there is so far, as
/// [`SfmResult::canceled`] says.
///
/// # Errors
/// As [`reconstruct_photos`].
///
/// Source: as [`reconstruct`].
pub fn reconstruct_photos_with_progress(
    photos: &[Photo],
    intrinsics: &[Intrinsics],
    photo_options: &PhotoOptions,
    options: &SfmOptions,
    progress: Progress<'_>,
) -> Result<(SfmInput, SfmResult)> {
    let mut shares = Shares::new(progress, Begin::Photos, photos.len());
    reconstruct_photos(photos, intrinsics, photo_options, options, &mut |step| {
        shares.tell(step)
    })
}
