//! `epipole odometry`: the path of a camera, or of a stereo rig, from its frames.

use super::sfm::growth::AcceptArguments;
use super::sfm::refined::RefinedArguments;
use crate::camera::{CameraArguments, Guess, sentence, some_unknown};
use crate::context::Context;
use crate::failure::Failure;
use crate::features::{FeatureArguments, MatchArguments};
use crate::interrupt;
use crate::known_camera::check_visible_part;
use crate::lens;
use crate::listing::{Listed, ListingArguments};
use crate::matrices::{Motion, positive};
use crate::photo::{Photo, RetainedLens};
use crate::progress::Progress;
use crate::reading::SizeArguments;
use crate::report::Report;
use crate::robust::RobustArguments;
use clap::{ArgAction, Args};
use epipole::camera::{Camera, RigidTransform};
use epipole::progress::Part;
use epipole::robust::SamplerKind;
use epipole::sfm::{
    Odometry, OdometryOptions, OdometryResult, Photo as SfmPhoto, PhotoFeatures, PhotoOptions,
    SfmImage, SfmInput, match_features, match_rectified, photo_features,
};
use epipole_io::trajectory::{Trajectory, TrajectoryFormat, frame_stamps_ns, write_trajectory};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Track a camera or a stereo rig through its frames.
#[derive(Debug, Args)]
#[command(
    mut_arg("max_features", |argument| argument.default_value(MAX_FEATURES)),
    mut_arg("max_error_px", |argument| argument.help(
        "Maximum error of a match of two frames (pixels, Sampson error of E; \"auto\" finds it for each pair from \
         the noise of its matches)"
    ).default_value("1.5")),
    mut_arg("max_registration_error_px", |argument| argument.default_value("3")),
    mut_arg("max_reprojection_error_px", |argument| argument.default_value("2")),
    mut_arg("min_angle_deg", |argument| argument.default_value("0.3")),
    mut_arg("min_start_angle_deg", |argument| argument.default_value("1")),
    after_help = "Example: epipole odometry frames/ --k 718.9,718.9,607.2,185.2\n\n\
    Frames are sorted by name, numbers by value. The path of a single camera has no unit of length; that of a\n\
    rectified stereo rig has the unit of its baseline:\n  \
    epipole odometry left/ --right right/ --stereo-baseline-m 0.54 --k 718.9,718.9,607.2,185.2\n\n\
    A guessed focal length is refined at the end, from all frames together.\n\n\
    The trajectory has the frames that were placed. Their times are their names if these are numbers (seconds or\n\
    nanoseconds), or else their indices from 0. epipole compare and convert read it.\n\n\
    JSON: frames (name and world_from_cam with rotation and translation, or null), keyframes and lost (indices\n\
    into that list), focal_px, focal_refined (whether it was), lens and distortion (as in the output of sfm), of\n\
    the left camera, complete (false after Ctrl-C)."
)]
pub(crate) struct Arguments {
    /// Folder of the frames (of the left camera of a stereo rig).
    #[arg(value_name = "FOLDER")]
    frames: PathBuf,
    /// Write the trajectory: EuRoC if the name ends in .csv, else TUM; -: TUM on standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    camera: CameraArguments,
    /// Camera file (FILE#NAME: one of several) of `epipole calibrate`, OpenCV, ROS, Kalibr, KITTI,
    /// ORB-SLAM, COLMAP, nerfstudio, Metashape or MATLAB, for frames of its size. Frames stay
    /// distorted. Not for rigs, whose frames are rectified.
    #[arg(long = "camera", value_name = "FILE", conflicts_with_all = ["k", "right"])]
    camera_file: Option<PathBuf>,
    /// Folder of the right camera's frames (rectified, one per left frame, in the same order).
    #[arg(long, value_name = "FOLDER", requires = "stereo_baseline_m")]
    right: Option<PathBuf>,
    /// Distance between the cameras, meters.
    #[arg(long, value_name = "B", value_parser = positive, requires = "right")]
    stereo_baseline_m: Option<f64>,
    #[command(flatten)]
    features: FeatureArguments,
    #[command(flatten)]
    matching: MatchArguments,
    /// Number of following frames to match each frame with, so that a bad pair breaks no track (0:
    /// those that look alike).
    #[arg(long, default_value_t = 4, value_name = "N", help_heading = "Matches")]
    neighbors: usize,
    #[command(flatten)]
    robust: RobustArguments,
    #[command(flatten)]
    accept: AcceptArguments,
    #[command(flatten)]
    refined: RefinedArguments,
    /// Keyframes refined together; older ones stay fixed.
    #[arg(long, default_value_t = OdometryOptions::default().window, value_name = "N", help_heading = "Reconstruction")]
    window: usize,
    /// Refine everything at the end, including the lens parameters to refine;
    /// --final-adjustment=false to keep the path as tracked.
    #[arg(long, action = ArgAction::Set, num_args = 0..=1, require_equals = true, default_value_t = true, default_missing_value = "true", help_heading = "Reconstruction")]
    final_adjustment: bool,
    #[command(flatten)]
    listing: ListingArguments,
    #[command(flatten)]
    size: SizeArguments,
}

