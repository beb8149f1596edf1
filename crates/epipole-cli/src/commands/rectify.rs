//! `epipole rectify`: two images transformed so that matches share a row.

mod rig;

use crate::camera::PairArguments;
use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, MatchArguments, matched_pixels};
use crate::known_camera::{CameraFile, known_cameras, warn_of_unseen};
use crate::matrices::{fraction, positive, row_major, size};
use crate::photo::{Photo, check_same_size};
use crate::reading::ReadArguments;
use crate::report::Report;
use crate::robust::RobustArguments;
use crate::rotation_only::{self, find_rotation_only, left_open};
use crate::{files, interrupt, picture};
use clap::Args;
use epipole::camera::{Camera, RigidTransform};
use epipole::epipolar::{FundamentalEstimator, estimate_relative_pose};
use epipole::robust::MatchSet;
use epipole::stereo::{PixelMap, RectifyOptions, rectify_calibrated, rectify_uncalibrated};
use nalgebra::{Matrix3, Matrix4, Point2, Translation3, UnitQuaternion};
use std::path::PathBuf;

/// Rectify two images, with or without known cameras.
#[derive(Debug, Args)]
#[command(
    mut_arg("camera_file", |argument| argument.conflicts_with_all(["k", "k2", "focal_px"])),
    mut_arg("baseline_m", |argument| argument.conflicts_with("rig")),
    after_help = "Example: epipole rectify left.jpg right.jpg --focal-px 1200 -o rectified\n\n\
    Writes left.png and right.png. Without --rig, --camera, --k or --focal-px the shapes are known only up\n\
    to a projective map, and there is no Q. With --rig the images are not matched:\n  \
    epipole calibrate left*.jpg --board 9x6 --square-m 0.025 --right right*.jpg -o rig.json\n  \
    epipole rectify left.jpg right.jpg --rig rig.json -o rectified\n\n\
    JSON: homography1 and homography2 (9 numbers row by row), q (16 numbers row by row, or null),\n\
    num_inliers (matches that agree; null with --rig), is_vertical (whether columns agree instead of\n\
    rows), files (those written)."
)]
pub(crate) struct Arguments {
    /// Left image.
    first: PathBuf,
    /// Right image, of the same size.
    second: PathBuf,
    #[command(flatten)]
    camera: PairArguments,
    #[command(flatten)]
    known: CameraFile,
    /// Stereo rig file (of `epipole calibrate --right`, OpenCV, Kalibr or MATLAB), for images of
    /// its left and right camera.
    #[arg(long, value_name = "FILE", help_heading = "Images", conflicts_with_all = ["camera_file", "k", "k2", "focal_px"])]
    rig: Option<PathBuf>,
    /// Distance between the cameras; the unit of Q. That of --rig is in meters.
    #[arg(long, default_value_t = 1.0, value_name = "B", value_parser = positive)]
    baseline_m: f64,
    /// Zoom from 0 (every pixel of the results is valid) to 1 (every pixel of the images is
    /// visible).
    #[arg(long, default_value_t = RectifyOptions::default().alpha, value_name = "RATIO", value_parser = fraction)]
    alpha: f64,
    /// Size of the results [default: that of the images]. Like --alpha, it needs known intrinsics.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Center each image separately, so that the disparity of infinity need not be 0.
    #[arg(long)]
    free_infinity: bool,
    /// Output folder.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    matching: MatchArguments,
    #[command(flatten)]
    robust: RobustArguments,
    #[command(flatten)]
    reading: ReadArguments,
}

/// Rectification from any source.
struct Found {
    homographies: [Matrix3<f64>; 2],
    maps: [PixelMap; 2],
    q: Option<Matrix4<f64>>,
    /// `None` without matching.
    num_inliers: Option<usize>,
    /// Whether matches share a column instead of a row.
    is_vertical: bool,
}

impl Arguments {
    /// Returns the options of the rectification.
    fn shape(&self) -> RectifyOptions {
        RectifyOptions::default()
            .with_alpha(self.alpha)
            .with_size(self.size)
            .with_zero_disparity_at_infinity(!self.free_infinity)
    }
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    arguments.camera.check()?;
    let shaped = arguments.alpha != 0.0 || arguments.size.is_some() || arguments.free_infinity;
    let is_known = arguments.camera.is_set() || arguments.known.is_set();
    if shaped && !is_known && arguments.rig.is_none() {
        return Err(Failure::usage(
            "--alpha, --size and --free-infinity need known intrinsics: give --rig, --camera, --k or --focal-px",
        ));
    }
    let (photos, found, num_matches) = match &arguments.rig {
        Some(file) => {
            let paths = [&*arguments.first, &*arguments.second];
            let (photos, cameras, right_from_left) =
                rig::read(file, paths, arguments.reading, context)?;
            let found = rectify_known_pair(arguments, &cameras, &right_from_left, None, context)?;
            (photos, found, None)
        }
        None => by_matches(arguments, context)?,
    };

