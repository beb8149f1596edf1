//! Which features commands look for, and how they match them.

use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::photo::Photo;
use crate::progress::Progress;
use clap::{Args, ValueEnum};
use epipole::feature::{
    BinaryDescriptors, CornerMeasure, Descriptors, GoodFeaturesOptions, Keypoint, Match,
    MatchOptions, OrbOptions, RefineOptions, SiftNormalization, SiftOptions, describe_patches,
    detect_orb, detect_sift_with_progress, good_features_to_track, match_descriptors,
    match_hamming, refine_corners,
};

/// The kinds of feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// Scale-invariant features, Euclidean descriptors.
    Sift,
    /// The same with the Hellinger kernel; usually matches better.
    Rootsift,
    /// Oriented FAST corners with 256 comparisons: fast.
    Orb,
    /// Harris corners with normalized patches: for pictures taken from nearly the same place.
    Harris,
}

/// The options that all commands with features share.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct FeatureArguments {
    /// Which features to look for.
    #[arg(long, value_enum, default_value = "rootsift")]
    pub(crate) features: Kind,
    /// At most so many features an image, the strongest; 0 for no limit.
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub(crate) max_features: usize,
}

/// Keypoints and their descriptors.
pub(crate) struct Detected {
    pub(crate) keypoints: Vec<Keypoint>,
    descriptors: AnyDescriptors,
}

enum AnyDescriptors {
    Vectors(Descriptors),
    Bits(BinaryDescriptors),
}

impl FeatureArguments {
    /// Looks for features in a photograph.
    ///
    /// # Errors
    /// As the core's detectors.
    pub(crate) fn detect(&self, photo: &Photo, context: &Context) -> Result<Detected, Failure> {
        let progress = Progress::new(context, "features");
        let gray = photo.gray();
        match self.features {
            Kind::Sift | Kind::Rootsift => {
                let normalization = match self.features {
                    Kind::Sift => SiftNormalization::L2,
                    _ => SiftNormalization::Root,
                };
                let options = SiftOptions {
                    max_features: self.max_features,
                    normalization,
                    ..SiftOptions::default()
                };
                let found = detect_sift_with_progress(&gray, &options, &mut |share| {
                    progress.set(f64::from(share));
                    !interrupt::requested()
                })?;
                let descriptors = AnyDescriptors::Vectors(found.descriptors);
                Ok(Detected {
                    keypoints: found.keypoints,
                    descriptors,
                })
            }
            Kind::Orb => {
                let default = OrbOptions::default();
                let max_features = match self.max_features {
                    0 => default.max_features,
                    limit => limit,
                };
                let found = detect_orb(
                    &gray,
                    &OrbOptions {
                        max_features,
                        ..default
                    },
                )?;
                Ok(Detected {
                    keypoints: found.keypoints,
                    descriptors: AnyDescriptors::Bits(found.descriptors),
                })
            }
            Kind::Harris => {
                let options = GoodFeaturesOptions {
                    max_corners: self.max_features,
                    measure: CornerMeasure::Harris(0.04),
                    ..GoodFeaturesOptions::default()
                };
                let corners = good_features_to_track(&gray, &options)?;
                let places: Vec<_> = corners.iter().map(Keypoint::point).collect();
                let refined = refine_corners(&gray, &places, &RefineOptions::default())?;
                // A corner that cannot be refined is not one.
                let keypoints: Vec<Keypoint> = corners
                    .into_iter()
                    .zip(refined)
                    .filter_map(|(corner, place)| {
                        place.map(|place| Keypoint {
                            u: place.x,
                            v: place.y,
                            ..corner
                        })
                    })
                    .collect();
                let descriptors = describe_patches(&gray, &keypoints, 11, 1.0)?;
                Ok(Detected {
                    keypoints,
                    descriptors: AnyDescriptors::Vectors(descriptors),
                })
            }
        }
    }
}

/// The options that all commands with matches share.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MatchArguments {
    /// The nearest descriptor must be closer than this share of the second nearest.
    #[arg(long, default_value_t = 0.8, value_name = "SHARE", value_parser = ratio)]
    pub(crate) ratio: f32,
    /// Each must be the other's nearest.
    #[arg(long)]
    pub(crate) mutual: bool,
}

fn ratio(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(ratio) if ratio > 0.0 && ratio <= 1.0 => Ok(ratio),
        _ => Err(format!("\"{text}\" is not a number above 0 and at most 1")),
    }
}

impl MatchArguments {
    /// Matches the features of two photographs, the least ambiguous first: some samplers make use of it.
    ///
    /// # Errors
    /// As [`MatchArguments::run`].
    pub(crate) fn run_best_first(
        &self,
        first: &Detected,
        second: &Detected,
    ) -> Result<Vec<Match>, Failure> {
        let mut matches = self.run(first, second)?;
        matches.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        Ok(matches)
    }

    /// Matches the features of two photographs.
    ///
    /// # Errors
    /// As the core's matchers.
    pub(crate) fn run(&self, first: &Detected, second: &Detected) -> Result<Vec<Match>, Failure> {
        let options = MatchOptions {
            max_ratio: Some(self.ratio),
            mutual: self.mutual,
            ..MatchOptions::default()
        };
        match (&first.descriptors, &second.descriptors) {
            (AnyDescriptors::Vectors(a), AnyDescriptors::Vectors(b)) => {
                Ok(match_descriptors(a, b, &options)?)
            }
            (AnyDescriptors::Bits(a), AnyDescriptors::Bits(b)) => {
                Ok(match_hamming(a, b, &options)?)
            }
            _ => Err(Failure::new(
                "failed",
                "descriptors of different kinds cannot be compared",
            )),
        }
    }
}

/// `[u, v, scale_px, angle_rad, response]` of each keypoint.
pub(crate) fn rows(keypoints: &[Keypoint]) -> Vec<[f64; 5]> {
    let row = |keypoint: &Keypoint| {
        let [scale, angle, response] =
            [keypoint.scale_px, keypoint.angle_rad, keypoint.response].map(f64::from);
        [keypoint.u, keypoint.v, scale, angle, response]
    };
    keypoints.iter().map(row).collect()
}
