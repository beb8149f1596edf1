//! Input and options of structure from motion, and their checks.

use super::bundle::PositionPrior;
use super::reconstruction::SfmImage;
use super::tracks::PairMatches;
use crate::camera::Camera;
use crate::robust::RansacOptions;
use crate::two_view::PHOTO_MAX_ERROR_PX;
use crate::{Error, Result};
use derive_setters::Setters;
use std::collections::BTreeMap;

/// Images, reduced to keypoints, and matches between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmInput {
    /// The images.
    pub images: Vec<SfmImage>,
    /// The camera of each image, or one for all.
    pub cameras: Vec<Camera>,
    /// Matches between images, including outliers.
    pub pairs: Vec<PairMatches>,
}

/// Options of [`reconstruct`](super::reconstruct).
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct SfmOptions {
    /// RANSAC for the essential matrix of a pair, and, with its own threshold and sampler, for
    /// registering an image. The threshold is 2 pixels; the seed is ignored.
    pub ransac: RansacOptions,
    /// Maximum reprojection error when an image is registered, pixels. 6.
    pub max_registration_error_px: f64,
    /// Maximum reprojection error of an observation, pixels. 4.
    pub max_reprojection_error_px: f64,
    /// Minimum number of matches to connect two images, and of points to register one. 15.
    pub min_num_inliers: usize,
    /// Minimum triangulation angle of a point, degrees. 1.5.
    pub min_angle_deg: f64,
    /// Median triangulation angle of the initial pair, degrees; halved repeatedly until a pair has
    /// it. 16.
    pub min_start_angle_deg: f64,
    /// Minimum number of images that see a point in the result. 2.
    pub min_track_length: usize,
    /// Refine a factor of the focal lengths, one per lens. False.
    pub refine_focal: bool,
    /// Refine the principal points, one shift per lens. False, since a shift is hard to distinguish
    /// from a rotation.
    pub refine_principal_point: bool,
    /// Refine the radial terms of each lens, as by
    /// [`BundleOptions::refine_distortion`](super::BundleOptions::refine_distortion). False.
    pub refine_distortion: bool,
    /// Refine the tangential terms p1 and p2 of each lens that has them. False.
    pub refine_tangential: bool,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
}

impl Default for SfmOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default().within(PHOTO_MAX_ERROR_PX),
            max_registration_error_px: 6.0,
            max_reprojection_error_px: 4.0,
            min_num_inliers: 15,
            min_angle_deg: 1.5,
            min_start_angle_deg: 16.0,
            min_track_length: 2,
            refine_focal: false,
            refine_principal_point: false,
            refine_distortion: false,
            refine_tangential: false,
            seed: 0,
        }
    }
}

/// Name of the result in [`TooFew`](crate::Error::TooFew).
pub(super) const OF_IMAGES: &str = "structure from motion";

/// Checks images, cameras and options; returns the camera of each image.
///
/// * `what`: name of the result, for [`Error::TooFew`]
pub(super) fn check(
    what: &'static str,
    images: &[SfmImage],
    cameras: &[Camera],
    options: &SfmOptions,
) -> Result<Vec<Camera>> {
    let count = images.len();
    if count < 2 {
        return Err(Error::TooFew {
            what,
            needed: 2,
            got: count,
        });
    }
    check_count(count, cameras)?;
    for image in images {
        if !image
            .keypoints
            .iter()
            .all(|p| p.x.is_finite() && p.y.is_finite())
        {
            return Err(Error::NotFinite {
                what: "a keypoint's pixel",
            });
        }
        if !image.colors.is_empty() && image.colors.len() != image.keypoints.len() {
            return Err(Error::SizeMismatch {
                what: "the lists of keypoints and of their colors",
                first: image.keypoints.len(),
                second: image.colors.len(),
            });
        }
    }
    for (what, value) in [
        (
            "the largest registration error",
            options.max_registration_error_px,
        ),
        (
            "the largest reprojection error",
            options.max_reprojection_error_px,
        ),
        ("the smallest angle of a point", options.min_angle_deg),
        ("the smallest angle of a start", options.min_start_angle_deg),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::OutOfRange {
                what,
                requirement: "greater than 0 and finite",
                value,
            });
        }
    }
    pair_ransac(options).check()?;
    (cameras.iter()).try_for_each(|camera| camera.lens.check())?;
    (images.iter())
        .filter_map(|image| image.position.as_ref())
        .try_for_each(PositionPrior::check)?;
    let cameras = match cameras {
        [one] => vec![*one; count],
        each => each.to_vec(),
    };
    let mut lens_of = BTreeMap::new();
    for (image, camera) in images.iter().zip(&cameras) {
        if *lens_of.entry(image.lens).or_insert(camera.lens) != camera.lens {
            return Err(Error::Degenerate {
                what: "a lens that images share",
                why: "their coefficients differ; give each its own number in SfmImage::lens",
            });
        }
    }
    Ok(cameras)
}

/// # Errors
/// [`Error::SizeMismatch`] unless there is one camera, or one per image.
pub(super) fn check_count(num_photos: usize, cameras: &[Camera]) -> Result<()> {
    if cameras.len() == 1 || cameras.len() == num_photos {
        return Ok(());
    }
    Err(Error::SizeMismatch {
        what: "the lists of images and of their cameras",
        first: num_photos,
        second: cameras.len(),
    })
}

/// Returns the options for verifying pairs.
pub(super) fn pair_ransac(options: &SfmOptions) -> RansacOptions {
    RansacOptions {
        seed: options.seed,
        ..options.ransac
    }
}
