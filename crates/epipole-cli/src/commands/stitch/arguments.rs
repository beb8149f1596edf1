//! Command-line options of `epipole stitch`.

use crate::camera::CameraArguments;
use crate::features::{FeatureArguments, MatchArguments};
use crate::listing::ListingArguments;
use crate::matrices::positive;
use crate::reading::SizeArguments;
use clap::{Args, ValueEnum};
use epipole::stitch::{Blend, RenderOptions, Surface};
use std::path::PathBuf;

/// Model that the photos share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Model {
    /// One viewpoint: the camera only rotates.
    Rotation,
    /// A plane, such as a wall or a page; the camera may move.
    Homography,
}

/// Projection of a panorama.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Projection {
    /// Lines stay straight; up to 120°.
    Plane,
    /// Verticals stay straight; all around.
    Cylinder,
    /// All around, up and down.
    Sphere,
}

/// Blending where photos overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Blending {
    /// Coarse and fine details separately (multi-band).
    Bands,
    /// Average weighted by distance to the border.
    Feather,
    /// None.
    Seams,
}

const EXAMPLE: &str = "Example: epipole stitch left.jpg middle.jpg right.jpg -o panorama.jpg";

/// Stitch photos from one viewpoint, or of one plane.
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLE,
    after_long_help = "Example: epipole stitch left.jpg middle.jpg right.jpg -o panorama.jpg\n\n\
    All photos share one focal length, that of --k, --focal-px or --camera, or else one estimated from the\n\
    matches. Photos that overlap no other are left out. Where the camera moved between two photos, near objects\n\
    do not fit.\n\n\
    JSON: width, height, focal_px (of the panorama; null with --model homography), files, num_stitched,\n\
    mean_error_px (of the matches that agree), photos (name; rotation: from the frame of the panorama (y down, z\n\
    forward) to the camera, 9 numbers row by row, null with --model homography; pixel_from_direction: from a\n\
    direction of the panorama to a pixel, 9 numbers; both null for photos left out), overlaps (names,\n\
    num_matches, num_inliers, mean_error_px, parallax: whether the camera moved)."
)]
pub(crate) struct Arguments {
    /// Photos, or folders of them.
    #[arg(required = true, value_name = "PHOTO")]
    pub(super) photos: Vec<PathBuf>,
    /// Output file, .png or .jpg.
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Model that the photos share.
    #[arg(long, value_enum, default_value = "rotation")]
    pub(super) model: Model,
    /// Projection [default: cylinder, or plane with --model homography].
    #[arg(long, value_enum)]
    projection: Option<Projection>,
    /// Blending where photos overlap.
    #[arg(long, value_enum, default_value = "bands", help_heading = "Panorama")]
    blend: Blending,
    /// Keep the exposures of the photos.
    #[arg(long, help_heading = "Panorama")]
    keep_exposures: bool,
    /// Downscale the panorama to at most M megapixels.
    #[arg(long, value_name = "M", value_parser = positive, default_value_t = 100.0, help_heading = "Panorama")]
    max_output_megapixels: f64,
    #[command(flatten)]
    pub(super) camera: CameraArguments,
    /// Camera file of the photos (FILE#NAME: one of several). Their distortion is removed.
    #[arg(long = "camera", value_name = "FILE", conflicts_with_all = ["k", "focal_px"])]
    pub(super) camera_file: Option<PathBuf>,
    #[command(flatten)]
    pub(super) listing: ListingArguments,
    #[command(flatten)]
    pub(super) features: FeatureArguments,
    #[command(flatten)]
    pub(super) matching: MatchArguments,
    #[command(flatten)]
    pub(super) size: SizeArguments,
}

impl Arguments {
    /// Returns whether the projection is not a plane.
    pub(super) fn is_bent(&self) -> bool {
        !matches!(self.projection, None | Some(Projection::Plane))
    }

    /// Returns the options of the core.
    pub(super) fn render_options(&self) -> RenderOptions {
        let surface = match (self.projection, self.model) {
            (Some(Projection::Plane), _) | (None, Model::Homography) => Surface::Plane,
            (Some(Projection::Cylinder), _) | (None, Model::Rotation) => Surface::Cylinder,
            (Some(Projection::Sphere), _) => Surface::Sphere,
        };
        RenderOptions::default()
            .with_surface(surface)
            .with_blend(match self.blend {
                Blending::Bands => Blend::Bands,
                Blending::Feather => Blend::Feather,
                Blending::Seams => Blend::Seams,
            })
            .with_gains(!self.keep_exposures)
            .with_max_pixels((1e6 * self.max_output_megapixels).max(1.0) as u64)
    }
}
