//! The relative pose of cameras that know where down is.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{
    RelativePose, estimate_relative_pose, estimate_relative_pose_with_gravity,
};
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

struct Scene {
    motion: RigidTransform,
    k: Intrinsics,
    gravity: [Vector3<f64>; 2],
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
}

fn direction(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.normal()).normalize()
}

/// * `tilt_rad`: by how much gravity is off, in each camera
fn scene(seed: u64, noise_px: f64, wrong: f64, tilt_rad: f64) -> Scene {
    let mut random = Random::new(seed);
    let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0).unwrap();
    let motion = RigidTransform::new(direction(&mut random), 0.2 * direction(&mut random));
    let (mut p1, mut p2) = (Vec::new(), Vec::new());
    while p1.len() < 150 {
        let mut any = |size: f64| random.uniform(-size, size);
        let x = Point3::new(any(3.0), any(2.0), 6.0 + any(2.5));
        let (Ok(a), Ok(b)) = (k.project(&x), k.project(&(motion * x))) else {
            continue;
        };
        let mut moved = |p: Point2<f64>| {
            Point2::new(
                p.x + noise_px * random.normal(),
                p.y + noise_px * random.normal(),
            )
        };
        let (a, mut b) = (moved(a), moved(b));
        if random.uniform(0.0, 1.0) < wrong {
            b = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        }
        p1.push(a);
        p2.push(b);
    }
    let down = Vector3::new(0.1, 1.0, -0.2).normalize();
    let mut off =
        |g: Vector3<f64>| UnitQuaternion::from_scaled_axis(direction(&mut random) * tilt_rad) * g;
    let gravity = [off(down), off(motion.rotation * down)];
    Scene {
        motion,
        k,
        gravity,
        p1,
        p2,
    }
}

/// The larger of the errors of rotation and of direction, radians.
fn error(scene: &Scene, pose: &RelativePose) -> f64 {
    let found = pose.cam2_from_cam1();
    let angle = found.rotation.angle_to(&scene.motion.rotation);
    angle.max(
        found
            .translation
            .vector
            .angle(&scene.motion.translation.vector),
    )
}

fn medians(noise_px: f64, wrong: f64, tilt_rad: f64, max_error_px: f64) -> (f64, f64, usize) {
    let (mut with, mut without, mut samples) = (Vec::new(), Vec::new(), 0);
    for seed in 0..60 {
        let s = scene(seed, noise_px, wrong, tilt_rad);
        let options = RansacOptions::default()
            .with_max_error_px(max_error_px)
            .with_seed(seed);
        let [g1, g2] = &s.gravity;
        let report = estimate_relative_pose_with_gravity(
            &s.p1,
            &s.p2,
            [&Camera::pinhole(s.k, 640, 480); 2],
            [g1, g2],
            &options,
            &mut (),
        )
        .unwrap();
        with.push(error(&s, &report.model));
        samples += report.iterations;
        // The rotation maps one gravity direction exactly to the other.
        let rotated_gravity = report.model.rotation * g1;
        assert!(
            rotated_gravity.angle(g2) < 1e-6,
            "{}",
            rotated_gravity.angle(g2)
        );
        let free = estimate_relative_pose(
            &s.p1,
            &s.p2,
            [&Camera::pinhole(s.k, 640, 480); 2],
            &options,
            &mut (),
        )
        .unwrap();
        without.push(error(&s, &free.model));
    }
    for list in [&mut with, &mut without] {
        list.sort_by(f64::total_cmp);
    }
    println!(
        "{noise_px} px, {wrong} wrong, gravity off by {tilt_rad}: {:.5} rad, {:.5} without, {samples} samples",
        with[30], without[30]
    );
    (with[30], without[30], samples)
}

#[test]
fn exact_gravity_is_a_help() {
    for wrong in [0.3, 0.6] {
        let (with, without, _) = medians(0.5, wrong, 0.0, 2.0);
        assert!(with < without && with < 0.01, "{with} {without}");
    }
}

#[test]
fn gravity_that_is_a_little_off_moves_the_pose_a_little() {
    // Half a degree in each camera, which is six pixels.
    let (with, _, _) = medians(0.5, 0.3, 0.0087, 6.0);
    assert!(with < 0.05, "{with}");
}

#[test]
fn exact_matches_give_the_truth() {
    for seed in 0..30 {
        let s = scene(seed, 0.0, 0.5, 0.0);
        let [g1, g2] = &s.gravity;
        // A wrong match within the threshold by chance is off by a hundredth of a pixel at most.
        let options = RansacOptions::default()
            .with_max_error_px(0.01)
            .with_seed(seed);
        let report = estimate_relative_pose_with_gravity(
            &s.p1,
            &s.p2,
            [&Camera::pinhole(s.k, 640, 480); 2],
            [g1, g2],
            &options,
            &mut (),
        )
        .unwrap();
        assert!(
            error(&s, &report.model) < 1e-5,
            "{}",
            error(&s, &report.model)
        );
    }
}

#[test]
fn bad_input_is_refused() {
    let s = scene(1, 0.5, 0.0, 0.0);
    let run = |n: usize, m: usize, gravity: &Vector3<f64>| {
        let options = RansacOptions::default();
        estimate_relative_pose_with_gravity(
            &s.p1[..n],
            &s.p2[..m],
            [&Camera::pinhole(s.k, 640, 480); 2],
            [gravity, &s.gravity[1]],
            &options,
            &mut (),
        )
    };
    let down = s.gravity[0];
    assert!(run(150, 150, &down).is_ok());
    assert!(matches!(run(4, 4, &down), Err(Error::TooFew { .. })));
    assert!(matches!(
        run(150, 149, &down),
        Err(Error::SizeMismatch { .. })
    ));
    for nowhere in [
        Vector3::zeros(),
        Vector3::new(f64::NAN, 1.0, 0.0),
        Vector3::new(0.0, f64::INFINITY, 0.0),
    ] {
        assert!(
            matches!(run(150, 150, &nowhere), Err(Error::Degenerate { .. })),
            "{nowhere}"
        );
    }
    // A camera that only rotated gives any direction or an error, but never NaN.
    let rotated: Vec<_> = (s.p1.iter())
        .map(|p| {
            s.k.project(&Point3::from(s.motion.rotation * s.k.ray(p)))
                .unwrap()
        })
        .collect();
    let options = RansacOptions::default();
    let rotation_only = estimate_relative_pose_with_gravity(
        &s.p1,
        &rotated,
        [&Camera::pinhole(s.k, 640, 480); 2],
        [&down, &s.gravity[1]],
        &options,
        &mut (),
    );
    if let Ok(report) = rotation_only {
        assert!(report.model.rotation.iter().all(|x| x.is_finite()));
    }
}