    files::make_folder(&arguments.output)?;
    let mut written = Vec::new();
    for ((name, photo), map) in ["left.png", "right.png"]
        .iter()
        .zip(&photos)
        .zip(&found.maps)
    {
        let path = arguments.output.join(name);
        let warped = map.warp(&photo.color, &mut interrupt::watch)?;
        files::write(&path, &picture::png(&warped)?)?;
        written.push(path.display().to_string());
    }
    let q = found.q.map(|q| q.transpose().as_slice().to_vec());
    let mut report = Report::default();
    if let (Some(num_inliers), Some(num_matches)) = (found.num_inliers, num_matches) {
        report = report.row(
            "matches that agree",
            format!("{num_inliers} of {num_matches}"),
        );
    }
    Ok(report
        .row("written", written.join(", "))
        .field("homography1", row_major(&found.homographies[0]))
        .field("homography2", row_major(&found.homographies[1]))
        .field("q", q)
        .field("num_inliers", found.num_inliers)
        .field("is_vertical", found.is_vertical)
        .field("files", written))
}

/// Rectifies two photos by their matches. Returns the photos, the rectification and the number of
/// matches.
fn by_matches(
    arguments: &Arguments,
    context: &Context,
) -> Result<([Photo; 2], Found, Option<usize>), Failure> {
    let paths = [&*arguments.first, &*arguments.second];
    let photos = (arguments.known).read(paths, arguments.reading.into(), context)?;
    check_same_size(&photos)?;
    let found1 = arguments.features.detect(&photos[0], context)?;
    let found2 = arguments.features.detect(&photos[1], context)?;
    let matches = arguments.matching.run_best_first(&found1, &found2)?;
    let [pixels1, pixels2] = matched_pixels(&matches, &found1, &found2);
    let found = rectify(arguments, context, &photos, &pixels1, &pixels2)?;
    Ok((photos, found, Some(matches.len())))
}

fn rectify(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Found, Failure> {
    let (width, height) = photos[0].color.dimensions();
    let cameras = if arguments.known.is_set() {
        let cameras = known_cameras(&arguments.camera, context, photos)?;
        warn_of_unseen(cameras.each_ref(), [pixels1, pixels2], context);
        Some(cameras)
    } else {
        let explicit = arguments.camera.explicit(photos)?;
        explicit.map(|[k1, k2]| [photos[0].camera(k1), photos[1].camera(k2)])
    };
    if let Some(cameras) = cameras {
        let both = cameras.each_ref();
        let report = arguments.robust.watched(context, |options, monitor| {
            estimate_relative_pose(pixels1, pixels2, both, options, monitor)
        })?;
        let ransac = (arguments.robust.options(context)).within(report.max_error_px);
        if let Some(rotation_only) =
            find_rotation_only(pixels1, pixels2, both, &report.inliers, &ransac)?
        {
            context.warn(&rotation_only::sentence(&rotation_only));
        }
        let rotation = UnitQuaternion::from_matrix(&report.model.rotation);
        let translation = Translation3::from(report.model.direction * arguments.baseline_m);
        let cam2_from_cam1 = RigidTransform::from_parts(translation, rotation);
        return rectify_known_pair(
            arguments,
            &cameras,
            &cam2_from_cam1,
            Some(report.num_inliers),
            context,
        );
    }
    let estimator = FundamentalEstimator::new(MatchSet::new(pixels1, pixels2)?)?;
    let report = arguments.robust.run(estimator, context)?;
    let ransac = (arguments.robust.options(context)).within(report.max_error_px);
    if let Some(open) = left_open(pixels1, pixels2, &report.inliers, &ransac)? {
        context.warn(&open);
    }
    let inliers = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        let selected = pixels
            .iter()
            .zip(&report.inliers)
            .filter(|(_, is_inlier)| **is_inlier);
        selected.map(|(pixel, _)| *pixel).collect()
    };
    let rectification = rectify_uncalibrated(
        &report.model,
        &inliers(pixels1),
        &inliers(pixels2),
        width,
        height,
    )?;
    let map = |h: &Matrix3<f64>| PixelMap::from_homography(width, height, h, &mut interrupt::watch);
    Ok(Found {
        maps: [
            map(&rectification.homographies[0])?,
            map(&rectification.homographies[1])?,
        ],
        homographies: rectification.homographies,
        q: None,
        num_inliers: Some(report.num_inliers),
        is_vertical: false,
    })
}

/// Rectifies two known cameras.
fn rectify_known_pair(
    arguments: &Arguments,
    cameras: &[Camera; 2],
    cam2_from_cam1: &RigidTransform,
    num_inliers: Option<usize>,
    context: &Context,
) -> Result<Found, Failure> {
    let rectification = rectify_calibrated(cameras, cam2_from_cam1, &arguments.shape())?;
    if rectification.is_vertical {
        context.warn(
            "columns agree, not rows: the second photo was taken above or below the first; epipole stereo \
             searches along rows, so turn both photos by 90° and rectify them again",
        );
    }
    Ok(Found {
        is_vertical: rectification.is_vertical,
        homographies: rectification.homographies,
        maps: [
            rectification.map(0, &mut interrupt::watch)?,
            rectification.map(1, &mut interrupt::watch)?,
        ],
        q: Some(rectification.q),
        num_inliers,
    })
}
