//! Visual odometry: the path of a camera, frame by frame.

use super::builder::Builder;
use super::bundle::Sensor;
use super::incremental::SfmStep;
use super::keyframes::Keyframes;
use super::odometry_options::OdometryOptions;
use super::odometry_result::{OdometryResult, result_of};
use super::options::{SfmInput, check};
use super::reconstruction::SfmImage;
use super::tracks::{PairMatches, build_tracks};
use super::two_view_start::{VerifiedPair, verify_pairs};
use crate::camera::{Camera, RigidTransform};
use crate::feature::Match;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use std::collections::VecDeque;

/// Name of the result in [`Error::TooFew`].
const OF_FRAMES: &str = "the path of a camera from frames";

/// Maximum number of final adjustments.
const FINAL_ADJUSTMENTS: usize = 10;

/// Relative change of the focal length below which it has converged.
const FOCAL_TOLERANCE: f64 = 2e-3;

/// Progress when all pairs are verified.
const VERIFIED: f32 = 0.5;

/// Estimates the path of a single camera, up to scale.
///
/// * `input`: frames in order of time, with matches between each frame and several before it, so
///   that tracks survive a bad pair
/// * `monitor`: the stages are [`Stage::PairVerification`], then alternately
///   [`Stage::Registration`] and [`Stage::BundleAdjustment`]
///
/// The essential matrix of the first two frames with a sufficient angle initializes the path; P3P
/// registers each further frame. Frames with enough new content become keyframes: they provide
/// points, and the last of them are refined together. [`Odometry`] does the same step by step, and
/// keeps the partial result when canceled.
///
/// # Errors
/// As [`reconstruct`](super::reconstruct), and [`Error::Degenerate`] if no two frames can
/// initialize the path, as for a camera that only rotates or does not move.
///
/// Source: Nistér, Naroditsky & Bergen 2004, "Visual odometry"; Mouragnon et al. 2006, "Real time
/// localization and 3D reconstruction" (refining the last frames).
pub fn monocular_odometry(
    input: &SfmInput,
    options: &OdometryOptions,
    monitor: &mut dyn Monitor,
) -> Result<OdometryResult> {
    Odometry::monocular(input, options, monitor)?.run(monitor)
}

/// Estimates the path of a stereo rig, in the unit of its baseline.
///
/// * `left`: frames of the left camera in order of time, and matches between them
/// * `right`: the same frames of the right camera
/// * `left_right`: matches between the two images of each frame, left first
/// * `right_from_left`: pose of the rig; for rectified images its translation is minus the baseline
///   along x
/// * `right_camera`: camera of the right images
/// * `monitor`: as in [`monocular_odometry`]
///
/// # Errors
/// As [`monocular_odometry`]; [`Error::SizeMismatch`] unless there are as many right images and
/// lists of matches as left images; [`Error::Degenerate`] for a rig without a baseline, or if the
/// first frame has too few matches.
///
/// Source: Nistér, Naroditsky & Bergen 2004, "Visual odometry", §5.
pub fn stereo_odometry(
    left: &SfmInput,
    right: &[SfmImage],
    left_right: &[Vec<Match>],
    right_from_left: &RigidTransform,
    right_camera: &Camera,
    options: &OdometryOptions,
    monitor: &mut dyn Monitor,
) -> Result<OdometryResult> {
    Odometry::stereo(
        left,
        right,
        left_right,
        right_from_left,
        right_camera,
        options,
        monitor,
    )?
    .run(monitor)
}

/// Step-by-step [`monocular_odometry`] or [`stereo_odometry`].
///
/// ```
/// # fn follow(frames: &epipole::sfm::SfmInput) -> Result<(), epipole::Error> {
/// use epipole::sfm::{Odometry, OdometryOptions};
/// let mut run = Odometry::monocular(frames, &OdometryOptions::default(), &mut ())?;
/// while let Some(step) = run.step(&mut ())? {
///     println!("{step:?}");
/// }
/// println!("{} frames are lost", run.finish().lost.len());
/// # Ok(()) }
/// ```
pub struct Odometry {
    builder: Builder,
    options: OdometryOptions,
    num_frames: usize,
    keyframes: Keyframes,
    /// Frames to register, the next one first.
    order: VecDeque<usize>,
    /// Number of remaining global adjustments.
    num_adjustments: usize,
    fraction: f32,
}

