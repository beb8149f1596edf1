//! Command-line options of `epipole pnp`.

use crate::failure::Failure;
use crate::lens;
use crate::matrices::{intrinsics, pixel, positive, size};
use crate::robust::{PHOTO_MAX_ERROR, RobustArguments};
use clap::{ArgGroup, Args};
use epipole::camera::{Camera, Intrinsics};
use nalgebra::Point2;
use std::path::PathBuf;

const EXAMPLE: &str = "Example: epipole pnp points.txt --k 800,800,320,240";

/// Find the pose of a camera from known points and their pixels.
#[derive(Debug, Args)]
#[command(
    override_usage = "epipole pnp [OPTIONS] <POINTS>",
    group(ArgGroup::new("view").args(["k", "camera", "focal_px"]).required(true)),
    mut_arg("max_error_px", |argument| argument.default_value(PHOTO_MAX_ERROR)),
    after_help = EXAMPLE,
    after_long_help = "Example: epipole pnp points.txt --k 800,800,320,240\n\n\
    A file of points has one point per line, x y z u v: a point of the world, in any unit, and its pixel. A header\n\
    with these names allows any order; a first line of four numbers is skipped; # begins a comment. Numbers are\n\
    separated by commas, semicolons, tabs or spaces; decimal commas work only with semicolons or tabs.\n\n\
    With --focal-px unknown, four points are enough, also on a plane that does not face the camera. Up to five\n\
    points with a known camera, or four with an unknown focal length, are all assumed to be inliers.\n\n\
    Small or distant planes have two poses that fit equally well; the second is among the alternatives.\n\n\
    The JSON is a camera file with a pose, which epipole triangulate reads: image, k and distortion as in those\n\
    of epipole calibrate, cam_from_world (rotation and translation, in the unit of the points). It also has\n\
    center (of the camera, in the world), inliers (1 or 0 for each row), num_inliers, mean_error_px (of the\n\
    inliers), max_error_px (as given, or as found by auto), focal_px (if it was unknown, else null), focal_std_px\n\
    (its standard deviation, or null), alternatives (other poses that fit equally well: cam_from_world, center,\n\
    mean_error_px, focal_px each)."
)]
pub(crate) struct Arguments {
    /// Text file with x y z u v per line; - for standard input.
    pub(super) points: PathBuf,
    /// Focal lengths and principal point in pixels.
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k: Option<Intrinsics>,
    /// Camera file (FILE#NAME: one of several) of `epipole calibrate`, OpenCV, COLMAP and others.
    #[arg(long, value_name = "FILE")]
    camera: Option<PathBuf>,
    /// Focal length in pixels, or "unknown". The principal point is that of --center or --size.
    #[arg(long, value_name = "F|unknown", value_parser = focal)]
    focal_px: Option<Focal>,
    /// Size of the image. Its center is the principal point unless --k or --center gives it.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, conflicts_with = "camera")]
    size: Option<(u32, u32)>,
    /// Principal point in pixels.
    #[arg(long, value_name = "cx,cy", value_parser = pixel, allow_hyphen_values = true, conflicts_with_all = ["k", "camera"])]
    center: Option<Point2<f64>>,
    #[command(flatten)]
    pub(super) robust: RobustArguments,
}

/// A focal length on the command line.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Focal {
    Pixels(f64),
    Unknown,
}

fn focal(text: &str) -> Result<Focal, String> {
    match text {
        "unknown" => Ok(Focal::Unknown),
        _ => match positive(text) {
            Ok(focal_px) => Ok(Focal::Pixels(focal_px)),
            Err(why) => Err(format!("{why}, nor \"unknown\"")),
        },
    }
}

/// Known part of the camera.
pub(super) enum View {
    Camera(Camera),
    /// A camera without distortion, of known principal point and unknown focal length.
    WithoutFocal(Camera),
}

impl View {
    /// Returns the camera; if its focal length is unknown, with an arbitrary one.
    pub(super) fn camera(&self) -> &Camera {
        match self {
            Self::Camera(camera) | Self::WithoutFocal(camera) => camera,
        }
    }
}

impl Arguments {
    /// Returns the known part of the camera.
    ///
    /// # Errors
    /// For a file that cannot be read, and for a missing principal point.
    pub(super) fn view(&self) -> Result<View, Failure> {
        if let Some(file) = &self.camera {
            return lens::read(file, None).map(View::Camera);
        }
        let pinhole = |k: Intrinsics| {
            // The default size is that of an image centered at the principal point.
            let side = |middle: f64| (2.0 * middle + 1.0).round().max(1.0) as u32;
            let center = k.principal_point();
            let (width, height) = self.size.unwrap_or((side(center.x), side(center.y)));
            Camera::pinhole(k, width, height)
        };
        if let Some(k) = self.k {
            return Ok(View::Camera(pinhole(k)));
        }
        let middle = |(width, height)| {
            let middle = |side: u32| 0.5 * (f64::from(side) - 1.0);
            Point2::new(middle(width), middle(height))
        };
        let center = self.center.or(self.size.map(middle)).ok_or_else(|| {
            Failure::usage(
                "--focal-px needs the principal point: --size WIDTHxHEIGHT of the image, whose middle it is, or --center cx,cy",
            )
        })?;
        match self.focal_px {
            Some(Focal::Pixels(f)) => Ok(View::Camera(pinhole(Intrinsics::new(
                f, f, center.x, center.y,
            )?))),
            _ => {
                let any = center.coords.amax().max(1.0);
                let k = Intrinsics::new(any, any, center.x, center.y)?;
                Ok(View::WithoutFocal(pinhole(k)))
            }
        }
    }
}
