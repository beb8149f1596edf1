//! Command-line options of `epipole two-view`.

use crate::camera::PairArguments;
use crate::context::Context;
use crate::features::{FeatureArguments, MatchArguments};
use crate::known_camera::CameraFile;
use crate::matrices::positive;
use crate::reading::SizeArguments;
use crate::robust::{PHOTO_MAX_ERROR, RobustArguments};
use clap::{Args, ValueEnum};
use epipole::two_view::TwoViewOptions;
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Model {
    /// Whichever fits best.
    Auto,
    /// Pixels only.
    Fundamental,
    /// For known intrinsics; also gives the motion.
    Essential,
    /// For a plane, or a camera that only turned; known intrinsics tell a turn.
    Homography,
}

/// Find the geometry of two photographs.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_error_px", |argument| argument.help(
        "The largest error of an inlier, pixels: Sampson error of F and E; of planes and turns 1.25 \
         times it, or with --model homography the distance in image 2; \"auto\" finds it from the \
         noise of the matches"
    ).default_value(PHOTO_MAX_ERROR)),
    mut_arg("camera_file", |argument| argument.conflicts_with_all(["k", "k2", "focal_px"])),
    after_help = "Example: epipole two-view left.jpg right.jpg --focal-px 1200\n\n\
    With --model essential, a focal length that neither --k, --focal-px nor EXIF data tell is found from\n\
    the matches, if they tell it, or else taken to be 1.2 times the longer side.\n\n\
    A match can miss an epipolar line in one dimension, a plane or a turn in two. So, when auto finds\n\
    one of these, its inliers have a Sampson error of H of up to 1.25 times --max-error-px.\n\n\
    --matches reads what epipole match -o or another matcher wrote: u1 v1 u2 v2 a line. Without photos, intrinsics\n\
    are those of --k or --camera.\n\n\
    With --camera E and H are of rays, x2ᵀ E x1 = 0 and x2 ∝ H x1, and there is no F. Errors stay those of the\n\
    photographs: of H in image 2, where those of an auto search may be 1.25 √2 times --max-error-px.\n\n\
    JSON: model_kind (fundamental, essential or homography), model (9 numbers row by row),\n\
    model_of (pixels; rays with --camera; of an E always rays),\n\
    num_keypoints (of both photographs; null with --matches), num_matches, num_inliers, matches ([u1, v1, u2, v2, 1 for an\n\
    inlier or 0] each), cam2_from_cam1 (rotation and translation of length 1, or 0 if the camera only\n\
    turned; null if unknown), other_cam2_from_cam1 (of a plane: another motion that fits as well, or\n\
    null), focals_px (with --model essential the focal lengths of both photographs, else null),\n\
    max_error_px (that of the options, or with auto the one found), mean_sampson_px (of the\n\
    inliers), configuration (general; planar: a plane, or a turn if no intrinsics are known; panoramic:\n\
    a turn; degenerate: no more than chance)."
)]
pub(crate) struct Arguments {
    /// The first photograph.
    #[arg(
        value_name = "FIRST",
        required_unless_present = "matches",
        requires = "second"
    )]
    pub(super) first: Option<PathBuf>,
    /// The second photograph.
    #[arg(
        value_name = "SECOND",
        required_unless_present = "matches",
        requires = "first"
    )]
    pub(super) second: Option<PathBuf>,
    /// Take the matches of a file instead of features; the photos may then be left out.
    #[arg(long, value_name = "FILE")]
    pub(super) matches: Option<PathBuf>,
    /// Write the matches that are inliers; with commas if the name ends in .csv; -: standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Which model to look for.
    #[arg(long, value_enum, default_value = "auto")]
    pub(super) model: Model,
    #[command(flatten)]
    pub(super) camera: PairArguments,
    #[command(flatten)]
    pub(super) known: CameraFile,
    #[command(flatten)]
    pub(super) features: FeatureArguments,
    #[command(flatten)]
    pub(super) matching: MatchArguments,
    #[command(flatten)]
    pub(super) robust: RobustArguments,
    #[command(flatten)]
    judging: JudgingArguments,
    #[command(flatten)]
    pub(super) size: SizeArguments,
}

/// Options of the choice among models.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Configuration")]
struct JudgingArguments {
    /// With fewer different inliers the configuration is degenerate.
    #[arg(long, default_value_t = TwoViewOptions::default().min_num_inliers, value_name = "N")]
    min_inliers: usize,
    /// A homography that explains this share of the other inliers means a plane or a turn.
    #[arg(long, default_value_t = TwoViewOptions::default().max_homography_share, value_name = "SHARE", value_parser = positive)]
    max_homography_share: f64,
    /// E is preferred to F if it has this share of F's inliers.
    #[arg(long, default_value_t = TwoViewOptions::default().min_essential_share, value_name = "SHARE", value_parser = positive)]
    min_essential_share: f64,
}

impl Arguments {
    /// Options of the core.
    pub(super) fn options(&self, context: &Context) -> TwoViewOptions {
        TwoViewOptions::default()
            .with_ransac(self.robust.options(context))
            .with_min_num_inliers(self.judging.min_inliers)
            .with_max_homography_share(self.judging.max_homography_share)
            .with_min_essential_share(self.judging.min_essential_share)
    }
}