impl Odometry {
    /// Verifies the pairs and finds the initial frames of [`monocular_odometry`].
    ///
    /// * `monitor`: the stages are [`Stage::PairVerification`] and [`Stage::BundleAdjustment`];
    ///   progress is relative to the whole odometry
    ///
    /// # Errors
    /// As [`monocular_odometry`].
    pub fn monocular(
        input: &SfmInput,
        options: &OdometryOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let cameras = check(OF_FRAMES, &input.images, &input.cameras, &options.sfm)?;
        Self::start(input, cameras, None, options, monitor)
    }

    /// Verifies the pairs and finds the initial frame of [`stereo_odometry`].
    ///
    /// * `monitor`: as in [`monocular`](Self::monocular)
    ///
    /// # Errors
    /// As [`stereo_odometry`].
    pub fn stereo(
        left: &SfmInput,
        right: &[SfmImage],
        left_right: &[Vec<Match>],
        right_from_left: &RigidTransform,
        right_camera: &Camera,
        options: &OdometryOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let num_frames = left.images.len();
        for (what, second) in [
            ("the lists of left and right pictures", right.len()),
            (
                "the lists of left pictures and of matches between left and right",
                left_right.len(),
            ),
        ] {
            if second != num_frames {
                return Err(Error::SizeMismatch {
                    what,
                    first: num_frames,
                    second,
                });
            }
        }
        if right_from_left.translation.vector.norm() <= 0.0 {
            return Err(Error::Degenerate {
                what: "the scale of a stereo rig's path",
                why: "the two cameras are at the same place",
            });
        }
        let mut cameras = check(OF_FRAMES, &left.images, &left.cameras, &options.sfm)?;
        let mut input = left.clone();
        input.images.extend(right.iter().cloned());
        cameras.resize(2 * num_frames, *right_camera);
        // Right images are linked to other frames only through their left ones.
        for (frame, matches) in left_right.iter().enumerate() {
            input.pairs.push(PairMatches {
                image1: frame,
                image2: num_frames + frame,
                matches: matches.clone(),
            });
        }
        check(OF_FRAMES, &input.images, &cameras, &options.sfm)?;
        Self::start(&input, cameras, Some(right_from_left), options, monitor)
    }

    fn start(
        input: &SfmInput,
        cameras: Vec<Camera>,
        right_from_left: Option<&RigidTransform>,
        options: &OdometryOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let images = &input.images;
        let num_frames = match right_from_left {
            Some(_) => images.len() / 2,
            None => images.len(),
        };
        let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
        // Find invalid indices before the work begins.
        build_tracks(&counts, &input.pairs)?;
        let mut builder = Builder::new(images, cameras, &options.sfm);
        let mut part = Part::new(monitor, 0.0, VERIFIED);
        let verified = verify_pairs(&input.pairs, &builder.views, &options.sfm, &mut part)?;
        let surviving: Vec<PairMatches> = verified.iter().map(|v| v.pair.clone()).collect();
        builder.join_tracks(&surviving)?;
        builder.rig = (right_from_left.zip(images.get(num_frames))).map(|(motion, right)| Sensor {
            sensor_from_camera: *motion,
            camera: builder.calibration[num_frames],
            lens: right.lens,
        });
        let mut part = Part::new(monitor, VERIFIED, VERIFIED);
        let started = match builder.rig {
            Some(_) => start_with_rig(&mut builder, num_frames),
            None => start_early(&mut builder, verified, &mut part)?,
        };
        if !started {
            return Err(Error::Degenerate {
                what: "the path of a camera",
                why: "no two pictures see enough points under a sufficient angle",
            });
        }
        let placed: Vec<usize> = (0..num_frames)
            .filter(|&frame| builder.cameras[frame].is_some())
            .collect();
        let mut keyframes = Keyframes::default();
        for &frame in &placed {
            keyframes.insert(frame);
        }
        let first = placed.first().copied().unwrap_or(0);
        Ok(Self {
            builder,
            options: options.clone(),
            num_frames,
            keyframes,
            // Forward to the end, then back from the start.
            order: (first..num_frames).chain((0..first).rev()).collect(),
            num_adjustments: match options.final_adjustment {
                true => FINAL_ADJUSTMENTS,
                false => 0,
            },
            fraction: VERIFIED,
        })
    }

