//! Reconstruction through lenses that no pinhole camera approximates, against exact truth.

use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform};
use epipole::feature::Match;
use epipole::math::random::Random;
use epipole::sfm::{
    AlignmentKind, BundleObservation, PairMatches, SfmImage, SfmInput, SfmOptions, SfmResult,
    VerifiedPair, adjust_bundle, align_points, reconstruct, verify_matches, why_unregistered,
};
use nalgebra::{Point2, Point3, Vector2, Vector3};

const SIZE: u32 = 1000;

struct World {
    cameras: Vec<PosedCamera>,
    input: SfmInput,
}

/// Parameters of a synthetic photograph.
#[derive(Clone, Copy)]
struct Making {
    lens: Lens,
    /// Points so far off the axis are seen, degrees.
    half_deg: f64,
    noise_px: f64,
    /// Share of matches that lead to another keypoint.
    wrong: f64,
    /// Distance between neighboring cameras.
    step: f64,
}

fn k() -> Intrinsics {
    Intrinsics::new(300.0, 302.0, 501.0, 497.0).unwrap()
}

fn lens(kind: LensKind) -> Lens {
    let numbers: &[f64] = match kind {
        LensKind::Brown => &[-0.05, 0.01, 0.001, -0.001, 0.0],
        LensKind::Rational => &[0.3, 0.05, 0.001, -0.001, 0.01, 0.5, 0.1, 0.005],
        LensKind::Fisheye => &[-0.03, 0.008, -0.003, 0.0004],
        LensKind::Division => &[-0.15],
    };
    Lens::from_coefficients(kind, numbers).unwrap()
}

fn camera_of(lens: Lens) -> Camera {
    Camera {
        lens,
        ..Camera::pinhole(k(), SIZE, SIZE)
    }
}

/// Cameras go through a hall whose walls, floor and ceiling are full of points, and look ahead,
/// more or less.
fn hall(count: usize, making: Making, seed: u64) -> World {
    let mut random = Random::new(seed);
    let points: Vec<Point3<f64>> = (0..900)
        .map(|n| {
            let mut p = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
            p[n % 3] = if p[n % 3] > 0.0 { 1.0 } else { -1.0 };
            Point3::new(4.0 * p.x, 2.5 * p.y, 6.0 * p.z)
        })
        .collect();
    let mut world = World {
        cameras: Vec::new(),
        input: SfmInput {
            cameras: vec![camera_of(making.lens)],
            ..SfmInput::default()
        },
    };
    let mut keypoint_of = Vec::new();
    for n in 0..count {
        let center = Vector3::new(0.4 * random.normal(), 0.2 * random.normal(), -3.0)
            + Vector3::z() * (n as f64);
        let rotation_vector = 0.15 * Vector3::from_fn(|_, _| random.normal());
        let rotation = RigidTransform::new(Vector3::zeros(), rotation_vector);
        let shift = -(rotation.rotation * (making.step * center));
        let camera = PosedCamera {
            camera: camera_of(making.lens),
            cam_from_world: RigidTransform::from_parts(shift.into(), rotation.rotation),
        };
        let mut image = SfmImage {
            name: format!("{n}.png"),
            ..SfmImage::default()
        };
        let mut keypoints = vec![None; points.len()];
        for (index, point) in points.iter().enumerate() {
            let p = (camera.cam_from_world * point).coords;
            if p.angle(&Vector3::z()) > making.half_deg.to_radians() {
                continue;
            }
            let Some(distorted) = making.lens.project(&p) else {
                continue;
            };
            let noise = Vector2::from_fn(|_, _| making.noise_px * random.normal());
            let pixel =
                Point2::new(300.0 * distorted.x + 501.0, 302.0 * distorted.y + 497.0) + noise;
            let inside = 0.0..f64::from(SIZE);
            if inside.contains(&pixel.x) && inside.contains(&pixel.y) {
                keypoints[index] = Some(image.keypoints.len() as u32);
                image.keypoints.push(pixel);
            }
        }
        keypoint_of.push(keypoints);
        world.cameras.push(camera);
        world.input.images.push(image);
    }
    for a in 0..count {
        for b in a + 1..count {
            let mut matches = Vec::new();
            for (i, j) in keypoint_of[a].iter().zip(&keypoint_of[b]) {
                if let (Some(i), Some(j)) = (i, j) {
                    let other = random.below(world.input.images[b].keypoints.len()) as u32;
                    let is_wrong = random.unit() < making.wrong;
                    let j = if is_wrong { other } else { *j };
                    matches.push(Match::new(*i as usize, j as usize));
                }
            }
            world.input.pairs.push(PairMatches {
                image1: a,
                image2: b,
                matches,
            });
        }
    }
    world
}

