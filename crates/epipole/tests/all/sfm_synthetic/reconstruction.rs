//! Reconstructions against the ground truth.

use super::world::{Making, World, arc, ball, errors, observe, run};
use epipole::camera::{Camera, Distortion, Intrinsics};
use epipole::math::random::Random;
use epipole::sfm::{
    PositionPrior, Reconstruction, SfmInput, SfmOptions, WhyUnregistered, reconstruct,
    why_unregistered,
};
use nalgebra::{Point3, Similarity3, Vector3};

fn centered(focal_px: f64) -> Camera {
    let intrinsics = Intrinsics::centered(focal_px, 640, 480).expect("intrinsics");
    Camera::pinhole(intrinsics, 640, 480)
}

#[test]
fn exact_chained_matches_give_the_exact_cameras() {
    let making = Making {
        reach: 1,
        ..Making::default()
    };
    let world = observe(
        arc(7, Point3::origin()),
        &ball(150, Point3::origin(), 1),
        making,
        2,
    );
    let result = run(&world, &SfmOptions::default());
    assert_eq!(result.components.len(), 1);
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 7);
    let (distance, angle_deg) = errors(&world, &first.cameras);
    assert!(
        distance < 1e-4 && angle_deg < 0.01,
        "{distance} {angle_deg}"
    );
    assert!(first.mean_reprojection_px(&world.input.images) < 1e-4);
    // Chained matches still make tracks across all photographs.
    let observations: usize = world.input.images.iter().map(|i| i.keypoints.len()).sum();
    assert!(first.num_observations() * 50 >= observations * 49);
    assert!(
        first
            .points
            .iter()
            .all(|p| p.color[1] == 7 && p.color[2] == 9)
    );
}

#[test]
fn noise_and_wrong_matches_cost_little() {
    let making = Making {
        noise_px: 0.5,
        wrong: 0.25,
        ..Making::default()
    };
    let world = observe(
        arc(8, Point3::origin()),
        &ball(400, Point3::origin(), 3),
        making,
        4,
    );
    let result = run(&world, &SfmOptions::default());
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 8);
    let (distance, angle_deg) = errors(&world, &first.cameras);
    assert!(distance < 0.1 && angle_deg < 0.1, "{distance} {angle_deg}");
    let mean = first.mean_reprojection_px(&world.input.images);
    // The mean length of a normal error of 0.5 px in each coordinate is 0.63 px.
    assert!(mean > 0.5 && mean < 0.65, "{mean}");
    assert_eq!(
        run(&world, &SfmOptions::default()),
        result,
        "the same seed, the same bits"
    );
}

#[test]
fn focal_length_and_distortion_are_found() {
    let distortion = Distortion {
        k1: -0.12,
        k2: 0.03,
        ..Distortion::NONE
    };
    let making = Making {
        noise_px: 0.1,
        distortion,
        ..Making::default()
    };
    let mut world = observe(
        arc(8, Point3::origin()),
        &ball(250, Point3::origin(), 5),
        making,
        6,
    );
    world.input.cameras = vec![centered(730.0)];
    let options = SfmOptions::default()
        .with_refine_focal(true)
        .with_refine_distortion(true);
    let result = run(&world, &options);
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 8);
    let focal_px = first.cameras[3]
        .expect("a camera")
        .camera
        .intrinsics
        .fu_px();
    assert!((focal_px - 700.0).abs() < 3.0, "{focal_px}");
    let k1 = first.cameras[3]
        .expect("a camera")
        .camera
        .lens
        .coefficients()[0];
    assert!((k1 + 0.12).abs() < 0.02, "{k1}");
}

