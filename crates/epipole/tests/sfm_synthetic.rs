//! Structure from motion and odometry on made worlds, where the truth is known.

use epipole::Error;
use epipole::camera::{Camera, Distortion, Intrinsics, RigidTransform, look_at};
use epipole::math::random::Random;
use epipole::progress::{Stage, Status};
use epipole::sfm::{
    AlignmentKind, OdometryOptions, PairMatches, PositionPrior, Reconstruction, SfmImage, SfmInput,
    SfmOptions, SfmResult, SfmStep, WhyUnregistered, align_points, keep_going, monocular_odometry,
    reconstruct, reconstruct_with_progress, stereo_odometry, why_unregistered,
};
use nalgebra::{Point2, Point3, Similarity3, Vector3};
use std::ops::ControlFlow;

struct World {
    cameras: Vec<Camera>,
    input: SfmInput,
}

/// What the photographs are made like.
#[derive(Clone, Copy)]
struct Making {
    noise_px: f64,
    /// Share of matches that lead to another keypoint.
    wrong: f64,
    distortion: Distortion,
    /// Photographs are matched with so many after them.
    reach: usize,
}

impl Default for Making {
    fn default() -> Self {
        Self {
            noise_px: 0.0,
            wrong: 0.0,
            distortion: Distortion::NONE,
            reach: usize::MAX,
        }
    }
}

fn photograph(cameras: Vec<Camera>, points: &[Point3<f64>], making: Making, seed: u64) -> World {
    let mut random = Random::new(seed);
    let mut input = SfmInput {
        intrinsics: vec![cameras[0].intrinsics],
        ..SfmInput::default()
    };
    // The keypoint of each point in each picture.
    let mut keypoint_of = Vec::new();
    for (index, camera) in cameras.iter().enumerate() {
        let mut image = SfmImage {
            name: format!("{index}.png"),
            width: 640,
            height: 480,
            ..SfmImage::default()
        };
        let mut keypoints = vec![None; points.len()];
        for (n, point) in points.iter().enumerate() {
            let p = camera.cam_from_world * point;
            if p.z < 0.1 {
                continue;
            }
            let shown = making
                .distortion
                .distort(&Point2::new(p.x / p.z, p.y / p.z));
            let k = camera.intrinsics;
            let pixel = Point2::new(
                k.fu_px() * shown.x + k.principal_point().x + making.noise_px * random.normal(),
                k.fv_px() * shown.y + k.principal_point().y + making.noise_px * random.normal(),
            );
            if (0.0..639.0).contains(&pixel.x) && (0.0..479.0).contains(&pixel.y) {
                keypoints[n] = Some(image.keypoints.len() as u32);
                image.keypoints.push(pixel);
                image.colors.push([n as u8, 7, 9]);
            }
        }
        keypoint_of.push(keypoints);
        input.images.push(image);
    }
    for a in 0..cameras.len() {
        for b in a + 1
            ..cameras
                .len()
                .min(a.saturating_add(making.reach).saturating_add(1))
        {
            let mut matches = Vec::new();
            for n in 0..points.len() {
                if let (Some(i), Some(j)) = (keypoint_of[a][n], keypoint_of[b][n]) {
                    if random.unit() < making.wrong {
                        let other = random.below(input.images[b].keypoints.len()) as u32;
                        matches.push((i, other));
                    } else {
                        matches.push((i, j));
                    }
                }
            }
            input.pairs.push(PairMatches {
                image1: a,
                image2: b,
                matches,
            });
        }
    }
    World { cameras, input }
}

fn intrinsics() -> Intrinsics {
    Intrinsics::centered(700.0, 640, 480).expect("intrinsics")
}

fn ball(count: usize, center: Point3<f64>, seed: u64) -> Vec<Point3<f64>> {
    let mut random = Random::new(seed);
    let mut draw = || random.uniform(-1.2, 1.2);
    (0..count)
        .map(|_| center + Vector3::new(draw(), draw(), draw()))
        .collect()
}

/// Cameras on an arc around `center`.
fn arc(count: usize, center: Point3<f64>) -> Vec<Camera> {
    (0..count)
        .map(|i| {
            let (s, c) = libm::sincos(0.2 * i as f64);
            let eye = center + Vector3::new(5.0 * s, 0.3 * (i % 3) as f64, -5.0 * c);
            let up = Vector3::new(0.0, -1.0, 0.0);
            Camera {
                intrinsics: intrinsics(),
                cam_from_world: look_at(&eye, &center, &up).expect("a view"),
            }
        })
        .collect()
}

fn run(world: &World, options: &SfmOptions) -> SfmResult {
    reconstruct(&world.input, options, &mut keep_going).expect("a result")
}

