//! Features of photographs by any of the detectors, and the one set of defaults for them.

use super::{
    BinaryDescriptors, CornerMeasure, Descriptors, GoodFeaturesOptions, Keypoint, Match,
    MatchOptions, OrbOptions, RefineOptions, SiftNormalization, SiftOptions, describe_patches,
    detect_orb, detect_sift_with_progress, good_features_to_track, match_descriptors,
    match_hamming, refine_corners,
};
use crate::imaging::{GrayImage32, gray_to_f32, rgb_to_gray};
use crate::progress::Progress;
use crate::{Error, Result};
use image::RgbImage;
use std::ops::ControlFlow;

/// Which features to look for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeatureKind {
    /// Scale-invariant features ([`detect_sift`](super::detect_sift)), Euclidean descriptors.
    Sift,
    /// The same with the Hellinger kernel ([`SiftNormalization::Root`]).
    #[default]
    RootSift,
    /// Oriented FAST corners with 256 comparisons ([`detect_orb`]).
    Orb,
    /// Harris corners with normalized patches ([`describe_patches`]), for photographs from nearly the
    /// same place: neither turned nor enlarged.
    Harris,
}

/// How features of a photograph are found. The default is what every command and
/// [`PhotoOptions`](crate::sfm::PhotoOptions) start from; [`MatchOptions`] and
/// [`RansacOptions`](crate::robust::RansacOptions) are its companions for matches and models.
///
/// ```
/// use epipole::feature::{FeatureKind, FeatureOptions};
/// let options = FeatureOptions::default();
/// assert_eq!((options.kind, options.max_features), (FeatureKind::RootSift, 8192));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureOptions {
    /// RootSIFT.
    pub kind: FeatureKind,
    /// At most so many, the strongest; 0 means no limit. 8192.
    pub max_features: usize,
    /// How strong a feature must be, for gray values in [0, 1]; `None` for what suits the kind. Of
    /// SIFT [`SiftOptions::contrast_threshold`], 0.02: faint ones, too. Of ORB
    /// [`OrbOptions::fast_threshold`], 20/255. Of Harris' corners the share of the strongest,
    /// [`GoodFeaturesOptions::quality`], 0.01.
    pub contrast_threshold: Option<f32>,
    /// SIFT: the blur that a photograph is assumed to have, pixels, 0 to 0.8. 0.5, as
    /// Lowe's; from 0.3 more of them match where photographs are sharp, fewer where features are rare.
    pub input_blur_px: f64,
    /// SIFT: the largest ratio of the principal curvatures, > 1. 10.
    pub edge_threshold: f32,
    /// SIFT: photographs of up to so many pixels are looked at in twice their size, too; 0 for none.
    /// 1.5 million: larger ones have features enough, and doubling them takes seconds.
    pub max_upsampled_pixels: u64,
    /// Take every direction to be 0, for cameras held upright. Harris' corners have none. False.
    pub upright: bool,
}

impl Default for FeatureOptions {
    fn default() -> Self {
        Self {
            kind: FeatureKind::RootSift,
            max_features: 8192,
            contrast_threshold: None,
            input_blur_px: 0.5,
            edge_threshold: SiftOptions::default().edge_threshold,
            max_upsampled_pixels: 1_500_000,
            upright: false,
        }
    }
}

impl FeatureOptions {
    /// What they are for SIFT, in an image of that size.
    ///
    /// ```
    /// let options = epipole::feature::FeatureOptions::default();
    /// assert!(options.sift(1200, 900).upsample && !options.sift(4000, 3000).upsample);
    /// ```
    pub fn sift(&self, width: u32, height: u32) -> SiftOptions {
        SiftOptions {
            max_features: self.max_features,
            contrast_threshold: self.contrast_threshold.unwrap_or(0.02),
            edge_threshold: self.edge_threshold,
            input_blur_px: self.input_blur_px,
            upsample: u64::from(width) * u64::from(height) <= self.max_upsampled_pixels,
            upright: self.upright,
            normalization: match self.kind {
                FeatureKind::Sift => SiftNormalization::L2,
                _ => SiftNormalization::Root,
            },
            ..SiftOptions::default()
        }
    }

    fn orb(&self) -> OrbOptions {
        let default = OrbOptions::default();
        OrbOptions {
            max_features: match self.max_features {
                0 => u32::MAX as usize,
                limit => limit,
            },
            fast_threshold: self.contrast_threshold.unwrap_or(default.fast_threshold),
            upright: self.upright,
            ..default
        }
    }

    fn harris(&self) -> GoodFeaturesOptions {
        let default = GoodFeaturesOptions::default();
        GoodFeaturesOptions {
            max_corners: self.max_features,
            quality: self.contrast_threshold.unwrap_or(default.quality),
            measure: CornerMeasure::Harris(0.04),
            ..default
        }
    }
}