fn fisheye() -> Making {
    Making {
        lens: lens(LensKind::Fisheye),
        // The image corners are at 95°.
        half_deg: 95.0,
        noise_px: 0.3,
        wrong: 0.1,
        step: 1.0,
    }
}

fn run(world: &World, options: &SfmOptions) -> SfmResult {
    reconstruct(&world.input, options, &mut ()).unwrap()
}

/// Largest distance between true and found centers, after the best similarity.
fn off_centers(world: &World, result: &SfmResult) -> f64 {
    let found = &result.components[0];
    let pairs = found.cameras.iter().zip(&world.cameras);
    let (found, truth): (Vec<_>, Vec<_>) = pairs
        .filter_map(|(found, truth)| Some((found.as_ref()?, truth)))
        .map(|(found, truth)| (found.center_in_world(), truth.center_in_world()))
        .unzip();
    let to_from = align_points(&found, &truth, AlignmentKind::Similarity).unwrap();
    let off = found
        .iter()
        .zip(&truth)
        .map(|(found, truth)| (to_from * found - truth).norm());
    off.fold(0.0, f64::max)
}

#[test]
fn a_fisheye_of_190_degrees_is_reconstructed_to_its_border() {
    let world = hall(7, fisheye(), 1);
    let options = SfmOptions::default();
    let result = run(&world, &options);
    let found = &result.components[0];
    assert_eq!(found.num_registered(), 7);
    let off = off_centers(&world, &result);
    assert!(off < 0.01, "{off}");
    let mean_px = found.mean_reprojection_px(&world.input.images);
    // Of noise with 0.3 px along each axis the mean is 0.376 px.
    assert!((0.3..0.4).contains(&mean_px), "{mean_px}");
    // Points beside and behind the cameras are reconstructed, too.
    let behind = |element: &epipole::sfm::TrackElement, point: &Point3<f64>| {
        let camera = found.cameras[element.image as usize].unwrap();
        (camera.cam_from_world * point).z < 0.0
    };
    let num_behind = (found.points.iter())
        .flat_map(|point| point.track.iter().map(|element| (element, &point.position)))
        .filter(|(element, position)| behind(element, position))
        .count();
    assert!(num_behind > 20, "{num_behind}");
    // Each observation is where the lens shows its point.
    let (bundle, _) = found.to_bundle(&world.input.images);
    assert!(
        bundle
            .cameras
            .iter()
            .all(|c| c.camera.lens == lens(LensKind::Fisheye))
    );
    let largest = (0..bundle.observations.len()).map(|o| bundle.residual_px(o).norm());
    assert!(largest.fold(0.0, f64::max) < 4.5);
}

#[test]
fn focal_length_and_coefficients_are_found_from_a_wrong_start() {
    let mut world = hall(
        9,
        Making {
            wrong: 0.0,
            ..fisheye()
        },
        2,
    );
    world.input.cameras = vec![Camera {
        intrinsics: Intrinsics::new(306.0, 308.04, 501.0, 497.0).unwrap(),
        ..camera_of(Fisheye::default().into())
    }];
    let start = SfmOptions::default();
    let options = start
        .clone()
        .with_refine_focal(true)
        .with_refine_distortion(true);
    let result = run(&world, &options);
    let found = &result.components[0];
    assert_eq!(found.num_registered(), 9);
    let focal_px = found.cameras[4].unwrap().camera.intrinsics.fu_px();
    assert!((focal_px - 300.0).abs() < 0.5, "{focal_px}");
    // The coefficients compensate each other, so the rays are compared.
    let truth = lens(LensKind::Fisheye);
    for degrees in [20.0f64, 50.0, 80.0, 90.0] {
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        let ray = Vector3::new(sine, 0.0, cosine);
        let [found_px, true_px] = [
            (found.cameras[4].unwrap().camera.lens, focal_px),
            (truth, 300.0),
        ]
        .map(|(lens, focal_px)| focal_px * lens.project(&ray).unwrap().x);
        assert!(
            (found_px - true_px).abs() < 0.2,
            "{degrees}: {found_px} {true_px}"
        );
    }
    let off = off_centers(&world, &result);
    assert!(off < 0.02, "{off}");
    // Kept as they were, they do not fit.
    let from_known_lens = run(&world, &start);
    let worse = from_known_lens
        .components
        .first()
        .map_or(0, |found| found.num_observations());
    assert!(worse < found.num_observations(), "{worse}");
}

