//! The long computation behind `two-view-sfm`: every stage, from photographs to points.

use super::answer::{CloudPoint, Motion, Picture, Request, Source, Verdict, Wire, intrinsics};
use crate::contract::{Problem, Progress};
use crate::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::Error;
use epipole::camera::{Camera, Intrinsics, RigidTransform, look_at};
use epipole::epipolar::{decompose_essential, essential_from_motion, select_pose};
use epipole::feature::MatchOptions;
use epipole::optim::RobustLoss;
use epipole::robust::RansacOptions;
use epipole::sfm::{
    Bundle, BundleOptions, Observation, Photo, PhotoOptions, adjust_bundle, match_photos,
};
use epipole::synthetic::{Photograph, Sampling, Scene, still_life_camera};
use epipole::triangulation::{triangulate_optimal, triangulation_angle_rad};
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view_calibrated,
};
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector3};
use std::ops::ControlFlow;

/// Fewer matches than this tell nothing.
pub(super) const MIN_NUM_MATCHES: usize = 15;
/// Rays that meet at a smaller angle say too little about depth.
const MIN_ANGLE_DEG: f64 = 0.5;
/// Half of the inliers should have a larger one.
const MIN_MEDIAN_ANGLE_DEG: f64 = 0.75;
/// Points whose projections miss their features by more are left out, pixels.
const MAX_REPROJECTION_PX: f64 = 4.0;
/// More features than this cost time and show nothing new.
const MAX_FEATURES: usize = 3000;

/// Where the cameras of the rendered pairs are, and where they look.
const FIRST: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.02, -0.16, 0.05]];
const STEP: [[f64; 3]; 2] = [[0.22, -0.47, -1.20], [0.02, -0.16, 0.05]];
const TURN: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.30, -0.20, 0.0]];

/// The true cameras of a rendered pair.
pub(super) fn true_cameras(source: &Source) -> Option<[Camera; 2]> {
    let second = match source {
        Source::Step => STEP,
        Source::Turn => TURN,
        Source::Own(_) => return None,
    };
    let camera = |[center, target]: [[f64; 3]; 2]| {
        let up = Vector3::new(0.0, -1.0, 0.0);
        Some(Camera {
            cam_from_world: look_at(&Point3::from(center), &Point3::from(target), &up).ok()?,
            ..still_life_camera(PHOTO_WIDTH, PHOTO_HEIGHT)
        })
    };
    Some([camera(FIRST)?, camera(second)?])
}

/// Carries out the computation.
///
/// # Errors
/// A sentence about the photographs, or that the work was ended.
pub(super) fn compute(bytes: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, Problem> {
    let unreadable = |_| Error::Degenerate {
        what: "the motion between two photographs",
        why: "the request cannot be read",
    };
    let request: Request = postcard::from_bytes(bytes).map_err(unreadable)?;
    let mut tell = |share: f64| match progress(share) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Canceled),
    };
    tell(0.0)?;
    let photos = photographs(&request.source, &mut tell)?;
    let wire = follow(&request, photos, &mut tell)?;
    Ok(postcard::to_allocvec(&wire).unwrap_or_default())
}

type Tell<'a> = &'a mut dyn FnMut(f64) -> Result<(), Error>;

fn photographs(source: &Source, tell: Tell<'_>) -> Result<[RgbImage; 2], Error> {
    let unusable = Error::Degenerate {
        what: "the motion between two photographs",
        why: "a photograph has no pixels",
    };
    if let Source::Own(pictures) = source {
        let [first, second] = pictures.as_ref().clone().map(Picture::into_image);
        return first.zip(second).map(|(a, b)| [a, b]).ok_or(unusable);
    }
    let scene = Scene::still_life();
    let mut images = Vec::new();
    for camera in true_cameras(source).ok_or(unusable.clone())? {
        let mut target = Photograph::blank(PHOTO_WIDTH, PHOTO_HEIGHT);
        for first in (0..PHOTO_HEIGHT).step_by(80) {
            let rows = first..first + 80;
            let (width, height) = (PHOTO_WIDTH, PHOTO_HEIGHT);
            scene.render_rows(&camera, width, height, Sampling::Full, rows, &mut target)?;
            let done = images.len() as f64 + f64::from(first) / f64::from(height);
            tell(0.2 * done)?;
        }
        images.push(target.image);
    }
    let [first, second] = <[RgbImage; 2]>::try_from(images).map_err(|_| unusable)?;
    Ok([first, second])
}