/// Two cameras of one make are nothing alike: a focal length and a distortion of each.
#[test]
fn each_lens_has_its_own_focal_length_and_distortion() {
    let lenses = [(700.0, -0.12), (640.0, 0.08)];
    // Every image shows everything.
    let points: Vec<Point3<f64>> = (ball(250, Point3::origin(), 5).into_iter())
        .map(|point| point * 0.8)
        .collect();
    let mut world = World {
        cameras: arc(10, Point3::origin()),
        input: SfmInput::default(),
    };
    for (lens, (focal_px, k1)) in lenses.into_iter().enumerate() {
        // All cameras with this lens; half of them are used.
        let mut cameras = arc(10, Point3::origin());
        for camera in &mut cameras {
            camera.camera.intrinsics =
                Intrinsics::centered(focal_px, 640, 480).expect("intrinsics");
        }
        let making = Making {
            distortion: Distortion {
                k1,
                ..Distortion::NONE
            },
            ..Making::default()
        };
        let taken = observe(cameras, &points, making, 6).input;
        if lens == 0 {
            world.input = taken;
        } else {
            for image in (1..10).step_by(2) {
                // The same keypoints in the same order, or matches would be wrong.
                assert_eq!(
                    world.input.images[image].keypoints.len(),
                    taken.images[image].keypoints.len()
                );
                world.input.images[image].clone_from(&taken.images[image]);
                world.input.images[image].lens = 7;
            }
        }
    }
    world.input.cameras = (0..10)
        .map(|image| centered([730.0, 620.0][image % 2]))
        .collect();
    let options = SfmOptions::default()
        .with_refine_focal(true)
        .with_refine_distortion(true);
    let result = run(&world, &options);
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 10);
    for image in 0..10 {
        let (focal_px, k1) = lenses[image % 2];
        let camera = first.cameras[image].expect("a camera").camera;
        let found_px = camera.intrinsics.fu_px();
        assert!((found_px - focal_px).abs() < 0.5, "{image}: {found_px}");
        let found = camera.lens.coefficients()[0];
        assert!((found - k1).abs() < 0.005, "{image}: {found}");
    }
    assert!(first.mean_reprojection_px(&world.input.images) < 0.01);
    // The cameras of a bundle know their lens, too.
    let (bundle, images) = first.to_bundle(&world.input.images);
    assert_eq!(images.len(), 10);
    assert_eq!(bundle.lens_of_camera, [0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
    assert!((0..bundle.observations.len()).all(|index| bundle.residual_px(index).norm() < 0.1));
}

/// Positions in meters, a few centimeters off, and one that is wrong: the result is in their frame.
#[test]
fn known_positions_place_the_result() {
    let making = Making {
        noise_px: 0.3,
        ..Making::default()
    };
    let mut world = observe(
        arc(9, Point3::origin()),
        &ball(250, Point3::origin(), 5),
        making,
        6,
    );
    // A world frame of its own: rotated, five times as large, and far away.
    let world_from_ball = Similarity3::new(
        Vector3::new(2000.0, -300.0, 40.0),
        Vector3::new(0.4, 0.7, -0.2),
        5.0,
    );
    let mut random = Random::new(4);
    let truth: Vec<Point3<f64>> = (world.cameras.iter())
        .map(|camera| world_from_ball * camera.center_in_world())
        .collect();
    for (image, center) in world.input.images.iter_mut().zip(&truth) {
        let noise = Vector3::from_fn(|_, _| 0.05 * random.normal());
        image.position = Some(PositionPrior {
            center_in_world: center + noise,
            sigma: Vector3::repeat(0.05),
        });
    }
    if let Some(wrong) = &mut world.input.images[4].position {
        wrong.center_in_world.y += 30.0;
    }
    world.input.images[6].position = None;
    let placed = run(&world, &SfmOptions::default());
    let first = &placed.components[0];
    assert!(first.is_placed && first.num_registered() == 9);
    let off = |found: &Reconstruction| -> f64 {
        let off = found.cameras.iter().zip(&truth);
        off.map(|(camera, center)| (camera.expect("a camera").center_in_world() - center).norm())
            .fold(0.0, f64::max)
    };
    let worst = off(first);
    assert!(worst < 0.1, "{worst}");
    // Without them the frame is arbitrary, and two do not determine it.
    for image in world.input.images.iter_mut().skip(2) {
        image.position = None;
    }
    let anywhere = &run(&world, &SfmOptions::default()).components[0];
    assert!(!anywhere.is_placed && off(anywhere) > 1000.0);
    for sigma in [0.0, f64::NAN] {
        if let Some(position) = &mut world.input.images[1].position {
            position.sigma.y = sigma;
        }
        assert!(reconstruct(&world.input, &SfmOptions::default(), &mut ()).is_err());
    }
}

#[test]
fn points_that_few_saw_can_be_left_out() {
    let center = Point3::origin();
    let world = observe(
        arc(6, center),
        &ball(150, center, 5),
        Making {
            wrong: 0.3,
            noise_px: 0.5,
            reach: 2,
            ..Making::default()
        },
        5,
    );
    let shortest = |min_track_length| {
        let options = SfmOptions::default().with_min_track_length(min_track_length);
        let result = run(&world, &options);
        let first = &result.components[0];
        assert_eq!(first.num_registered(), 6);
        let lengths = first.points.iter().map(|point| point.track.len());
        (lengths.min().unwrap_or(0), first.points.len())
    };
    let (all, some) = (shortest(2), shortest(4));
    assert!(all.0 < 4 && some.0 >= 4, "{all:?} {some:?}");
    assert!(some.1 < all.1 && some.1 > 50, "{all:?} {some:?}");
}

/// If nothing is left of any start, the reconstruction ends and gives the reason.
#[test]
fn too_few_cameras_per_point_leave_nothing() {
    let center = Point3::origin();
    let world = observe(arc(4, center), &ball(150, center, 5), Making::default(), 5);
    let options = SfmOptions::default().with_min_track_length(5);
    let result = run(&world, &options);
    assert!(result.components.is_empty());
    assert_eq!(result.unregistered, [0, 1, 2, 3]);
    let why = why_unregistered(&world.input, &options, &result, &mut ()).unwrap();
    assert_eq!(why, [WhyUnregistered::NoStart; 4]);
}

#[test]
fn what_does_not_connect_makes_components() {
    let (here, there) = (Point3::origin(), Point3::new(100.0, 0.0, 0.0));
    let mut cameras = arc(5, here);
    cameras.extend(arc(4, there));
    // One more sees nothing that another sees.
    let nowhere = Point3::new(0.0, 0.0, 300.0);
    cameras.extend(arc(1, nowhere));
    let mut points = ball(120, here, 7);
    points.extend(ball(120, there, 8));
    points.extend(ball(50, nowhere, 9));
    let world = observe(cameras, &points, Making::default(), 10);
    let result = run(&world, &SfmOptions::default());
    let sizes: Vec<_> = result
        .components
        .iter()
        .map(|c| c.num_registered())
        .collect();
    assert_eq!(sizes, [5, 4]);
    assert_eq!(result.unregistered, [9]);
    for component in &result.components {
        let (distance, _) = errors(&world, &component.cameras);
        assert!(distance < 1e-4, "{distance}");
    }
}