#[test]
fn rational_and_division_lenses_keep_errors_in_image_pixels() {
    for kind in [LensKind::Rational, LensKind::Division] {
        let making = Making {
            lens: lens(kind),
            half_deg: 60.0,
            ..fisheye()
        };
        let world = hall(6, making, 3);
        let result = run(&world, &SfmOptions::default());
        let found = &result.components[0];
        assert_eq!(found.num_registered(), 6, "{kind:?}");
        let off = off_centers(&world, &result);
        assert!(off < 0.02, "{kind:?} {off}");
        let mean_px = found.mean_reprojection_px(&world.input.images);
        assert!((0.3..0.4).contains(&mean_px), "{kind:?} {mean_px}");
    }
}

/// Two cameras of unlike lenses walk together.
#[test]
fn a_fisheye_and_a_usual_lens_share_a_world() {
    let making = Making {
        wrong: 0.0,
        noise_px: 0.0,
        ..fisheye()
    };
    let mut world = hall(6, making, 4);
    let (k, brown) = (k(), lens(LensKind::Brown));
    for image in world.input.images.iter_mut().step_by(2) {
        image.lens = 5;
        for pixel in &mut image.keypoints {
            let ray = lens(LensKind::Fisheye)
                .ray(&k.ray(pixel).xy().into())
                .unwrap();
            // Beyond 50° there is no projection; keypoints there are random.
            let distorted = brown
                .project(&ray)
                .filter(|_| ray.angle(&Vector3::z()) < 50f64.to_radians());
            let distorted = distorted.unwrap_or(Point2::new(pixel.y * 0.01, pixel.x * -0.01));
            *pixel = Point2::new(300.0 * distorted.x + 501.0, 302.0 * distorted.y + 497.0);
        }
    }
    world.input.cameras = (0..6)
        .map(|image| match image % 2 {
            0 => camera_of(brown),
            _ => camera_of(lens(LensKind::Fisheye)),
        })
        .collect();
    let result = run(&world, &SfmOptions::default());
    assert_eq!(result.components[0].num_registered(), 6);
    let off = off_centers(&world, &result);
    assert!(off < 0.01, "{off}");
    let kind = |image: usize| {
        result.components[0].cameras[image]
            .unwrap()
            .camera
            .lens
            .kind()
    };
    assert_eq!(kind(2), LensKind::Brown);
    assert_eq!(kind(3), LensKind::Fisheye);
}

#[test]
fn a_fisheye_that_only_rotated_begins_nothing() {
    let world = hall(
        2,
        Making {
            step: 0.0,
            wrong: 0.0,
            ..fisheye()
        },
        5,
    );
    let options = SfmOptions::default();
    let images = [&world.input.images[0], &world.input.images[1]];
    let pair = &world.input.pairs[0];
    let found = verify_matches(
        pair,
        images,
        [&world.input.cameras[0]; 2],
        &options,
        &mut (),
    )
    .unwrap();
    assert_eq!(found.map(|pair| pair.median_angle_rad), Some(0.0));
    let result = run(&world, &options);
    assert!(result.components.is_empty());
    let why = why_unregistered(&world.input, &options, &result, &mut ()).unwrap();
    assert!(
        why[0].to_string().contains("nearly the same position"),
        "{}",
        why[0]
    );
}

#[test]
fn lenses_that_mean_nothing_get_a_sentence_or_an_empty_result() {
    let mut world = hall(3, fisheye(), 6);
    let options = SfmOptions::default();
    let with = |coefficients| camera_of(Fisheye { coefficients }.into());
    for k in [f64::NAN, f64::NEG_INFINITY] {
        world.input.cameras = vec![with([0.0, 0.0, k, 0.0])];
        let refused = reconstruct(&world.input, &options, &mut ());
        let message = refused.unwrap_err().to_string();
        assert!(
            message.contains("every coefficient of the lens"),
            "{message}"
        );
        let images = [&world.input.images[0], &world.input.images[1]];
        let pair = &world.input.pairs[0];
        assert!(verify_matches(pair, images, [&with([k; 4]); 2], &options, &mut ()).is_err());
    }
    // It folds 7° off the axis: nearly all keypoints have no ray.
    world.input.cameras = vec![with([-20.0, 0.0, 0.0, 0.0])];
    let folded = run(&world, &options);
    assert!(folded.components.is_empty() && folded.unregistered == [0, 1, 2]);
    // Numbers beyond all bounds.
    for coefficients in [[1e300; 4], [-1e300, 1e300, -1e300, 1e300]] {
        world.input.cameras = vec![with(coefficients)];
        let found = run(&world, &options);
        let cameras = found
            .components
            .iter()
            .flat_map(|c| c.cameras.iter().flatten());
        assert!(
            cameras
                .into_iter()
                .all(|c| c.center_in_world().iter().all(|x| x.is_finite()))
        );
    }
}

