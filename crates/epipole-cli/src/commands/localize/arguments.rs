//! Command-line options of `epipole localize`.

use crate::camera::CameraArguments;
use crate::features::{FeatureArguments, MatchArguments};
use crate::listing::ListingArguments;
use crate::reading::SizeArguments;
use crate::robust::RobustArguments;
use clap::Args;
use epipole::sfm::LocalizeOptions;
use std::path::PathBuf;

const EXAMPLE: &str = "Example: epipole localize new.jpg reconstruction/ --images photos/";

/// Find the poses of new photos in a model.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_error_px", |argument| argument.default_value("6")),
    after_help = EXAMPLE,
    after_long_help = "Example: epipole localize new.jpg reconstruction/ --images photos/\n\n\
    The model is one of COLMAP (text, binary), Bundler or openMVG, with observations of its points. Features are\n\
    found in the images of the model and in the new photos; a feature at an observation of a point belongs to\n\
    that point.\n\n\
    The camera of a new photo is that of --k, --focal-px or --camera; else the camera of the model with the same\n\
    size, or the only one with the same shape; else it has the focal length of the EXIF data, or 1.2 times the\n\
    longer side.\n\n\
    JSON: photos (name; cam_from_world and center, null where it was not found; num_inliers, num_matches, focal_px;\n\
    reason, null where it was found), num_localized, num_observations (of points in the images of the model),\n\
    num_found_again (those where a feature is)."
)]
pub(crate) struct Arguments {
    /// New photos, or folders of them.
    #[arg(required = true, value_name = "PHOTO")]
    pub(super) photos: Vec<PathBuf>,
    /// File or folder of a model.
    #[arg(required = true)]
    pub(super) model: PathBuf,
    /// Folder of the model's images [default: images/, in the model or above it].
    #[arg(long, value_name = "DIR")]
    pub(super) images: Option<PathBuf>,
    #[command(flatten)]
    pub(super) camera: CameraArguments,
    /// Camera file of the new photos (FILE#NAME: one of several).
    #[arg(long = "camera", value_name = "FILE", conflicts_with_all = ["k", "focal_px"])]
    pub(super) camera_file: Option<PathBuf>,
    /// Minimum number of inliers of a pose.
    #[arg(long, default_value_t = LocalizeOptions::default().min_num_inliers, value_name = "N")]
    pub(super) min_inliers: usize,
    #[command(flatten)]
    pub(super) listing: ListingArguments,
    #[command(flatten)]
    pub(super) features: FeatureArguments,
    #[command(flatten)]
    pub(super) matching: MatchArguments,
    #[command(flatten)]
    pub(super) robust: RobustArguments,
    #[command(flatten)]
    pub(super) size: SizeArguments,
}
