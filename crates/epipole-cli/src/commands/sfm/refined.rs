//! Refined lens parameters of `epipole sfm` and `epipole odometry`.

use crate::context::Context;
use clap::Args;
use epipole::camera::{Camera, LensKind};
use epipole::sfm::SfmOptions;

/// Refined lens parameters.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Reconstruction")]
pub(crate) struct RefinedArguments {
    /// Refine the focal length (one factor per lens, even if it is known).
    #[arg(long)]
    refine_focal: bool,
    /// Keep focal lengths and distortion, even if they are guesses.
    #[arg(long, conflicts_with = "refine_focal")]
    keep_focal: bool,
    /// Refine the principal points, one shift per lens.
    #[arg(long)]
    refine_principal_point: bool,
    /// Refine the radial distortion of each lens (two terms; rational six, fisheye four, division
    /// one).
    #[arg(long)]
    refine_distortion: bool,
    /// Refine the tangential distortion of each lens (two terms; fisheye and division have none).
    #[arg(long)]
    refine_tangential: bool,
}

impl RefinedArguments {
    /// Returns whether any refinement is requested.
    pub(crate) fn is_set(&self) -> bool {
        self.refine_focal
            || self.refine_principal_point
            || self.refine_distortion
            || self.refine_tangential
    }

    /// Warns of a requested refinement that has no effect.
    pub(crate) fn warn_of_nothing_to_refine(&self, cameras: &[Camera], context: &Context) {
        let has_tangential =
            |camera: &Camera| matches!(camera.lens.kind(), LensKind::Brown | LensKind::Rational);
        if self.refine_tangential && !cameras.iter().any(has_tangential) {
            context.warn(
                "--refine-tangential makes no difference here: the model of the lens has no tangential terms",
            );
        }
    }

    /// Returns whether lenses are corrected at the end.
    ///
    /// * `all_unknown`: whether nothing is known of any lens
    pub(crate) fn corrects_lenses(&self, all_unknown: bool) -> bool {
        all_unknown && !self.keep_focal && !self.refine_distortion
    }

    /// Adds the refinement to the other options of a reconstruction.
    ///
    /// * `some_unknown`: whether some focal length is a guess
    pub(crate) fn options(&self, accepted: SfmOptions, some_unknown: bool) -> SfmOptions {
        accepted
            .with_refine_focal(self.refine_focal || some_unknown && !self.keep_focal)
            .with_refine_principal_point(self.refine_principal_point)
            .with_refine_distortion(self.refine_distortion)
            .with_refine_tangential(self.refine_tangential)
    }
}