/// A bundle whose points are all behind an ordinary lens gives an error or a result.
#[test]
fn points_behind_a_lens_are_mirrored_or_refused() {
    let world = hall(3, fisheye(), 7);
    let options = SfmOptions::default();
    let result = run(&world, &options);
    let (bundle, _) = result.components[0].to_bundle(&world.input.images);
    for kind in [LensKind::Brown, LensKind::Division, LensKind::Rational] {
        let mut wrong = bundle.clone();
        for camera in &mut wrong.cameras {
            camera.camera.lens = lens(kind);
        }
        let observations: Vec<BundleObservation> = wrong.observations.clone();
        assert!(!observations.is_empty());
        if let Ok(report) = adjust_bundle(&mut wrong, &Default::default(), &mut ()) {
            assert!(report.final_cost.is_finite());
        }
        assert!(wrong.points.iter().all(|p| p.iter().all(|x| x.is_finite())));
    }
}

/// Verifies a pair of photographs of random points, on a plane or with depth.
fn pair_of(making: Making, half_deg: f64, motion: &RigidTransform, is_wall: bool) -> VerifiedPair {
    let mut random = Random::new(12);
    // A narrow field of view comes from a long lens.
    let zoom = 45.0 / half_deg;
    let k = k().zoomed(zoom).unwrap();
    let reach = 3.0 * libm::tan(half_deg.to_radians().min(1.2));
    let mut images = [0, 1].map(|n| SfmImage {
        name: format!("{n}.png"),
        ..SfmImage::default()
    });
    while images[0].keypoints.len() < 300 {
        let aside = [(); 2].map(|()| random.uniform(-reach, reach));
        // Straight ahead, through a long lens, a step before a wall cannot be distinguished from a
        // rotation.
        let depth = match is_wall {
            true => 3.0 + 0.5 * aside[0],
            false => random.uniform(2.5, 6.0),
        };
        let x = Point3::new(aside[0], aside[1], depth);
        let distorted = [x, motion * x].map(|x| {
            let distorted = making.lens.project(&x.coords)?;
            let noise = Vector2::from_fn(|_, _| making.noise_px * random.normal());
            let center = k.principal_point();
            let pixel = Point2::new(
                k.fu_px() * distorted.x + center.x,
                k.fv_px() * distorted.y + center.y,
            );
            let is_inside = pixel.iter().all(|x| (0.0..f64::from(SIZE)).contains(x));
            is_inside.then_some(pixel + noise)
        });
        if let [Some(one), Some(two)] = distorted {
            images[0].keypoints.push(one);
            images[1].keypoints.push(two);
        }
    }
    let pair = PairMatches {
        image1: 0,
        image2: 1,
        matches: (0..300).map(|i| Match::new(i, i)).collect(),
    };
    let camera = Camera {
        intrinsics: k,
        ..camera_of(making.lens)
    };
    let options = SfmOptions::default();
    let found = verify_matches(
        &pair,
        [&images[0], &images[1]],
        [&camera; 2],
        &options,
        &mut (),
    );
    found.unwrap().unwrap()
}

/// Narrow lenses of every model pass the same checks as pinhole cameras, and so do wide ones.
#[test]
fn planes_and_rotations_are_distinguished_from_depth_through_every_lens() {
    let rotation_vector = Vector3::new(0.04, -0.06, 0.03);
    let step = RigidTransform::new(Vector3::new(-0.4, 0.1, 0.1), rotation_vector);
    let still = RigidTransform::rotation(rotation_vector);
    for (kind, half_deg) in [
        (LensKind::Brown, 15.0),
        (LensKind::Division, 15.0),
        (LensKind::Rational, 15.0),
        (LensKind::Division, 45.0),
        (LensKind::Fisheye, 60.0),
    ] {
        let making = Making {
            lens: lens(kind),
            ..fisheye()
        };
        let classified = |motion, is_wall| pair_of(making, half_deg, motion, is_wall);
        let deep = classified(&step, false);
        assert!(
            !deep.is_flat && deep.median_angle_rad > 0.02,
            "{kind:?} {half_deg} {:?}",
            (deep.is_flat, deep.median_angle_rad)
        );
        // A plane alone does not determine which of two motions is right, but it does show a
        // motion.
        let wall = classified(&step, true);
        assert!(
            wall.is_flat && wall.median_angle_rad > 0.0,
            "{kind:?} {half_deg} {:?}",
            (wall.is_flat, wall.median_angle_rad)
        );
        let rotated = classified(&still, false);
        assert!(
            rotated.is_flat && rotated.median_angle_rad == 0.0,
            "{kind:?} {half_deg} {:?}",
            (rotated.is_flat, rotated.median_angle_rad)
        );
    }
}