impl Arguments {
    /// Returns the options of odometry.
    ///
    /// * `some_unknown`: whether the focal length is a guess
    fn options(&self, context: &Context, some_unknown: bool) -> OdometryOptions {
        let accepted = self.accept.options(&self.robust, context);
        OdometryOptions::default()
            .with_sfm(self.refined.options(accepted, some_unknown))
            .with_window(self.window)
            .with_final_adjustment(self.final_adjustment)
    }
}

/// Default maximum number of features, lower than for photos because frames are many and similar.
const MAX_FEATURES: &str = "3000";

/// Fractions of the work after which features, and then matches, are done.
const DETECTED: f32 = 0.5;
const MATCHED: f32 = 0.7;

/// State shared by all steps.
struct Work<'a> {
    arguments: &'a Arguments,
    context: &'a Context,
    options: PhotoOptions,
    progress: Progress,
}

/// The frames, and the camera that took them.
struct Frames {
    features: Vec<PhotoFeatures>,
    camera: Camera,
    /// The guessed focal length, unless one is given.
    guess: Option<Guess>,
    lens: Option<RetainedLens>,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let folder = |path: &PathBuf| {
        arguments
            .listing
            .photos(std::slice::from_ref(path), context)
    };
    let left_frames = folder(&arguments.frames)?;
    let right_frames = arguments.right.as_ref().map(folder).transpose()?;
    if let Some(right_frames) = &right_frames
        && right_frames.len() != left_frames.len()
    {
        let message = format!(
            "the two cameras must have as many frames, but there are {} of the left one and {} of \
             the right one",
            left_frames.len(),
            right_frames.len()
        );
        return Err(Failure::new("size-mismatch", message));
    }
    let options = PhotoOptions::default()
        .with_features(arguments.features.options())
        .with_matching(arguments.matching.options())
        .with_neighbors(arguments.neighbors)
        .with_best_first(arguments.robust.options(context).sampler == SamplerKind::Prosac);
    let work = Work {
        arguments,
        context,
        options,
        progress: Progress::new(context, "odometry"),
    };
    let mut all = left_frames.clone();
    all.extend(right_frames.unwrap_or_default());
    let mut left = work.read(&all)?;
    let right = left.features.split_off(left_frames.len());
    let options = work.options(&left);
    let begun_with_px = left.camera.intrinsics.fu_px();
    let result = work.follow(left, right, &options)?;
    let Work { progress, .. } = work;
    drop(progress);
    if !result.is_complete {
        context.warn(interrupt::ENDED_EARLY);
    }
    let refined_from = (options.final_adjustment && options.sfm.refine_focal && result.is_complete)
        .then_some(begun_with_px);
    let report = report(
        &result,
        &left_frames,
        arguments.stereo_baseline_m.is_some(),
        refined_from,
    );
    match &arguments.output {
        Some(path) => report.file(path, trajectory(path, &left_frames, &result)?.into_bytes()),
        None => Ok(report),
    }
}

