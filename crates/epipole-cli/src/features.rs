//! Command-line options of feature detection and matching, with the defaults of the core.

mod kinds;
mod numbers;

use self::kinds::KindArguments;
use self::numbers::{above_0_up_to_1, not_negative};
use crate::context::Context;
use crate::failure::Failure;
use crate::photo::Photo;
use crate::progress::Progress;
use clap::{ArgAction, Args, ValueEnum};
use epipole::feature::{
    FeatureKind, FeatureOptions, Features, Keypoint, Match, MatchOptions, detect_features,
    match_descriptors,
};
use nalgebra::Point2;

/// The kinds of feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// Scale-invariant features, Euclidean descriptors.
    Sift,
    /// SIFT with the Hellinger kernel; usually matches better.
    Rootsift,
    /// Oriented FAST corners with 256 comparisons: fast.
    Orb,
    /// Harris corners with normalized patches: for images taken from nearly the same place.
    Harris,
}

impl From<Kind> for FeatureKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Sift => Self::Sift,
            Kind::Rootsift => Self::RootSift,
            Kind::Orb => Self::Orb,
            Kind::Harris => Self::Harris,
        }
    }
}

/// Options shared by all commands with features.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Features")]
pub(crate) struct FeatureArguments {
    /// Kind of features.
    #[arg(long, value_enum, default_value_t = Kind::Rootsift)]
    pub(crate) features: Kind,
    /// Number of features per image (the strongest; 0: all).
    #[arg(long, default_value_t = FeatureOptions::default().max_features, value_name = "N")]
    pub(crate) max_features: usize,
    /// Minimum response of a feature, for gray from 0 to 1 [default: 0.02 for SIFT, 0.078 for ORB,
    /// 0.01 of the strongest for Harris].
    #[arg(long, value_name = "C", value_parser = above_0_up_to_1)]
    pub(crate) contrast_threshold: Option<f32>,
    /// Assume upright features (skip orientation).
    #[arg(long)]
    pub(crate) upright: bool,
    #[command(flatten)]
    kinds: KindArguments,
}

impl FeatureArguments {
    /// Returns the options of the core.
    pub(crate) fn options(&self) -> FeatureOptions {
        let common = FeatureOptions::default()
            .with_kind(self.features.into())
            .with_max_features(self.max_features)
            .with_contrast_threshold(self.contrast_threshold)
            .with_upright(self.upright);
        self.kinds.options(common)
    }

    /// Detects the features of a photo.
    ///
    /// # Errors
    /// As the core's detectors.
    pub(crate) fn detect(&self, photo: &Photo, context: &Context) -> Result<Features, Failure> {
        let progress = Progress::new(context, "features");
        let watch = &mut |status| progress.show(status);
        Ok(detect_features(&photo.gray(), &self.options(), watch)?)
    }
}

/// Options shared by all commands with matches.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Matches")]
pub(crate) struct MatchArguments {
    /// Ratio test (maximum ratio of the distances to the nearest and second-nearest descriptor).
    #[arg(long, default_value_t = 0.8, value_name = "RATIO", value_parser = above_0_up_to_1)]
    pub(crate) ratio: f32,
    /// Require mutual nearest neighbors; --mutual=false to disable.
    #[arg(long, action = ArgAction::Set, num_args = 0..=1, require_equals = true, default_value_t = true, default_missing_value = "true")]
    pub(crate) mutual: bool,
    /// Keep only the closest match of each feature of the second image; --unique=false to disable.
    /// Mutual matches are already unique.
    #[arg(long, action = ArgAction::Set, num_args = 0..=1, require_equals = true, default_value_t = true, default_missing_value = "true")]
    pub(crate) unique: bool,
    /// Maximum distance of two descriptors [default: any].
    #[arg(long, value_name = "D", value_parser = not_negative)]
    pub(crate) max_distance: Option<f32>,
}