/// Detects, matches, finds the motion, and what follows from it.
fn follow(request: &Request, photos: [RgbImage; 2], tell: Tell<'_>) -> Result<Wire, Error> {
    let lens = |image: &RgbImage| {
        intrinsics(request.focal, image).ok_or(Error::NotFinite {
            what: "the focal length",
        })
    };
    let lenses = [lens(&photos[0])?, lens(&photos[1])?];
    let mut options = PhotoOptions {
        matching: MatchOptions {
            max_ratio: Some(request.max_ratio),
            ..MatchOptions::default()
        },
        ..PhotoOptions::default()
    };
    options.sift.max_features = MAX_FEATURES;
    let photos = photos.map(|image| Photo {
        name: String::new(),
        image,
    });
    let mut stage = 0.4;
    let (images, pairs) = match_photos(&photos, &options, &mut |_| {
        stage += 0.15;
        match tell(stage) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    })?;
    let matches = (pairs.ok_or(Error::Canceled)?.pop()).map_or(Vec::new(), |pair| pair.matches);
    let places = [0, 1].map(|n| {
        let place = |p: &Point2<f64>| (p.x, p.y);
        images[n].keypoints.iter().map(place).collect::<Vec<_>>()
    });
    let pixels1: Vec<_> = (matches.iter())
        .map(|m| images[0].keypoints[m.0 as usize])
        .collect();
    let pixels2: Vec<_> = (matches.iter())
        .map(|m| images[1].keypoints[m.1 as usize])
        .collect();
    let colors: Vec<[u8; 3]> = (matches.iter())
        .map(|m| images[0].colors[m.0 as usize])
        .collect();
    let judged = judge(request, &pixels1, &pixels2, &lenses)?;
    tell(0.95)?;
    let (mut verdict, mut motion) = (judged.verdict, None);
    if let Some(cam2_from_cam1) = judged.cam2_from_cam1 {
        let pair = Pair {
            pixels: [&pixels1, &pixels2],
            inliers: &judged.inliers,
            lenses,
            cam2_from_cam1,
        };
        motion = reconstruct(&pair, &colors)?;
        if motion.is_none() {
            verdict = Verdict::Narrow(judged.median_angle_deg);
        }
    }
    let pictures = photos.each_ref().map(|photo| Picture::from(&photo.image));
    Ok(Wire {
        pictures,
        keypoints: places,
        matches,
        inliers: judged.inliers,
        verdict,
        motion,
    })
}

struct Judged {
    verdict: Verdict,
    inliers: Vec<bool>,
    /// There if points can be triangulated.
    cam2_from_cam1: Option<RigidTransform>,
    median_angle_deg: f64,
}

/// What the matches say about the two cameras.
fn judge(
    request: &Request,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    lenses: &[Intrinsics; 2],
) -> Result<Judged, Error> {
    let nothing = |verdict, inliers| Judged {
        verdict,
        inliers,
        cam2_from_cam1: None,
        median_angle_deg: 0.0,
    };
    let none = vec![false; pixels1.len()];
    if pixels1.len() < MIN_NUM_MATCHES {
        return Ok(nothing(Verdict::TooFew, none));
    }
    let options = TwoViewOptions {
        ransac: RansacOptions {
            max_error_px: request.max_error_px,
            ..RansacOptions::default()
        },
        min_num_inliers: MIN_NUM_MATCHES,
        ..TwoViewOptions::default()
    };
    options.ransac.check()?;
    let report: TwoViewReport =
        match estimate_two_view_calibrated(pixels1, pixels2, &lenses[0], &lenses[1], &options) {
            Ok(report) => report,
            // Wrong matches agree on nothing, and matches at one place determine nothing.
            Err(Error::NoConsensus { .. } | Error::Degenerate { .. } | Error::TooFew { .. }) => {
                return Ok(nothing(Verdict::NoConsensus, none));
            }
            Err(error) => return Err(error),
        };
    let median_angle_deg = (report.median_triangulation_angle_rad).map_or(0.0, f64::to_degrees);
    let turn_deg =
        (report.cam2_from_cam1).map_or(0.0, |motion| motion.rotation.angle().to_degrees());
    let fundamental_won = matches!(report.model, TwoViewModel::Fundamental(_));
    let verdict = match report.configuration {
        Configuration::Degenerate => {
            // A model that next to nobody supports has no inliers worth showing.
            return Ok(nothing(Verdict::NoConsensus, none));
        }
        Configuration::Panoramic => Verdict::Turned(turn_deg),
        _ if median_angle_deg < MIN_MEDIAN_ANGLE_DEG => Verdict::Narrow(median_angle_deg),
        Configuration::Planar => Verdict::Plane,
        Configuration::General if fundamental_won => Verdict::Lens,
        Configuration::General => Verdict::Good,
    };
    let has_depth = matches!(verdict, Verdict::Good | Verdict::Plane | Verdict::Lens);
    Ok(Judged {
        verdict,
        inliers: report.inliers,
        cam2_from_cam1: report.cam2_from_cam1.filter(|_| has_depth),
        median_angle_deg,
    })
}

/// Two photographs' matches and the motion between them.
struct Pair<'a> {
    pixels: [&'a [Point2<f64>]; 2],
    inliers: &'a [bool],
    lenses: [Intrinsics; 2],
    cam2_from_cam1: RigidTransform,
}

