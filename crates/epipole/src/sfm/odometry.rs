//! Visual odometry: where a camera went, frame after frame.

use super::builder::Builder;
use super::bundle::Sensor;
use super::incremental::{
    Reporter, SfmInput, SfmObserver, SfmOptions, SfmStep, check, lenses, verify,
};
use super::keyframes::Keyframes;
use super::reconstruction::{Reconstruction, SfmImage};
use super::tracks::{PairMatches, build_tracks};
use super::views::Views;
use crate::camera::{Intrinsics, PosedCamera, RigidTransform};
use crate::robust::RansacOptions;
use crate::{Error, Result};
use std::ops::ControlFlow;

/// What is asked for, as an error of too few says.
const OF_FRAMES: &str = "the path of a camera from frames";

/// How to follow a camera.
#[derive(Debug, Clone, PartialEq)]
pub struct OdometryOptions {
    /// Thresholds, in pixels and degrees. Frames are nearer to each other than photographs, so
    /// that points are accepted under smaller angles: 0.3 degrees, and the start wants 1.
    pub sfm: SfmOptions,
    /// Keyframes that are refined together; older ones stay. 8.
    pub window: usize,
    /// Refine everything once more at the end, and again while a focal length that is refined has not arrived. True.
    pub final_adjustment: bool,
}

impl Default for OdometryOptions {
    fn default() -> Self {
        Self {
            sfm: SfmOptions {
                ransac: RansacOptions::default().within(1.5),
                max_registration_error_px: 3.0,
                max_reprojection_error_px: 2.0,
                min_angle_deg: 0.3,
                min_start_angle_deg: 1.0,
                ..SfmOptions::default()
            },
            window: 8,
            final_adjustment: true,
        }
    }
}

/// How often everything is refined at the end, at most.
const FINAL_ADJUSTMENTS: usize = 10;

/// A focal length that changes by less than this share has arrived.
const SETTLED_FOCAL: f64 = 2e-3;

/// Where the camera went.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OdometryResult {
    /// `world_from_cam` of each frame, `None` where it was lost. The first frame that was found is
    /// the origin. One camera alone leaves the unit of length open.
    pub world_from_cam: Vec<Option<RigidTransform>>,
    /// Frames that gave points: those that lie sufficiently far from the one before, by the angle
    /// under which points see the two, or that show much that it does not.
    pub keyframes: Vec<usize>,
    /// Frames that could not be placed.
    pub lost: Vec<usize>,
    /// The cameras and points; of a stereo rig the left cameras, then the right ones.
    pub reconstruction: Reconstruction,
    /// Whether the caller ended the work early; what is there is valid.
    pub canceled: bool,
}

/// The path of a single camera, up to scale.
///
/// * `input`: frames in order of time, and matches between frames that are near in time; each
///   frame with several before it, so that tracks survive a bad pair
/// * `observer`: hears of every frame; answer [`ControlFlow::Break`] to stop with what is there
///
/// The start comes from the essential matrix of the first two frames that see their points under
/// a sufficient angle; each further frame is placed by P3P. Frames that show something new become
/// keyframes: they give points, and the last of them are refined together.
///
/// # Errors
/// As [`reconstruct`](super::reconstruct), and [`Error::Degenerate`] if no two frames make a
/// start, as when the camera only turns or stands still.
///
/// Source: Nistér, Naroditsky & Bergen 2004, "Visual odometry"; Mouragnon et al. 2006, "Real time
/// localization and 3D reconstruction" (refining the last frames).
pub fn monocular_odometry(
    input: &SfmInput,
    options: &OdometryOptions,
    observer: SfmObserver<'_>,
) -> Result<OdometryResult> {
    let intrinsics = check(OF_FRAMES, input, &options.sfm)?;
    follow(input, intrinsics, None, options, observer)
}