/// Descriptors of whatever kind.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyDescriptors {
    /// Numbers, compared by Euclidean distance: SIFT, RootSIFT, patches.
    Vectors(Descriptors),
    /// Bits, compared by how many differ: ORB.
    Bits(BinaryDescriptors),
}

impl AnyDescriptors {
    /// The numbers; `None` for bits.
    pub fn as_vectors(&self) -> Option<&Descriptors> {
        match self {
            Self::Vectors(vectors) => Some(vectors),
            Self::Bits(_) => None,
        }
    }
}

/// Keypoints and their descriptors; entry k of one belongs to entry k of the other.
#[derive(Debug, Clone, PartialEq)]
pub struct AnyFeatures {
    /// Where.
    pub keypoints: Vec<Keypoint>,
    /// What it looks like there.
    pub descriptors: AnyDescriptors,
}

/// The gray values in [0, 1] in which features of a photograph are looked for: 8 bits, equal to
/// OpenCV's ([`rgb_to_gray`]), so that every command finds the same features in a photograph.
///
/// ```
/// use image::{Rgb, RgbImage};
/// let red = RgbImage::from_pixel(1, 1, Rgb([255, 0, 0]));
/// assert_eq!(epipole::feature::photo_to_gray(&red).get_pixel(0, 0).0, [76.0 / 255.0]);
/// ```
pub fn photo_to_gray(photo: &RgbImage) -> GrayImage32 {
    gray_to_f32(&rgb_to_gray(photo))
}

/// The features of an image, of the kind that `options` names, strongest first.
///
/// Corners of Harris are located between pixels; those that cannot be are dropped.
///
/// # Errors
/// [`Error::NotFinite`] for a bad pixel, [`Error::OutOfRange`] for an option outside its range.
///
/// Source: as [`detect_sift`](super::detect_sift), [`detect_orb`], [`good_features_to_track`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{FeatureKind, FeatureOptions, detect_features};
/// use epipole::imaging::GrayImage32;
/// // A bright square on dark ground has four corners.
/// let square = GrayImage32::from_fn(64, 64, |u, v| {
///     let inside = |x: u32| (20..44).contains(&x);
///     image::Luma([if inside(u) && inside(v) { 0.9 } else { 0.1 }])
/// });
/// let options = FeatureOptions { kind: FeatureKind::Harris, ..FeatureOptions::default() };
/// assert_eq!(detect_features(&square, &options)?.keypoints.len(), 4);
/// # Ok(()) }
/// ```
pub fn detect_features(image: &GrayImage32, options: &FeatureOptions) -> Result<AnyFeatures> {
    detect_features_with_progress(image, options, &mut |_| ControlFlow::Continue(()))
}

/// [`detect_features`] that reports how far it is and can be stopped, where that takes long: for SIFT.
///
/// * `progress`: hears how far the one stage, [`Stage::FeatureDetection`](crate::progress::Stage::FeatureDetection),
///   is, and says whether to go on; ORB, which is quick, tells nothing
///
/// # Errors
/// As [`detect_features`], and [`Error::Canceled`] if `progress` said so.
///
/// Source: as [`detect_features`].
///
/// ```
/// use epipole::feature::{FeatureOptions, detect_features_with_progress};
/// use std::ops::ControlFlow;
/// let image = epipole::imaging::GrayImage32::new(64, 64);
/// let stop = &mut |_| ControlFlow::Break(());
/// let stopped = detect_features_with_progress(&image, &FeatureOptions::default(), stop);
/// assert_eq!(stopped, Err(epipole::Error::Canceled));
/// ```
pub fn detect_features_with_progress(
    image: &GrayImage32,
    options: &FeatureOptions,
    progress: Progress<'_>,
) -> Result<AnyFeatures> {
    match options.kind {
        FeatureKind::Sift | FeatureKind::RootSift => {
            let sift = options.sift(image.width(), image.height());
            let found = detect_sift_with_progress(image, &sift, progress)?;
            Ok(AnyFeatures {
                keypoints: found.keypoints,
                descriptors: AnyDescriptors::Vectors(found.descriptors),
            })
        }
        FeatureKind::Orb => {
            let found = detect_orb(image, &options.orb())?;
            Ok(AnyFeatures {
                keypoints: found.keypoints,
                descriptors: AnyDescriptors::Bits(found.descriptors),
            })
        }
        FeatureKind::Harris => harris(image, &options.harris()),
    }
}

