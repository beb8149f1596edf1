//! Options of `epipole sfm`.

use super::growth::GrowthArguments;
use super::input::InputArguments;
use super::positions::PositionArguments;
use crate::features::{FeatureArguments, MatchArguments};
use crate::robust::{PHOTO_MAX_ERROR, RobustArguments};
use clap::Args;
use epipole::robust::SamplerKind;
use epipole::sfm::{PhotoOptions, SfmOptions};
use std::path::PathBuf;

/// Reconstruct a scene from photos.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_error_px", |argument| argument.help(
        "Maximum error of a match of two images (pixels, Sampson error of E; \"auto\" finds it for each \
         pair from the noise of its matches)"
    ).default_value(PHOTO_MAX_ERROR)),
    after_help = "Example: epipole sfm photos/ --focal-px 2400 -o reconstruction\n\n\
    Writes cameras.txt, images.txt and points3D.txt (COLMAP's text model) and points.ply, with --images also the\n\
    images, in images/. If names have blanks, at which COLMAP cuts names in text, its binary model is added.\n\
    Files of an earlier run in OUT are removed, others stay.\n\n\
    cameras.txt has PINHOLE cameras, or OPENCV, FULL_OPENCV, OPENCV_FISHEYE or DIVISION if --camera has a lens or\n\
    distortion was refined. Give --undistort for programs that support PINHOLE only.\n\n\
    If the EXIF data of an image have no focal length, it begins at 1.2 times the longer side, and one factor for\n\
    all focal lengths is refined. If nothing is known of the cameras, focal length and radial distortion are\n\
    refined at the end, if five or more images show that this lowers the error by 5%.\n\n\
    With --poses, cameras and poses come from a model of COLMAP, Bundler, nerfstudio or openMVG, and points from\n\
    the matches that fit; images that the model does not have are left out.\n\n\
    JSON: num_registered, num_images, num_points, mean_reprojection_px, images (name, focal_px, lens: brown,\n\
    rational, fisheye or division, distortion: coefficients as in a camera file, for a brown lens k1, k2, p1, p2\n\
    and k3, cam_from_world with rotation and translation), all for the largest component; focal_refined (whether\n\
    focal lengths were refined), focal_determined (whether the images determine them; null if not refined),\n\
    lens_refined (whether radial distortion was refined too), with --positions placed (whether the model is\n\
    aligned to them, in meters), position_rms_m, origin (of the coordinates, if positions are in degrees),\n\
    unregistered (name and reason of each image that is not in the largest component), components (num_registered\n\
    and num_points of each), complete (false after Ctrl-C)."
)]
pub(crate) struct Arguments {
    /// Output folder.
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Also write the images that cameras.txt describes (upright, downscaled, undistorted by
    /// --undistort) to OUT/images. Changed images become JPEG files.
    #[arg(long)]
    pub(super) images: bool,
    #[command(flatten)]
    pub(super) input: InputArguments,
    #[command(flatten)]
    pub(super) features: FeatureArguments,
    #[command(flatten)]
    pub(super) matching: MatchArguments,
    /// Number of following images to match each image with, for frames in temporal order.
    #[arg(long, default_value_t = 0, value_name = "N", help_heading = "Matches")]
    pub(super) neighbors: usize,
    /// Match each image with the N that look most like it (0: all pairs, or only --neighbors)
    /// [default: 40, or 0 with --neighbors].
    #[arg(long, value_name = "N", help_heading = "Matches")]
    pub(super) similar: Option<usize>,
    #[command(flatten)]
    pub(super) robust: RobustArguments,
    #[command(flatten)]
    pub(super) growth: GrowthArguments,
    #[command(flatten)]
    pub(super) positions: PositionArguments,
}

impl Arguments {
    /// Returns the options of features and matches.
    pub(super) fn photo_options(&self, options: &SfmOptions) -> PhotoOptions {
        let mut photo_options = PhotoOptions::default()
            .with_features(self.features.options())
            .with_matching(self.matching.options())
            .with_neighbors(self.neighbors)
            .with_best_first(options.ransac.sampler == SamplerKind::Prosac);
        photo_options.similar = self.similar;
        photo_options
    }
}
