//! The path of a camera, and of a stereo rig, against the truth.

use super::world::{Making, World, ball, errors, intrinsics, observe};
use epipole::Error;
use epipole::camera::{Camera, PosedCamera, RigidTransform};
use epipole::feature::Match;
use epipole::math::random::Random;
use epipole::sfm::{OdometryOptions, monocular_odometry, stereo_odometry};
use nalgebra::{Point3, Vector3};

/// A drive along a bend between two rows of points.
fn drive(frames: usize, making: Making) -> (World, Vec<Point3<f64>>) {
    let mut random = Random::new(31);
    let mut points = Vec::new();
    for _ in 0..1500 {
        let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        points.push(Point3::new(
            side * random.uniform(2.0, 8.0),
            random.uniform(-3.0, 1.5),
            random.uniform(2.0, 45.0),
        ));
    }
    let cameras = (0..frames)
        .map(|i| {
            let along = 0.5 * i as f64;
            let rotation_vector = Vector3::new(0.0, 0.01 * i as f64, 0.0);
            let world_from_cam = RigidTransform::new(
                Vector3::new(0.02 * along * along, 0.0, along),
                rotation_vector,
            );
            PosedCamera {
                camera: Camera::pinhole(intrinsics(), 640, 480),
                cam_from_world: world_from_cam.inverse(),
            }
        })
        .collect();
    (observe(cameras, &points, making, 32), points)
}

#[test]
fn one_camera_is_followed_up_to_scale() {
    let making = Making {
        noise_px: 0.2,
        wrong: 0.1,
        reach: 3,
        ..Making::default()
    };
    let (world, _) = drive(20, making);
    let result =
        monocular_odometry(&world.input, &OdometryOptions::default(), &mut ()).expect("a path");
    assert!(result.lost.is_empty());
    assert_eq!(result.world_from_cam[0], Some(RigidTransform::identity()));
    let (distance, angle_deg) = errors(&world, &result.reconstruction.cameras);
    // Half a percent of the ten meters.
    assert!(distance < 0.05 && angle_deg < 0.2, "{distance} {angle_deg}");
}

#[test]
fn a_camera_that_waits_gets_no_keyframes_meanwhile() {
    // Four pictures from every place: three of them show nothing new.
    let making = Making {
        noise_px: 0.2,
        wrong: 0.1,
        reach: 8,
        ..Making::default()
    };
    let (moving, points) = drive(8, making);
    let cameras = moving.cameras.iter().flat_map(|camera| [*camera; 4]);
    let world = observe(cameras.collect(), &points, making, 36);
    let result =
        monocular_odometry(&world.input, &OdometryOptions::default(), &mut ()).expect("a path");
    assert!(result.lost.is_empty());
    let mut places: Vec<usize> = result.keyframes.iter().map(|frame| frame / 4).collect();
    places.dedup();
    assert_eq!(
        places.len(),
        result.keyframes.len(),
        "{:?}",
        result.keyframes
    );
    assert!(
        places.len() >= 4 && result.keyframes.is_sorted(),
        "{places:?}"
    );
    let (distance, _) = errors(&world, &result.reconstruction.cameras);
    // The path is short and nearly straight, so its centers leave open how it is rolled: the
    // cameras are compared with the first one, which is at rest in both.
    let angle_deg = (result.reconstruction.cameras.iter().flatten())
        .zip(&world.cameras)
        .map(|(got, want)| {
            let rotation = got.cam_from_world.rotation;
            rotation
                .angle_to(&want.cam_from_world.rotation)
                .to_degrees()
        })
        .fold(0.0, f64::max);
    // One percent of the four meters.
    assert!(
        distance < 0.04 && angle_deg < 0.02,
        "{distance} {angle_deg}"
    );
}

#[test]
fn a_stereo_rig_is_followed_in_meters() {
    let making = Making {
        noise_px: 0.2,
        wrong: 0.1,
        reach: 3,
        ..Making::default()
    };
    let (left, points) = drive(20, making);
    let right_from_left = RigidTransform::translation(-0.5, 0.0, 0.0);
    let right_cameras: Vec<PosedCamera> = left
        .cameras
        .iter()
        .map(|camera| PosedCamera {
            cam_from_world: right_from_left * camera.cam_from_world,
            ..*camera
        })
        .collect();
    let right = observe(right_cameras, &points, making, 33);
    // Points carry their number in a color; that is how the test matches left and right.
    let left_right: Vec<Vec<Match>> = left
        .input
        .images
        .iter()
        .zip(&right.input.images)
        .map(|(a, b)| {
            let mut matches = Vec::new();
            for (i, p) in a.keypoints.iter().enumerate() {
                for (j, q) in b.keypoints.iter().enumerate() {
                    let disparity = p.x - q.x;
                    if a.colors[i] == b.colors[j]
                        && (p.y - q.y).abs() < 1.5
                        && (1.0..200.0).contains(&disparity)
                    {
                        matches.push(Match::new(i, j));
                        break;
                    }
                }
            }
            matches
        })
        .collect();
    let run = |right_from_left: &RigidTransform, left_right: &[Vec<Match>]| {
        stereo_odometry(
            &left.input,
            &right.input.images,
            left_right,
            right_from_left,
            &Camera::pinhole(intrinsics(), 640, 480),
            &OdometryOptions::default(),
            &mut (),
        )
    };
    let result = run(&right_from_left, &left_right).expect("a path");
    assert!(result.lost.is_empty());
    // No alignment: the frame is that of the first camera, the unit is the meter.
    for (got, want) in result.world_from_cam.iter().zip(&left.cameras) {
        let got = got.expect("a pose").translation.vector;
        let error = (got - want.center_in_world().coords).norm();
        assert!(error < 0.05, "{error}");
    }
    assert!(matches!(
        run(&right_from_left, &left_right[1..]),
        Err(Error::SizeMismatch { .. })
    ));
    assert!(matches!(
        run(&RigidTransform::identity(), &left_right),
        Err(Error::Degenerate { .. })
    ));
}

#[test]
fn a_camera_that_only_rotates_has_no_path() {
    let cameras = (0..6)
        .map(|i| PosedCamera {
            camera: Camera::pinhole(intrinsics(), 640, 480),
            cam_from_world: RigidTransform::new(
                Vector3::zeros(),
                Vector3::new(0.0, 0.02 * f64::from(i), 0.0),
            ),
        })
        .collect();
    let points = ball(200, Point3::new(0.0, 0.0, 6.0), 34);
    let making = Making {
        noise_px: 0.1,
        ..Making::default()
    };
    let world = observe(cameras, &points, making, 35);
    let result = monocular_odometry(&world.input, &OdometryOptions::default(), &mut ());
    assert!(
        matches!(result, Err(Error::Degenerate { .. })),
        "{result:?}"
    );
}