fn harris(image: &GrayImage32, options: &GoodFeaturesOptions) -> Result<AnyFeatures> {
    let corners = good_features_to_track(image, options)?;
    let places: Vec<_> = corners.iter().map(Keypoint::point).collect();
    let refined = refine_corners(image, &places, &RefineOptions::default())?;
    // A corner that cannot be refined is not one.
    let keypoints: Vec<Keypoint> = (corners.into_iter().zip(refined))
        .filter_map(|(corner, place)| {
            place.map(|place| Keypoint {
                u: place.x,
                v: place.y,
                ..corner
            })
        })
        .collect();
    let descriptors = describe_patches(image, &keypoints, 11, 1.0)?;
    Ok(AnyFeatures {
        keypoints,
        descriptors: AnyDescriptors::Vectors(descriptors),
    })
}

/// The matches of two lists of descriptors of one kind, in the order of the first.
///
/// # Errors
/// [`Error::Degenerate`] if one list is of numbers and the other of bits; else as
/// [`match_descriptors`] and [`match_hamming`].
///
/// Source: as [`match_descriptors`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{AnyDescriptors, Descriptors, MatchOptions, match_any_descriptors};
/// let list = |values| Descriptors::from_bytes(2, values).map(AnyDescriptors::Vectors);
/// let (first, second) = (list(vec![9, 9])?, list(vec![90, 90, 8, 9])?);
/// let matches = match_any_descriptors(&first, &second, &MatchOptions::default())?;
/// assert_eq!((matches.len(), matches[0].index2), (1, 1));
/// # Ok(()) }
/// ```
pub fn match_any_descriptors(
    first: &AnyDescriptors,
    second: &AnyDescriptors,
    options: &MatchOptions,
) -> Result<Vec<Match>> {
    match (first, second) {
        (AnyDescriptors::Vectors(a), AnyDescriptors::Vectors(b)) => {
            match_descriptors(a, b, options)
        }
        (AnyDescriptors::Bits(a), AnyDescriptors::Bits(b)) => match_hamming(a, b, options),
        _ => Err(Error::Degenerate {
            what: "the distance of two descriptors",
            why: "one is a list of numbers and the other one of bits",
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Luma, Rgb};

    /// Boxes of several sizes on a slope of gray.
    fn boxes() -> GrayImage32 {
        GrayImage32::from_fn(120, 100, |u, v| {
            let inside = |u0: u32, v0: u32, side: u32| {
                (u0..u0 + side).contains(&u) && (v0..v0 + side).contains(&v)
            };
            let value = match (inside(20, 15, 12), inside(60, 30, 25), inside(25, 60, 18)) {
                (true, ..) => 0.9,
                (_, true, _) => 0.1,
                (.., true) => 0.7,
                _ => 0.35,
            };
            Luma([value])
        })
    }

    const KINDS: [FeatureKind; 4] = [
        FeatureKind::Sift,
        FeatureKind::RootSift,
        FeatureKind::Orb,
        FeatureKind::Harris,
    ];

    #[test]
    fn every_kind_obeys_number_and_strength() {
        let image = boxes();
        let count =
            |options: &FeatureOptions| detect_features(&image, options).unwrap().keypoints.len();
        for kind in KINDS {
            let with = |max_features, contrast_threshold| {
                count(&FeatureOptions {
                    kind,
                    max_features,
                    contrast_threshold,
                    ..FeatureOptions::default()
                })
            };
            let all = with(0, None);
            assert!(all > 3, "{kind:?} {all}");
            assert_eq!(with(8192, None), all, "{kind:?}");
            assert_eq!(with(3, None), 3, "{kind:?}");
            let strong = with(0, Some(0.5));
            assert!(strong < all, "{kind:?} {strong} of {all}");
        }
    }

    #[test]
    fn every_kind_matches_itself_and_no_kind_of_the_other_sort() {
        let image = boxes();
        let found = KINDS.map(|kind| {
            let options = FeatureOptions {
                kind,
                ..FeatureOptions::default()
            };
            detect_features(&image, &options).unwrap()
        });
        for features in &found {
            let to = &features.descriptors;
            let matches = match_any_descriptors(to, to, &MatchOptions::default()).unwrap();
            assert!(!matches.is_empty());
            assert!(matches.iter().all(|m| m.index1 == m.index2));
        }
        let [sift, _, orb, _] = &found;
        let options = MatchOptions::default();
        assert!(match_any_descriptors(&sift.descriptors, &orb.descriptors, &options).is_err());
        assert!(sift.descriptors.as_vectors().is_some() && orb.descriptors.as_vectors().is_none());
    }

    #[test]
    fn photographs_are_gray_as_in_8_bits() {
        let photo = RgbImage::from_fn(16, 16, |u, v| Rgb([(u * 16) as u8, (v * 16) as u8, 77]));
        let gray = photo_to_gray(&photo);
        for value in gray.as_raw() {
            let level = value * 255.0;
            assert!((level - level.round()).abs() < 1e-4, "{level}");
        }
    }
}
