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
    /// The model that fits best.
    Auto,
    /// Pixels only.
    Fundamental,
    /// For known intrinsics; also gives the motion.
    Essential,
    /// For a plane or a rotation-only motion; known intrinsics tell them apart.
    Homography,
}

/// Estimate the geometry of two images.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_error_px", |argument| argument.help(
        "Maximum error of an inlier (pixels, Sampson error of F and E; 1.25 times as much for planes and \
         rotations, or with --model homography the distance in image 2; \"auto\" finds it from the noise \
         of the matches)"
    ).default_value(PHOTO_MAX_ERROR)),
    mut_arg("camera_file", |argument| argument.conflicts_with_all(["k", "k2", "focal_px"])),
    after_help = "Example: epipole two-view left.jpg right.jpg --focal-px 1200\n\n\
    With --model essential, a focal length that is in neither --k, --focal-px nor EXIF data is estimated\n\
    from the matches if they determine it, else it is 1.2 times the longer side.\n\n\
    A match can miss an epipolar line in one dimension, a plane or a rotation in two. If auto finds one of\n\
    these, its inliers therefore have a Sampson error of H of up to 1.25 times --max-error-px.\n\n\
    --matches reads a file of epipole match -o or another matcher: u1 v1 u2 v2 per line. Without images, intrinsics\n\
    are those of --k or --camera.\n\n\
    With --camera, E and H relate rays, x2ᵀ E x1 = 0 and x2 ∝ H x1, and there is no F. Errors are still in pixels\n\
    of the images: for H in image 2, with auto up to 1.25 √2 times --max-error-px.\n\n\
    JSON: model_kind (fundamental, essential or homography), model (9 numbers row by row),\n\
    model_of (pixels; rays with --camera; for E always rays), num_keypoints (of both images; null with\n\
    --matches), num_matches, num_inliers, matches ([u1, v1, u2, v2, 1 for an inlier or 0] each),\n\
    cam2_from_cam1 (rotation and translation of length 1, or 0 if the camera only rotated; null if\n\
    unknown), other_cam2_from_cam1 (for a plane: another motion that fits equally well, or null),\n\
    focals_px (with --model essential the focal lengths of both images, else null), max_error_px (as\n\
    given, or as found by auto), mean_sampson_px (of the inliers), configuration (general; planar: a\n\
    plane, or a rotation if no intrinsics are known; panoramic: a rotation; degenerate: not\n\
    significant)."
)]
pub(crate) struct Arguments {
    /// First image.
    #[arg(
        value_name = "FIRST",
        required_unless_present = "matches",
        requires = "second"
    )]
    pub(super) first: Option<PathBuf>,
    /// Second image.
    #[arg(
        value_name = "SECOND",
        required_unless_present = "matches",
        requires = "first"
    )]
    pub(super) second: Option<PathBuf>,
    /// Read matches from a file (instead of detecting features; the images are then optional).
    #[arg(long, value_name = "FILE")]
    pub(super) matches: Option<PathBuf>,
    /// Write the inliers (comma-separated if the name ends in .csv; -: standard output).
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Model to search for.
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

/// Options of model selection.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Configuration")]
struct JudgingArguments {
    /// Minimum number of distinct inliers; with fewer, the configuration is degenerate.
    #[arg(long, default_value_t = TwoViewOptions::default().min_num_inliers, value_name = "N")]
    min_inliers: usize,
    /// Minimum ratio of the epipolar inliers explained by a homography that means a plane or a
    /// rotation.
    #[arg(long, default_value_t = TwoViewOptions::default().max_homography_ratio, value_name = "RATIO", value_parser = positive)]
    max_homography_ratio: f64,
    /// Minimum ratio of E's inliers to F's for E to be preferred.
    #[arg(long, default_value_t = TwoViewOptions::default().min_essential_ratio, value_name = "RATIO", value_parser = positive)]
    min_essential_ratio: f64,
}

impl Arguments {
    /// Returns the options of the core.
    pub(super) fn options(&self, context: &Context) -> TwoViewOptions {
        TwoViewOptions::default()
            .with_ransac(self.robust.options(context))
            .with_min_num_inliers(self.judging.min_inliers)
            .with_max_homography_ratio(self.judging.max_homography_ratio)
            .with_min_essential_ratio(self.judging.min_essential_ratio)
    }
}