/// Returns the text of the trajectory of the placed frames.
fn trajectory(path: &Path, listed: &[Listed], result: &OdometryResult) -> Result<String, Failure> {
    let names: Vec<&str> = listed.iter().map(|frame| &*frame.name).collect();
    let counted = || (0..).step_by(1_000_000_000).take(names.len()).collect();
    let stamps_ns = frame_stamps_ns(&names).unwrap_or_else(counted);
    let poses = stamps_ns.into_iter().zip(&result.world_from_cam);
    let (stamps_ns, world_from_cam) = poses
        .filter_map(|(stamp_ns, pose)| Some((stamp_ns, (*pose)?)))
        .unzip();
    let placed = Trajectory {
        stamps_ns: Some(stamps_ns),
        world_from_cam,
        ..Trajectory::default()
    };
    let format = match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("csv") => TrajectoryFormat::EuRoC,
        _ => TrajectoryFormat::Tum,
    };
    write_trajectory(format, &placed).map_err(|error| Failure::from(error).about(path))
}

impl Work<'_> {
    /// Returns the options of odometry and of the camera.
    fn options(&self, frames: &Frames) -> OdometryOptions {
        let guesses = frames.guess.as_slice();
        let options = (self.arguments).options(self.context, some_unknown(guesses));
        let refined = &self.arguments.refined;
        refined.warn_of_nothing_to_refine(&[frames.camera], self.context);
        if refined.is_set() && !options.final_adjustment {
            self.context.warn(
                "with --final-adjustment=false no lens parameter is refined: that is done with all frames at the end",
            );
        }
        if let Some(sentence) = sentence(guesses) {
            let is_refined = options.sfm.refine_focal && options.final_adjustment;
            let then = if is_refined { ", to be refined" } else { "" };
            self.context.warn(&format!("{sentence}{then}"));
        }
        options
    }

    /// Reads the features of all frames, one image in memory at a time, and their camera.
    fn read(&self, listed: &[Listed]) -> Result<Frames, Failure> {
        let file = self.arguments.camera_file.as_ref();
        let first = listed.first().map(|one| one.path.as_path());
        let camera = file.map(|file| lens::read(file, first)).transpose()?;
        if let Some(camera) = &camera {
            check_visible_part(camera, self.context)?;
        }
        let mut frames: Option<Frames> = None;
        for (index, Listed { path, name }) in listed.iter().enumerate() {
            let photo = self.photo(path, camera.as_ref())?;
            let (width, height) = photo.color.dimensions();
            if let Some(frames) = &frames {
                let first = frames.camera;
                if (first.width, first.height) != (width, height) {
                    let message = format!(
                        "all frames must have the size of the first, {} × {}, but this one is {width} × \
                         {height}",
                        first.width, first.height
                    );
                    return Err(Failure::new("size-mismatch", message).about(path));
                }
                if frames.lens != photo.lens {
                    let message = "all frames must have the orientation of the first, but this one has another";
                    return Err(Failure::new("size-mismatch", message).about(path));
                }
            }
            let frames = match &mut frames {
                Some(frames) => frames,
                none => {
                    let (intrinsics, guess) = self.arguments.camera.or_guess(&photo)?;
                    none.insert(Frames {
                        features: Vec::new(),
                        camera: photo.camera(intrinsics),
                        guess,
                        lens: photo.lens,
                    })
                }
            };
            let photo = SfmPhoto {
                name: name.clone(),
                image: photo.color,
                ..SfmPhoto::default()
            };
            let fraction = |done: usize| DETECTED * done as f32 / listed.len() as f32;
            let watch = &mut |status| self.progress.show(status);
            let mut part = Part::new(watch, fraction(index), fraction(index + 1));
            (frames.features).push(photo_features(&photo, &self.options, &mut part)?);
        }
        frames.ok_or_else(|| Failure::new("too-few", "a path needs frames"))
    }

    /// Reads a frame and keeps its distortion.
    fn photo(&self, path: &Path, camera: Option<&Camera>) -> Result<Photo, Failure> {
        let size = self.arguments.size;
        let Some(camera) = camera else {
            return Photo::prepared(path, size, None, self.context);
        };
        let photo = Photo::by_camera(path, size, camera, self.context)?;
        if photo.lens.is_none() {
            let message = format!(
                "the camera of --camera was calibrated for {} × {}, but this frame is {} × {}",
                camera.width, camera.height, photo.sensor_size.0, photo.sensor_size.1
            );
            return Err(Failure::new("size-mismatch", message).about(path));
        }
        Ok(photo)
    }

    fn follow(
        &self,
        left: Frames,
        right: Vec<PhotoFeatures>,
        options: &OdometryOptions,
    ) -> Result<OdometryResult, Failure> {
        let (camera, left) = (left.camera, left.features);
        let watch = &mut |status| self.progress.show(status);
        let mut part = Part::new(watch, DETECTED, MATCHED);
        let pairs = match_features(&left, &self.options, &mut part)?;
        let mut left_right = Vec::new();
        for (a, b) in left.iter().zip(&right) {
            let mut part = Part::new(watch, MATCHED, MATCHED);
            let matches = match_rectified(a, b, &self.options, &mut part)?;
            left_right.push(matches);
        }
        // Descriptors are the larger part of the memory.
        let images = |features: Vec<PhotoFeatures>| -> Vec<SfmImage> {
            features.into_iter().map(|f| f.image).collect()
        };
        let input = SfmInput {
            images: images(left),
            cameras: vec![camera],
            pairs,
        };
        let monitor = &mut Part::new(watch, MATCHED, 1.0);
        let mut run = match self.arguments.stereo_baseline_m {
            Some(baseline_m) => Odometry::stereo(
                &input,
                &images(right),
                &left_right,
                &RigidTransform::translation(-baseline_m, 0.0, 0.0),
                &camera,
                options,
                monitor,
            )?,
            None => Odometry::monocular(&input, options, monitor)?,
        };
        loop {
            match run.step(monitor) {
                Ok(Some(_)) => {}
                // Ctrl-C ends the path here.
                Ok(None) | Err(epipole::Error::Canceled) => return Ok(run.finish()),
                Err(error) => return Err(error.into()),
            }
        }
    }
}