    /// Registers the next frame, or refines everything at the end; `None` after the last step.
    ///
    /// * `monitor`: the stages are [`Stage::Registration`] and [`Stage::BundleAdjustment`]
    ///
    /// # Errors
    /// [`Error::Canceled`]; the partial result is valid.
    pub fn step(&mut self, monitor: &mut dyn Monitor) -> Result<Option<SfmStep>> {
        while let Some(&frame) = self.order.front() {
            report(monitor, Stage::Registration, self.fraction)?;
            let is_new = self.builder.cameras[frame].is_none();
            let placed = is_new && self.builder.register(frame).is_some();
            self.order.pop_front();
            if !placed {
                continue;
            }
            let cost = self.refine_around(frame, monitor)?;
            let cameras = &self.builder.cameras[..self.num_frames];
            let num_registered = cameras.iter().flatten().count();
            let whole = self.num_frames.max(1) as f32;
            let fraction = VERIFIED + (1.0 - VERIFIED) * num_registered as f32 / whole;
            self.fraction = fraction.clamp(self.fraction, 1.0);
            report(monitor, Stage::Registration, self.fraction)?;
            return Ok(Some(SfmStep::Registered {
                image: frame,
                num_registered,
                num_points: self.builder.num_points(),
                cost,
            }));
        }
        while self.num_adjustments > 0 {
            if let Some(cost) = self.adjust_all(monitor)? {
                return Ok(Some(SfmStep::Adjusted { cost }));
            }
        }
        Ok(None)
    }

    /// Returns the path so far.
    pub fn finish(self) -> OdometryResult {
        let is_complete = self.order.is_empty() && self.num_adjustments == 0;
        let cameras = &self.builder.cameras;
        let keyframes = (self.keyframes).into_frames(|frame| cameras[frame].is_some());
        OdometryResult {
            keyframes,
            is_complete,
            ..result_of(&self.builder, self.num_frames)
        }
    }

    fn run(mut self, monitor: &mut dyn Monitor) -> Result<OdometryResult> {
        while self.step(monitor)?.is_some() {}
        Ok(self.finish())
    }

    /// Triangulates points of a new frame and refines the last keyframes with it.
    fn refine_around(&mut self, frame: usize, monitor: &mut dyn Monitor) -> Result<Option<f64>> {
        let builder = &mut self.builder;
        let min_angle_rad = self.options.sfm.min_start_angle_deg.to_radians();
        if self.keyframes.is_due(builder, frame, min_angle_rad) {
            self.keyframes.insert(frame);
            builder.triangulate_of(Some(frame));
        }
        let window = (self.keyframes).window(frame, self.options.window.max(2) - 1);
        let mut part = Part::new(monitor, self.fraction, self.fraction);
        let cost = builder.adjust(Some(&window), 10, false, &mut part);
        builder.filter();
        builder.complete();
        cost
    }

    /// Refines everything, and repeats until the focal length converges: with a better one, other
    /// matches fit.
    fn adjust_all(&mut self, monitor: &mut dyn Monitor) -> Result<Option<f64>> {
        let builder = &mut self.builder;
        let before = builder.calibration.clone();
        builder.complete();
        builder.triangulate();
        let mut part = Part::new(monitor, self.fraction, self.fraction);
        let cost = builder.adjust(None, 50, true, &mut part);
        builder.filter();
        let cost = cost?;
        let mut both = before.iter().zip(&builder.calibration);
        let has_converged = both.all(|(old, new)| {
            (new.intrinsics.fu_px() / old.intrinsics.fu_px() - 1.0).abs() < FOCAL_TOLERANCE
        });
        self.num_adjustments = match has_converged {
            true => 0,
            false => self.num_adjustments - 1,
        };
        Ok(cost)
    }
}

/// Initializes from the earliest pair with a sufficient angle.
fn start_early(
    builder: &mut Builder,
    mut early: Vec<VerifiedPair>,
    monitor: &mut dyn Monitor,
) -> Result<bool> {
    let wanted_rad = builder.options.min_start_angle_deg.to_radians();
    early.sort_by_key(|v| {
        let narrow = v.median_angle_rad < wanted_rad;
        let (a, b) = (v.pair.image1, v.pair.image2);
        (narrow, a.min(b), a.max(b))
    });
    for pair in &early {
        if builder.start_from(pair, monitor)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Initializes at the first frame whose two images share enough points.
fn start_with_rig(builder: &mut Builder, num_frames: usize) -> bool {
    for frame in 0..num_frames {
        let camera = builder.posed(frame, RigidTransform::identity());
        builder.place(frame, Some(camera));
        builder.triangulate();
        if builder.num_points() >= builder.options.min_num_inliers {
            return true;
        }
        builder.place(frame, None);
        builder.points.fill(None);
    }
    false
}