impl MatchArguments {
    /// Returns the options of the core.
    pub(crate) fn options(&self) -> MatchOptions {
        MatchOptions::default()
            .with_max_ratio(Some(self.ratio))
            .with_mutual(self.mutual)
            .with_max_distance(self.max_distance)
            .with_unique(self.unique)
    }

    /// Matches the features of two photos and sorts the matches, least ambiguous first, for PROSAC.
    ///
    /// # Errors
    /// As [`MatchArguments::run`].
    pub(crate) fn run_best_first(
        &self,
        first: &Features,
        second: &Features,
    ) -> Result<Vec<Match>, Failure> {
        let mut matches = self.run(first, second)?;
        matches.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        Ok(matches)
    }

    /// Matches the features of two photos.
    ///
    /// # Errors
    /// As the core's matchers.
    pub(crate) fn run(&self, first: &Features, second: &Features) -> Result<Vec<Match>, Failure> {
        let (a, b) = (&first.descriptors, &second.descriptors);
        Ok(match_descriptors(a, b, &self.options(), &mut ())?)
    }
}

/// Returns the pixels of matches in both photos.
pub(crate) fn matched_pixels(
    matches: &[Match],
    first: &Features,
    second: &Features,
) -> [Vec<Point2<f64>>; 2] {
    let pixels1 = matches.iter().map(|m| first.keypoints[m.index1].point());
    let pixels2 = matches.iter().map(|m| second.keypoints[m.index2].point());
    [pixels1.collect(), pixels2.collect()]
}

/// Returns `[u, v, scale_px, angle_rad, response]` of each keypoint.
pub(crate) fn rows(keypoints: &[Keypoint]) -> Vec<[f64; 5]> {
    let row = |keypoint: &Keypoint| {
        let [scale, angle, response] =
            [keypoint.scale_px, keypoint.angle_rad, keypoint.response].map(f64::from);
        [keypoint.u, keypoint.v, scale, angle, response]
    };
    keypoints.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::robust::RobustArguments;
    use clap::Parser;
    use epipole::robust::RansacOptions;

    #[derive(Debug, Parser)]
    struct All {
        #[command(flatten)]
        features: FeatureArguments,
        #[command(flatten)]
        matching: MatchArguments,
        #[command(flatten)]
        robust: RobustArguments,
    }

    fn parsed(words: &[&str]) -> All {
        All::try_parse_from([&["epipole"], words].concat()).unwrap()
    }

    #[test]
    fn omitted_options_have_the_defaults_of_the_core() {
        let all = parsed(&[]);
        assert_eq!(all.features.options(), FeatureOptions::default());
        assert_eq!(all.matching.options(), MatchOptions::default());
        let context = Context {
            quiet: true,
            seed: RansacOptions::default().seed,
        };
        assert_eq!(all.robust.options(&context), RansacOptions::default());
    }

    #[test]
    fn mutual_can_be_set_and_unset() {
        assert!(parsed(&["--mutual"]).matching.mutual);
        assert!(!parsed(&["--mutual=false"]).matching.mutual);
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        for words in [
            ["--ratio", "0"],
            ["--ratio", "1.5"],
            ["--contrast-threshold", "nan"],
            ["--contrast-threshold", "0"],
            ["--edge-threshold", "1"],
            ["--edge-threshold", "inf"],
            ["--max-distance=-1", "--upright"],
            ["--input-blur-px", "2.1"],
            ["--sigma-px", "nan"],
            ["--layers-per-octave", "0"],
            ["--max-orientations", "37"],
            ["--orientation-peak-ratio", "0"],
            ["--num-levels", "17"],
            ["--scale-factor", "1"],
            ["--harris-k", "0.25"],
            ["--min-distance-px", "inf"],
            ["--tensor-window-px", "256"],
            ["--patch-px", "1.5"],
        ] {
            let refused = All::try_parse_from([&["epipole"][..], &words].concat());
            assert!(refused.is_err(), "{words:?}");
        }
    }
}
