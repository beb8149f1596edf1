//! Options of incremental reconstruction.

use super::refined::RefinedArguments;
use crate::context::Context;
use crate::matrices::positive;
use crate::photo::RetainedLens;
use crate::robust::RobustArguments;
use clap::{Args, ValueEnum};
use epipole::camera::Camera;
use epipole::sfm::{Photo, SfmOptions};

/// Photos that share a lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Lenses {
    One,
    Alike,
    Each,
}

/// Acceptance thresholds of images and points; also of `epipole odometry`, with other defaults.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Reconstruction")]
pub(crate) struct AcceptArguments {
    /// Minimum number of images that see a point.
    #[arg(long, default_value_t = SfmOptions::default().min_track_length, value_name = "N")]
    min_track_length: usize,
    /// Minimum number of matches that connect two images, and of points that register one.
    #[arg(long, default_value_t = SfmOptions::default().min_num_inliers, value_name = "N")]
    min_inliers: usize,
    /// Minimum triangulation angle of a point, degrees.
    #[arg(long, default_value_t = SfmOptions::default().min_angle_deg, value_name = "DEG", value_parser = positive)]
    min_angle_deg: f64,
    /// Minimum median triangulation angle of the two first images, degrees; lowered if no pair has
    /// it.
    #[arg(long, default_value_t = SfmOptions::default().min_start_angle_deg, value_name = "DEG", value_parser = positive)]
    min_start_angle_deg: f64,
    /// Maximum reprojection error of a point when an image is registered, pixels.
    #[arg(long, default_value_t = SfmOptions::default().max_registration_error_px, value_name = "PX", value_parser = positive)]
    max_registration_error_px: f64,
    /// Maximum reprojection error of an observation, pixels.
    #[arg(long, default_value_t = SfmOptions::default().max_reprojection_error_px, value_name = "PX", value_parser = positive)]
    max_reprojection_error_px: f64,
}

impl AcceptArguments {
    /// Returns the options of the core, without refinement of lenses.
    pub(crate) fn options(&self, robust: &RobustArguments, context: &Context) -> SfmOptions {
        SfmOptions::default()
            .with_ransac(robust.options(context))
            .with_max_registration_error_px(self.max_registration_error_px)
            .with_max_reprojection_error_px(self.max_reprojection_error_px)
            .with_min_num_inliers(self.min_inliers)
            .with_min_angle_deg(self.min_angle_deg)
            .with_min_start_angle_deg(self.min_start_angle_deg)
            .with_min_track_length(self.min_track_length)
            .with_seed(context.seed)
    }
}

/// Refined parameters and acceptance thresholds.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Reconstruction")]
pub(super) struct GrowthArguments {
    /// Images that share a lens, and with it the refined parameters: all ("one"), those of equal
    /// size and focal length ("alike"), or none ("each"). Images of --camera share no lens with
    /// others, nor with images of another rotation.
    #[arg(long, value_enum, default_value_t = Lenses::One, value_name = "WHICH")]
    lenses: Lenses,
    #[command(flatten)]
    pub(super) refined: RefinedArguments,
    #[command(flatten)]
    accept: AcceptArguments,
}

impl GrowthArguments {
    /// Gives equal numbers to photos that share a lens.
    ///
    /// * `cameras`, `retained`: per photo
    pub(super) fn number_lenses(
        &self,
        photos: &mut [Photo],
        cameras: &[Camera],
        retained: &[Option<RetainedLens>],
    ) {
        let mut kinds = Vec::new();
        for (index, (photo, (camera, retained))) in
            (photos.iter_mut().zip(cameras.iter().zip(retained))).enumerate()
        {
            let alike = match self.lenses {
                Lenses::One => None,
                Lenses::Each => Some((index, None)),
                Lenses::Alike => Some((0, Some(*camera))),
            };
            let kind = (alike, *retained);
            let place = kinds.iter().position(|known| *known == kind);
            photo.lens = place.unwrap_or_else(|| {
                kinds.push(kind);
                kinds.len() - 1
            });
        }
    }

    /// Returns the options of the core.
    ///
    /// * `some_unknown`: whether some focal length is a guess
    pub(super) fn options(
        &self,
        robust: &RobustArguments,
        context: &Context,
        some_unknown: bool,
    ) -> SfmOptions {
        let accepted = self.accept.options(robust, context);
        self.refined.options(accepted, some_unknown)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::robust::PHOTO_MAX_ERROR;
    use clap::Parser;
    use epipole::camera::{Fisheye, Intrinsics, Lens};

    #[derive(Debug, Parser)]
    #[command(mut_arg("max_error_px", |argument| argument.default_value(PHOTO_MAX_ERROR)))]
    struct All {
        #[command(flatten)]
        robust: RobustArguments,
        #[command(flatten)]
        growth: GrowthArguments,
    }

    fn options(words: &[&str], some_unknown: bool) -> SfmOptions {
        let all = All::try_parse_from([&["epipole"], words].concat()).unwrap();
        let context = Context {
            quiet: true,
            seed: 0,
        };
        (all.growth).options(&all.robust, &context, some_unknown)
    }

    #[test]
    fn omitted_options_have_the_defaults_of_the_core() {
        assert_eq!(options(&[], false), SfmOptions::default());
        let words = [
            "--min-inliers",
            "30",
            "--max-error-px",
            "0.5",
            "--confidence",
            "0.9",
        ];
        let parsed = options(&words, false);
        assert_eq!(
            (parsed.min_num_inliers, parsed.ransac.max_error_px),
            (30, 0.5)
        );
        assert_eq!(parsed.ransac.confidence, 0.9);
    }

    #[test]
    fn photos_that_cannot_share_a_lens_have_their_own() {
        let fisheye = RetainedLens {
            lens: Lens::Fisheye(Fisheye::default()),
            quarters: 0,
        };
        let rotated = RetainedLens {
            quarters: 1,
            ..fisheye
        };
        let retained = [None, Some(fisheye), Some(fisheye), Some(rotated), None];
        let camera =
            |focal_px| Camera::pinhole(Intrinsics::centered(focal_px, 640, 480).unwrap(), 640, 480);
        let cameras = [500.0, 500.0, 600.0, 600.0, 500.0].map(camera);
        for (words, numbers) in [
            ("one", [0, 1, 1, 2, 0]),
            ("alike", [0, 1, 2, 3, 0]),
            ("each", [0, 1, 2, 3, 4]),
        ] {
            let all = All::try_parse_from(["epipole", "--lenses", words]).unwrap();
            let mut photos = vec![Photo::default(); 5];
            (all.growth).number_lenses(&mut photos, &cameras, &retained);
            let lens_numbers: Vec<usize> = photos.iter().map(|photo| photo.lens).collect();
            assert_eq!(lens_numbers, numbers, "{words}");
        }
    }

    #[test]
    fn guessed_focal_lengths_are_refined_unless_fixed() {
        assert!(options(&[], true).refine_focal);
        assert!(!options(&["--keep-focal"], true).refine_focal);
        assert!(options(&["--refine-focal"], false).refine_focal);
    }
}
