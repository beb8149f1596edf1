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
        "The largest error of a match of two photographs, pixels: Sampson error of E; \"auto\" finds it \
         for each pair from the noise of its matches"
    ).default_value(PHOTO_MAX_ERROR)),
    after_help = "Example: epipole sfm photos/ --focal-px 2400 -o reconstruction\n\n\
    Writes cameras.txt, images.txt and points3D.txt (COLMAP's text model) and points.ply, with --images also the\n\
    photographs, in images/. If names have blanks, where COLMAP cuts them in text, its binary model is added. Files\n\
    of an earlier run in OUT are removed, others stay.\n\n\
    cameras.txt has PINHOLE cameras, or OPENCV, FULL_OPENCV, OPENCV_FISHEYE or DIVISION, as the lens is: that of\n\
    --camera, or one whose distortion was refined. Give --undistort for programs that know PINHOLE alone.\n\n\
    Where a photograph's EXIF data do not tell its focal length, 1.2 times the longer side is where to\n\
    begin, and one factor for all focal lengths is refined. Where nothing is given of the cameras, focal length\n\
    and radial distortion are refined at the end, if five photographs or more show that this lowers the error by 5%.\n\n\
    With --poses cameras and poses come from a model of COLMAP, Bundler, nerfstudio or openMVG, and points from the\n\
    matches that fit; photographs that it does not have are left out.\n\n\
    JSON: num_registered, num_images, num_points, mean_reprojection_px, images (name, focal_px, lens: brown,\n\
    rational, fisheye or division, distortion: its coefficients as in the file of a camera, of a usual lens k1,\n\
    k2, p1, p2 and k3, cam_from_world with rotation and translation), all of the largest\n\
    component; focal_refined (whether the focal lengths were), focal_determined (whether the photographs tell them;\n\
    null if they were not refined), lens_refined (whether the radial distortion was, too), with --positions placed (whether it stands where they\n\
    say, in meters), position_rms_m, origin (where zero is, if positions are degrees), unregistered (name and reason of each photograph that is not in the largest\n\
    component), components (num_registered and num_points of each), complete (false after Ctrl-C)."
)]
pub(crate) struct Arguments {
    /// The folder for the result.
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
    /// Match each photograph with so many after it, for frames in order of time; 0 for all.
    #[arg(long, default_value_t = 0, value_name = "N", help_heading = "Matches")]
    pub(super) neighbors: usize,
    #[command(flatten)]
    pub(super) robust: RobustArguments,
    #[command(flatten)]
    pub(super) growth: GrowthArguments,
    #[command(flatten)]
    pub(super) positions: PositionArguments,
}

impl Arguments {
    /// Options of features and matches.
    pub(super) fn photo_options(&self, options: &SfmOptions) -> PhotoOptions {
        PhotoOptions::default()
            .with_features(self.features.options())
            .with_matching(self.matching.options())
            .with_neighbors(self.neighbors)
            .with_best_first(options.ransac.sampler == SamplerKind::Prosac)
    }
}