/// The path of a stereo rig, in the unit of its baseline.
///
/// * `left`: frames of the left camera in order of time, and matches between them
/// * `right`: the same frames of the right camera
/// * `left_right`: matches between the two pictures of each frame, left first
/// * `right_from_left`: the rig; its translation is minus the baseline along x if the pictures are
///   rectified
/// * `right_intrinsics`: of the right camera
/// * `observer`: as in [`monocular_odometry`]
///
/// # Errors
/// As [`monocular_odometry`]; [`Error::SizeMismatch`] unless there are as many right pictures and
/// lists of matches as left pictures; [`Error::Degenerate`] for a rig without a baseline, or if
/// the first frame has too few matches.
///
/// Source: Nistér, Naroditsky & Bergen 2004, "Visual odometry", §5.
pub fn stereo_odometry(
    left: &SfmInput,
    right: &[SfmImage],
    left_right: &[Vec<(u32, u32)>],
    right_from_left: &RigidTransform,
    right_intrinsics: &Intrinsics,
    options: &OdometryOptions,
    observer: SfmObserver<'_>,
) -> Result<OdometryResult> {
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
    let mut intrinsics = check(OF_FRAMES, left, &options.sfm)?;
    let mut input = left.clone();
    input.images.extend(right.iter().cloned());
    intrinsics.resize(2 * num_frames, *right_intrinsics);
    input.intrinsics = intrinsics.clone();
    // Right pictures take part through their left ones alone.
    for (frame, matches) in left_right.iter().enumerate() {
        input.pairs.push(PairMatches {
            image1: frame,
            image2: num_frames + frame,
            matches: matches.clone(),
        });
    }
    check(OF_FRAMES, &input, &options.sfm)?;
    let rig = Sensor {
        sensor_from_camera: *right_from_left,
        intrinsics: *right_intrinsics,
        lens: right.first().map_or(0, |image| image.lens),
    };
    follow(&input, intrinsics, Some(rig), options, observer)
}

fn follow(
    input: &SfmInput,
    intrinsics: Vec<Intrinsics>,
    rig: Option<Sensor>,
    options: &OdometryOptions,
    observer: SfmObserver<'_>,
) -> Result<OdometryResult> {
    let images = &input.images;
    let num_frames = if rig.is_some() {
        images.len() / 2
    } else {
        images.len()
    };
    let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
    build_tracks(&counts, &input.pairs)?;
    let mut reporter = Reporter {
        observer,
        watcher: None,
        canceled: false,
    };
    let lenses = lenses(images, &options.sfm);
    let views = Views::new(images, &intrinsics, &lenses);
    let verified = verify(input, &options.sfm, &intrinsics, &views, &mut reporter);
    let surviving: Vec<PairMatches> = verified.iter().map(|v| v.pair.clone()).collect();
    let tracks = build_tracks(&counts, &surviving)?;
    let mut track_of: Vec<Vec<u32>> = counts.iter().map(|n| vec![u32::MAX; *n]).collect();
    for (index, track) in tracks.iter().enumerate() {
        for element in track {
            track_of[element.image as usize][element.keypoint as usize] = index as u32;
        }
    }
    let mut builder = Builder {
        images,
        options: &options.sfm,
        views,
        intrinsics,
        lenses,
        tracks: &tracks,
        track_of: &track_of,
        taken: vec![false; images.len()],
        rig,
        cameras: vec![None; images.len()],
        points: vec![None; tracks.len()],
        is_placed: false,
    };
    let started = if rig.is_some() {
        start_with_rig(&mut builder, num_frames)
    } else {
        // The earliest start that is wide enough.
        let mut early = verified;
        let wanted_rad = options.sfm.min_start_angle_deg.to_radians();
        early.sort_by_key(|v| {
            let narrow = v.median_angle_rad < wanted_rad;
            (
                narrow,
                v.pair.image1.min(v.pair.image2),
                v.pair.image1.max(v.pair.image2),
            )
        });
        early.iter().any(|v| builder.start_from(v, &mut reporter))
    };
    if !started {
        if reporter.canceled {
            return Ok(OdometryResult {
                world_from_cam: vec![None; num_frames],
                lost: (0..num_frames).collect(),
                canceled: true,
                ..OdometryResult::default()
            });
        }
        return Err(Error::Degenerate {
            what: "the path of a camera",
            why: "no two pictures see enough points under a sufficient angle",
        });
    }
    let mut keyframes = Keyframes::default();
    for frame in (0..num_frames).filter(|&f| builder.cameras[f].is_some()) {
        keyframes.insert(frame);
    }
    let keyframe_angle_rad = options.sfm.min_start_angle_deg.to_radians();
    let first = (0..num_frames)
        .find(|&f| builder.cameras[f].is_some())
        .unwrap_or(0);
    // Forward to the end, then back for what came before the start.
    let order = (first..num_frames).chain((0..first).rev());
    for frame in order {
        if reporter.canceled {
            break;
        }
        if builder.cameras[frame].is_some() || builder.register(frame).is_none() {
            continue;
        }
        if keyframes.is_due(&builder, frame, keyframe_angle_rad) {
            keyframes.insert(frame);
            builder.triangulate_of(Some(frame));
        }
        let window = keyframes.window(frame, options.window.max(2) - 1);
        let cost = builder.adjust(Some(&window), 10, false, &mut reporter);
        builder.filter();
        builder.complete();
        if let Some(cost) = cost {
            reporter.tell(&SfmStep::Adjusted { cost });
        }
        reporter.tell(&SfmStep::Registered {
            image: frame,
            num_registered: (0..num_frames)
                .filter(|&f| builder.cameras[f].is_some())
                .count(),
            num_points: builder.num_points(),
        });
    }
    if options.final_adjustment {
        adjust_finally(&mut builder, &mut reporter);
    }
    let keyframes = keyframes.into_frames(|frame| builder.cameras[frame].is_some());
    let mut result = result_of(builder, num_frames, reporter.canceled);
    result.keyframes = keyframes;
    Ok(result)
}