/// Largest errors of centers and of rotations in degrees, after the best similarity.
fn errors(world: &World, cameras: &[Option<Camera>]) -> (f64, f64) {
    let (mut found, mut truth) = (Vec::new(), Vec::new());
    for (got, want) in cameras.iter().zip(&world.cameras) {
        if let Some(got) = got {
            found.push(*got);
            truth.push(*want);
        }
    }
    let centers =
        |list: &[Camera]| -> Vec<_> { list.iter().map(Camera::center_in_world).collect() };
    let align = align_points(
        &centers(&found),
        &centers(&truth),
        AlignmentKind::Similarity,
    )
    .expect("an alignment");
    let (mut distance, mut angle): (f64, f64) = (0.0, 0.0);
    for (got, want) in found.iter().zip(&truth) {
        let center = align * got.center_in_world();
        distance = distance.max((center - want.center_in_world()).norm());
        let turned = got.cam_from_world.rotation * align.isometry.rotation.inverse();
        angle = angle.max(turned.angle_to(&want.cam_from_world.rotation).to_degrees());
    }
    (distance, angle)
}

#[test]
fn exact_chained_matches_give_the_exact_cameras() {
    let making = Making {
        reach: 1,
        ..Making::default()
    };
    let world = photograph(
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
    let world = photograph(
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
    let mut world = photograph(
        arc(8, Point3::origin()),
        &ball(250, Point3::origin(), 5),
        making,
        6,
    );
    world.input.intrinsics = vec![Intrinsics::centered(730.0, 640, 480).expect("intrinsics")];
    let options = SfmOptions {
        refine_focal: true,
        refine_distortion: true,
        ..SfmOptions::default()
    };
    let result = run(&world, &options);
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 8);
    let focal_px = first.cameras[3].expect("a camera").intrinsics.fu_px();
    assert!((focal_px - 700.0).abs() < 3.0, "{focal_px}");
    let k1 = first.lens(3).coefficients()[0];
    assert!((k1 + 0.12).abs() < 0.02, "{k1}");
}

/// Two cameras of one make are nothing alike: a focal length and a distortion of each.
#[test]
fn each_lens_has_its_own_focal_length_and_distortion() {
    let lenses = [(700.0, -0.12), (640.0, 0.08)];
    // All of it is in every picture.
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
            camera.intrinsics = Intrinsics::centered(focal_px, 640, 480).expect("intrinsics");
        }
        let making = Making {
            distortion: Distortion {
                k1,
                ..Distortion::NONE
            },
            ..Making::default()
        };
        let taken = photograph(cameras, &points, making, 6).input;
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
    world.input.intrinsics = (0..10)
        .map(|image| Intrinsics::centered([730.0, 620.0][image % 2], 640, 480).expect("intrinsics"))
        .collect();
    let options = SfmOptions {
        refine_focal: true,
        refine_distortion: true,
        ..SfmOptions::default()
    };
    let result = run(&world, &options);
    let first = &result.components[0];
    assert_eq!(first.num_registered(), 10);
    for image in 0..10 {
        let (focal_px, k1) = lenses[image % 2];
        let found_px = first.cameras[image].expect("a camera").intrinsics.fu_px();
        assert!((found_px - focal_px).abs() < 0.5, "{image}: {found_px}");
        let found = first.lens(image).coefficients()[0];
        assert!((found - k1).abs() < 0.005, "{image}: {found}");
    }
    assert!(first.mean_reprojection_px(&world.input.images) < 0.01);
    // The cameras of a bundle know their lens, too.
    let (bundle, images) = first.to_bundle(&world.input.images);
    assert_eq!(images.len(), 10);
    assert_eq!(bundle.lens_of_camera, [0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
    assert!((0..bundle.observations.len()).all(|index| bundle.residual_px(index).norm() < 0.1));
}

/// Positions in meters, a few centimeters off, and one that is wrong: the result stands in their world.
#[test]
fn known_positions_place_the_result() {
    let making = Making {
        noise_px: 0.3,
        ..Making::default()
    };
    let mut world = photograph(
        arc(9, Point3::origin()),
        &ball(250, Point3::origin(), 5),
        making,
        6,
    );
    // A world of its own: turned, five times as large, and far away.
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
    // Without them it stands anywhere, and two do not tell where.
    for image in world.input.images.iter_mut().skip(2) {
        image.position = None;
    }
    let anywhere = &run(&world, &SfmOptions::default()).components[0];
    assert!(!anywhere.is_placed && off(anywhere) > 1000.0);
    for sigma in [0.0, f64::NAN] {
        if let Some(position) = &mut world.input.images[1].position {
            position.sigma.y = sigma;
        }
        assert!(reconstruct(&world.input, &SfmOptions::default(), &mut keep_going).is_err());
    }
}

#[test]
fn points_that_few_saw_can_be_left_out() {
    let center = Point3::origin();
    let world = photograph(
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
        let options = SfmOptions {
            min_track_length,
            ..SfmOptions::default()
        };
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

/// Where nothing is left of any start there is an end, and the reason.
#[test]
fn points_that_more_cameras_should_see_than_there_are_leave_nothing() {
    let center = Point3::origin();
    let world = photograph(arc(4, center), &ball(150, center, 5), Making::default(), 5);
    let options = SfmOptions {
        min_track_length: 5,
        ..SfmOptions::default()
    };
    let result = run(&world, &options);
    assert!(result.components.is_empty());
    assert_eq!(result.unregistered, [0, 1, 2, 3]);
    let why = why_unregistered(&world.input, &options, &result).unwrap();
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
    let world = photograph(cameras, &points, Making::default(), 10);
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

#[test]
fn a_watcher_sees_one_image_more_each_time_and_changes_nothing() {
    let center = Point3::new(0.0, 0.0, 6.0);
    let world = photograph(arc(7, center), &ball(150, center, 5), Making::default(), 5);
    let mut seen = Vec::new();
    let mut watcher = |so_far: epipole::sfm::Reconstruction| {
        assert!(
            so_far
                .points
                .iter()
                .all(|point| point.track.len() >= 2 && point.error_px.is_finite())
        );
        seen.push((so_far.num_registered(), so_far.points.len()));
    };
    let options = SfmOptions::default();
    let found =
        epipole::sfm::reconstruct_watched(&world.input, &options, &mut keep_going, &mut watcher);
    assert_eq!(found.expect("a result"), run(&world, &options));
    let registered: Vec<usize> = seen.iter().map(|(registered, _)| *registered).collect();
    assert_eq!(registered, [2, 3, 4, 5, 6, 7]);
    assert!(seen[0].1 > 20 && seen[5].1 >= seen[0].1, "{seen:?}");
}

#[test]
fn canceling_leaves_a_valid_part() {
    let world = photograph(
        arc(7, Point3::origin()),
        &ball(150, Point3::origin(), 11),
        Making::default(),
        12,
    );
    let mut stop = |step: &SfmStep| match step {
        SfmStep::Registered {
            num_registered: 4, ..
        } => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let result =
        reconstruct(&world.input, &SfmOptions::default(), &mut stop).expect("a partial result");
    assert!(result.canceled);
    assert_eq!(result.components[0].num_registered(), 4);
    assert_eq!(result.unregistered.len(), 3);
    let (distance, _) = errors(&world, &result.components[0].cameras);
    assert!(distance < 1e-3, "{distance}");
    // In the middle of an adjustment, too: the last step is the one that was stopped at.
    let (mut has_three, mut asked_after) = (false, 0);
    let mut stop = |step: &SfmStep| {
        let is_third = matches!(
            step,
            SfmStep::Registered {
                num_registered: 3,
                ..
            }
        );
        has_three |= is_third;
        if !has_three || is_third {
            return ControlFlow::Continue(());
        }
        asked_after += 1;
        assert!(matches!(step, SfmStep::Refined { .. }), "{step:?}");
        ControlFlow::Break(())
    };
    let result =
        reconstruct(&world.input, &SfmOptions::default(), &mut stop).expect("a partial result");
    assert!(result.canceled);
    assert_eq!(result.components[0].num_registered(), 4);
    assert_eq!(asked_after, 1);
    let (distance, _) = errors(&world, &result.components[0].cameras);
    assert!(distance < 0.01, "{distance}");
    let mut at_once = |_: &SfmStep| ControlFlow::Break(());
    let nothing =
        reconstruct(&world.input, &SfmOptions::default(), &mut at_once).expect("a result");
    assert!(nothing.canceled && nothing.components.is_empty());
}

#[test]
fn progress_names_stages_and_shares_that_rise() {
    let world = photograph(
        arc(5, Point3::origin()),
        &ball(120, Point3::origin(), 11),
        Making::default(),
        12,
    );
    let options = SfmOptions::default();
    let mut told: Vec<Status> = Vec::new();
    let mut watch = |status| {
        told.push(status);
        ControlFlow::Continue(())
    };
    let watched = reconstruct_with_progress(&world.input, &options, &mut watch);
    assert_eq!(watched.expect("a result"), run(&world, &options));
    assert!(told.is_sorted_by_key(|status| status.share));
    assert!(told[told.len() - 1].share == 1.0);
    for stage in [
        Stage::PairVerification,
        Stage::Registration,
        Stage::BundleAdjustment,
    ] {
        assert!(told.iter().any(|status| status.stage == stage), "{stage:?}");
    }
    let mut stop = |status: Status| match status.stage {
        Stage::PairVerification => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    let stopped = reconstruct_with_progress(&world.input, &options, &mut stop).expect("a part");
    assert!(stopped.canceled && stopped.components[0].num_registered() == 2);
}

#[test]
fn photographs_without_overlap_give_nothing_and_no_error() {
    let mut world = photograph(
        arc(3, Point3::origin()),
        &ball(80, Point3::origin(), 13),
        Making::default(),
        14,
    );
    world.input.pairs.clear();
    let result = run(&world, &SfmOptions::default());
    assert!(result.components.is_empty() && result.unregistered == [0, 1, 2]);
    // Matches that are all wrong, and photographs without keypoints.
    let making = Making {
        wrong: 1.0,
        ..Making::default()
    };
    let world = photograph(
        arc(3, Point3::origin()),
        &ball(80, Point3::origin(), 13),
        making,
        15,
    );
    run(&world, &SfmOptions::default());
    let mut empty = SfmInput {
        images: vec![SfmImage::default(); 3],
        intrinsics: vec![intrinsics()],
        pairs: Vec::new(),
    };
    empty.pairs.push(PairMatches {
        image1: 0,
        image2: 1,
        matches: Vec::new(),
    });
    let result =
        reconstruct(&empty, &SfmOptions::default(), &mut keep_going).expect("an empty result");
    assert_eq!(result.unregistered, [0, 1, 2]);
}

#[test]
fn bad_input_is_refused() {
    let world = photograph(
        arc(3, Point3::origin()),
        &ball(60, Point3::origin(), 16),
        Making::default(),
        17,
    );
    let attempt = |change: &dyn Fn(&mut SfmInput, &mut SfmOptions)| {
        let (mut input, mut options) = (world.input.clone(), SfmOptions::default());
        change(&mut input, &mut options);
        reconstruct(&input, &options, &mut keep_going)
    };
    assert!(matches!(
        attempt(&|i, _| i.images.truncate(1)),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.intrinsics.clear()),
        Err(Error::SizeMismatch { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.images[1].keypoints[3].x = f64::NAN),
        Err(Error::NotFinite { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.pairs[0].matches[0].1 = 9999),
        Err(Error::OutOfRange { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.pairs[0].image2 = 0),
        Err(Error::OutOfRange { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| {
            i.images[0].colors.pop();
        }),
        Err(Error::SizeMismatch { .. })
    ));
    for value in [0.0, -1.0, f64::NAN] {
        let result = attempt(&|_, o| o.max_reprojection_error_px = value);
        assert!(matches!(result, Err(Error::OutOfRange { .. })));
    }
}

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
            let turn = Vector3::new(0.0, 0.01 * i as f64, 0.0);
            let world_from_cam =
                RigidTransform::new(Vector3::new(0.02 * along * along, 0.0, along), turn);
            Camera {
                intrinsics: intrinsics(),
                cam_from_world: world_from_cam.inverse(),
            }
        })
        .collect();
    (photograph(cameras, &points, making, 32), points)
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
    let result = monocular_odometry(&world.input, &OdometryOptions::default(), &mut keep_going)
        .expect("a path");
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
    let world = photograph(cameras.collect(), &points, making, 36);
    let result = monocular_odometry(&world.input, &OdometryOptions::default(), &mut keep_going)
        .expect("a path");
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
            let turned = got.cam_from_world.rotation;
            turned.angle_to(&want.cam_from_world.rotation).to_degrees()
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
    let right_cameras: Vec<Camera> = left
        .cameras
        .iter()
        .map(|camera| Camera {
            cam_from_world: right_from_left * camera.cam_from_world,
            ..*camera
        })
        .collect();
    let right = photograph(right_cameras, &points, making, 33);
    // Points carry their number in a color; that is how the test matches left and right.
    let left_right: Vec<Vec<(u32, u32)>> = left
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
                        matches.push((i as u32, j as u32));
                        break;
                    }
                }
            }
            matches
        })
        .collect();
    let run = |right_from_left: &RigidTransform, left_right: &[Vec<(u32, u32)>]| {
        stereo_odometry(
            &left.input,
            &right.input.images,
            left_right,
            right_from_left,
            &intrinsics(),
            &OdometryOptions::default(),
            &mut keep_going,
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
fn a_camera_that_only_turns_has_no_path() {
    let cameras = (0..6)
        .map(|i| Camera {
            intrinsics: intrinsics(),
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
    let world = photograph(cameras, &points, making, 35);
    let result = monocular_odometry(&world.input, &OdometryOptions::default(), &mut keep_going);
    assert!(
        matches!(result, Err(Error::Degenerate { .. })),
        "{result:?}"
    );
}