/// * `metric`: whether the path has a unit of length
/// * `refined_from_px`: the focal length before refinement, if it was refined
fn report(
    result: &OdometryResult,
    listed: &[Listed],
    metric: bool,
    refined_from_px: Option<f64>,
) -> Report {
    let frames: Vec<serde_json::Value> = listed
        .iter()
        .zip(&result.world_from_cam)
        .map(|(Listed { name, .. }, world_from_cam)| {
            let motion = world_from_cam.as_ref().map(Motion::from);
            json!({ "name": name, "world_from_cam": motion })
        })
        .collect();
    let placed: Vec<&RigidTransform> = result.world_from_cam.iter().flatten().collect();
    let length: f64 = placed
        .windows(2)
        .map(|pair| (pair[1].translation.vector - pair[0].translation.vector).norm())
        .sum();
    let length = if metric {
        format!("{length:.3} m")
    } else {
        format!("{length:.3}, in a unit that one camera alone leaves open")
    };
    // Of the left camera, whose frames come first.
    let cameras = result.reconstruction.cameras.iter().take(listed.len());
    let placed_camera = cameras.flatten().next();
    let mut report = Report::default()
        .field("frames", frames)
        .field("keyframes", &result.keyframes)
        .field("lost", &result.lost)
        .field("focal_refined", refined_from_px.is_some());
    if let Some(placed) = placed_camera {
        let lens = placed.camera.lens;
        let focal_px = placed.camera.intrinsics.fu_px();
        report = report
            .field("focal_px", focal_px)
            .field("lens", lens.kind().name())
            .field("distortion", lens.coefficients());
        if let Some(from_px) = refined_from_px {
            report = report.row(
                "focal length",
                format!("{focal_px:.1} px, refined from {from_px:.1}"),
            );
        }
    }
    report
        .field("complete", result.is_complete)
        .row(
            "frames placed",
            format!("{} of {}", placed.len(), listed.len()),
        )
        .row("keyframes", result.keyframes.len())
        .row("points", result.reconstruction.points.len())
        .row("length of the path", length)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct All {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn omitted_options_have_the_defaults_of_the_core() {
        let arguments = All::try_parse_from(["epipole", "frames"])
            .unwrap()
            .arguments;
        let context = Context {
            quiet: true,
            seed: OdometryOptions::default().sfm.seed,
        };
        let (parsed, core) = (
            arguments.options(&context, false),
            OdometryOptions::default(),
        );
        assert_eq!(format!("{parsed:?}"), format!("{core:?}"));
    }
}