/// Refines everything at once, again for as long as the focal length is on its way: with a better one other matches fit.
fn adjust_finally(builder: &mut Builder<'_>, reporter: &mut Reporter<'_>) {
    for _ in 0..FINAL_ADJUSTMENTS {
        if reporter.canceled {
            return;
        }
        let before = builder.intrinsics.clone();
        builder.complete();
        builder.triangulate();
        builder.adjust(None, 50, true, reporter);
        builder.filter();
        let mut both = before.iter().zip(&builder.intrinsics);
        if both.all(|(old, new)| (new.fu_px() / old.fu_px() - 1.0).abs() < SETTLED_FOCAL) {
            return;
        }
    }
}

/// Starts at the first frame whose two pictures share enough points.
fn start_with_rig(builder: &mut Builder<'_>, num_frames: usize) -> bool {
    for frame in 0..num_frames {
        let camera = PosedCamera {
            intrinsics: builder.intrinsics[frame],
            cam_from_world: RigidTransform::identity(),
        };
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

fn result_of(builder: Builder<'_>, num_frames: usize, canceled: bool) -> OdometryResult {
    let mut reconstruction = builder.finish();
    let origin = reconstruction.cameras[..num_frames]
        .iter()
        .flatten()
        .next()
        .map_or_else(RigidTransform::identity, |camera| camera.cam_from_world);
    // The first frame is where the world's origin is.
    let world_from_old = origin;
    for camera in reconstruction.cameras.iter_mut().flatten() {
        camera.cam_from_world *= world_from_old.inverse();
    }
    // Exactly, where rounding would leave a trace of the old pose.
    if let Some(first) = reconstruction.cameras[..num_frames]
        .iter_mut()
        .flatten()
        .next()
    {
        first.cam_from_world = RigidTransform::identity();
    }
    for point in &mut reconstruction.points {
        point.position = world_from_old * point.position;
    }
    let world_from_cam: Vec<Option<RigidTransform>> = reconstruction.cameras[..num_frames]
        .iter()
        .map(|camera| camera.map(|camera| camera.cam_from_world.inverse()))
        .collect();
    OdometryResult {
        lost: (0..num_frames)
            .filter(|&f| world_from_cam[f].is_none())
            .collect(),
        world_from_cam,
        reconstruction,
        canceled,
        ..OdometryResult::default()
    }
}

/// An observer that never stops the work.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::sfm::{SfmInput, SfmOptions, keep_going, reconstruct};
/// let too_few = reconstruct(&SfmInput::default(), &SfmOptions::default(), &mut keep_going);
/// assert!(too_few.is_err());
/// # Ok(()) }
/// ```
pub fn keep_going(_: &SfmStep) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