/// Triangulates the inliers and refines all of it; `None` if hardly any point can be had.
fn reconstruct(pair: &Pair, colors: &[[u8; 3]]) -> Result<Option<Motion>, Error> {
    let camera = |lens, cam_from_world| Camera {
        intrinsics: lens,
        cam_from_world,
    };
    let cameras = [
        camera(pair.lenses[0], RigidTransform::identity()),
        camera(pair.lenses[1], pair.cam2_from_cam1),
    ];
    let mut bundle = Bundle {
        cameras: cameras.to_vec(),
        ..Bundle::default()
    };
    let mut indices = Vec::new();
    let inliers = (0..pair.inliers.len()).filter(|&index| pair.inliers[index]);
    for index in inliers.clone() {
        let (p1, p2) = (pair.pixels[0][index], pair.pixels[1][index]);
        // Rays that are parallel or diverge have no point.
        let Ok(point) = triangulate_optimal(&cameras[0], &cameras[1], &p1, &p2) else {
            continue;
        };
        let centers = [0, 1].map(|n: usize| cameras[n].center_in_world());
        let angle_rad = triangulation_angle_rad(&centers[0], &centers[1], &point);
        if angle_rad.to_degrees() < MIN_ANGLE_DEG {
            continue;
        }
        for (camera, pixel) in [p1, p2].into_iter().enumerate() {
            bundle.observations.push(Observation {
                camera,
                point: indices.len(),
                pixel,
            });
        }
        bundle.points.push(point);
        indices.push(index);
    }
    if indices.len() < MIN_NUM_MATCHES {
        return Ok(None);
    }
    let before_px = rms_error_px(&bundle, 0..indices.len());
    let options = BundleOptions {
        loss: RobustLoss::Huber { width: 2.0 },
        ..BundleOptions::default()
    };
    adjust_bundle(&mut bundle, &options, &mut |_| ControlFlow::Continue(()))?;
    let kept: Vec<usize> = (0..indices.len())
        .filter(|&n| is_good(&bundle, n))
        .collect();
    if kept.len() < MIN_NUM_MATCHES {
        return Ok(None);
    }
    let after_px = rms_error_px(&bundle, kept.iter().copied());
    // The unit of length is the baseline.
    let refined = bundle.cameras[1].cam_from_world;
    let baseline = refined.translation.vector.norm();
    let mut motion = refined;
    motion.translation.vector /= baseline;
    let points = kept
        .iter()
        .map(|&n| {
            CloudPoint::new(
                indices[n],
                &(bundle.points[n] / baseline),
                colors[indices[n]],
            )
        })
        .collect();
    let chosen = |n: usize| {
        inliers
            .clone()
            .map(|i| pair.pixels[n][i])
            .collect::<Vec<_>>()
    };
    let num_in_front = four_poses(&motion, &chosen(0), &chosen(1), &pair.lenses)?;
    let error_px = [before_px, after_px];
    Ok(Some(Motion::new(&motion, num_in_front, error_px, points)))
}

/// How many matches each of the four poses of E puts in front of both cameras, most first.
fn four_poses(
    motion: &RigidTransform,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    lenses: &[Intrinsics; 2],
) -> Result<[usize; 4], Error> {
    let mut counts = [0; 4];
    let poses = decompose_essential(&essential_from_motion(motion)?)?;
    for (count, pose) in counts.iter_mut().zip(poses) {
        let selected = select_pose(&[pose], pixels1, pixels2, &lenses[0], &lenses[1])?;
        *count = selected.num_in_front;
    }
    counts.sort_unstable_by_key(|count| std::cmp::Reverse(*count));
    Ok(counts)
}

/// Whether a point is in front of both cameras, finite, and near both of its features.
fn is_good(bundle: &Bundle, point: usize) -> bool {
    let in_front = (bundle.cameras.iter())
        .all(|camera| (camera.cam_from_world * bundle.points[point]).z > 0.0);
    let near = |observation| bundle.residual_px(observation).norm() < MAX_REPROJECTION_PX;
    in_front && near(2 * point) && near(2 * point + 1)
}

/// Root mean square of the reprojection errors of some points, pixels.
fn rms_error_px(bundle: &Bundle, points: impl Iterator<Item = usize>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for point in points {
        for observation in [2 * point, 2 * point + 1] {
            let error_px = bundle.residual_px(observation).norm();
            if error_px.is_finite() {
                sum += error_px * error_px;
                count += 1.0;
            }
        }
    }
    if count > 0.0 {
        (sum / count).sqrt()
    } else {
        0.0
    }
}

/// The angle of the true rotation of a rendered pair, degrees.
pub(super) fn true_turn_deg(source: &Source) -> Option<f64> {
    let [first, second] = true_cameras(source)?;
    let motion = epipole::camera::relative_motion(&first.cam_from_world, &second.cam_from_world);
    Some(motion.rotation.angle().to_degrees())
}
