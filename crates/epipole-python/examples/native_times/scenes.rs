//! Functions of many cameras.

use crate::{Outcome, Timers, keep};
use epipole::calibration::{Board, BoardView, CalibrationOptions, Pattern, calibrate};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::feature::Match;
use epipole::nalgebra::{Point3, Translation3, UnitQuaternion};
use epipole::sfm::{
    AlignmentKind, Bundle, BundleObservation, BundleOptions, OdometryOptions, PairMatches,
    SfmImage, SfmInput, SfmOptions, absolute_trajectory_error, adjust_bundle, align_points,
    build_tracks, monocular_odometry, reconstruct,
};
use epipole::synthetic::{MultiViewProblem, MultiViewProblemOptions};

pub(crate) fn add(timers: &mut Timers) -> Outcome {
    let options = MultiViewProblemOptions::default()
        .with_num_cameras(10)
        .with_num_points(500)
        .with_noise_px(0.5)
        .with_seed(2);
    let world = keep(MultiViewProblem::new(&options)?);
    add_bundle(timers, world);
    add_reconstruction(timers, world);
    add_alignment(timers)?;
    add_calibration(timers)
}

fn add_bundle(timers: &mut Timers, world: &'static MultiViewProblem) {
    // The points come rounded to tenths: work for the adjustment.
    let rounded = |x: &Point3<f64>| x.map(|x| (x * 10.0).round() / 10.0);
    let observations = world
        .observations
        .iter()
        .map(|observation| BundleObservation {
            camera: observation.camera,
            point: observation.point,
            pixel: observation.pixel,
        });
    let bundle = Bundle {
        cameras: world.cameras.clone(),
        points: world.points.iter().map(rounded).collect(),
        observations: observations.collect(),
        ..Bundle::default()
    };
    let options = BundleOptions::default();
    timers.add("adjust_bundle", move || {
        let mut adjusted = bundle.clone();
        let report = adjust_bundle(&mut adjusted, &options, &mut ());
        (adjusted, report)
    });
}

fn add_reconstruction(timers: &mut Timers, world: &'static MultiViewProblem) {
    let images: Vec<SfmImage> = (0..world.cameras.len())
        .map(|camera| SfmImage {
            name: camera.to_string(),
            keypoints: (world.observations.iter())
                .filter(|observation| observation.camera == camera)
                .map(|observation| observation.pixel)
                .collect(),
            ..SfmImage::default()
        })
        .collect();
    // Every camera sees every point: keypoint k is point k.
    let matches: Vec<Match> = (0..world.points.len())
        .map(|index| Match {
            index1: index,
            index2: index,
            distance: 0.0,
            ratio: 0.0,
        })
        .collect();
    let mut pairs = Vec::new();
    for image1 in 0..images.len() {
        for image2 in image1 + 1..images.len() {
            pairs.push(PairMatches {
                image1,
                image2,
                matches: matches.clone(),
            });
        }
    }
    let pairs = keep(pairs);
    let counts = vec![world.points.len(); images.len()];
    timers.add("build_tracks", move || build_tracks(&counts, pairs));
    let input = SfmInput {
        images,
        cameras: vec![world.cameras[0].camera],
        pairs: pairs.clone(),
    };
    let input = keep(input);
    let options = SfmOptions::default();
    timers.add("reconstruct", move || reconstruct(input, &options, &mut ()));
    let options = OdometryOptions::default();
    timers.add("monocular_odometry", move || {
        monocular_odometry(input, &options, &mut ())
    });
}

fn add_alignment(timers: &mut Timers) -> Outcome {
    let places: Vec<_> = (0..100_000)
        .map(|i| {
            let t = f64::from(i) * 1e-3;
            Point3::new(t, t * t * 1e-2, -t)
        })
        .collect();
    let moved: Vec<_> = places
        .iter()
        .map(|x| Point3::from(2.0 * x.coords))
        .collect();
    let (places, moved) = (keep(places), keep(moved));
    timers.add("align_points", move || {
        align_points(places, moved, AlignmentKind::Similarity)
    });
    timers.add("absolute_trajectory_error", move || {
        absolute_trajectory_error(places, moved, AlignmentKind::Similarity)
    });
    Ok(())
}

fn add_calibration(timers: &mut Timers) -> Outcome {
    let board = Board::new(Pattern::Chessboard, 9, 6, 0.03)?;
    let camera = Camera::pinhole(Intrinsics::new(600.0, 600.0, 319.5, 239.5)?, 640, 480);
    let views: Vec<Option<BoardView>> = (0..12)
        .map(|k| {
            let yaw_rad = 0.1 * f64::from(k) - 0.5;
            let rotation =
                UnitQuaternion::from_scaled_axis([yaw_rad, -0.5 * yaw_rad, 0.1 * yaw_rad].into());
            let translation = Translation3::new(-0.12, -0.08, 0.5);
            let posed = PosedCamera {
                camera,
                cam_from_world: RigidTransform::from_parts(translation, rotation),
            };
            let pixel = |mark| {
                let place = board.mark(mark);
                posed.project(&Point3::new(place.x, place.y, 0.0)).ok()
            };
            Some(BoardView {
                pixels: (0..board.num_marks()).map(pixel).collect(),
            })
        })
        .collect();
    let options = CalibrationOptions::default();
    timers.add("calibrate", move || {
        calibrate(&board, &views, (640, 480), &options, &mut ())
    });
    Ok(())
}
