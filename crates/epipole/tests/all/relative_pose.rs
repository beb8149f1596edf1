//! Relative poses among many wrong matches: points behind a camera support none, and a plane's
//! other motion is not taken for the true one.

use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{RelativePose, refine_relative_pose};
use epipole::estimate_relative_pose;
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::robust::RansacOptions;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

struct Scene {
    k: Intrinsics,
    motion: RigidTransform,
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
    is_true: Vec<bool>,
}

/// Points two to eight units away, some of them on a plane five units away, and wrong matches
/// anywhere.
fn scene(
    random: &mut Random,
    t: Vector3<f64>,
    [num_on_plane, num_elsewhere, num_wrong]: [usize; 3],
    noise_px: f64,
) -> Scene {
    let k = Intrinsics::new(800.0, 800.0, 500.0, 400.0).unwrap();
    let rotation_vector = Vector3::from_fn(|_, _| 0.1 * random.normal());
    let motion =
        RigidTransform::from_parts(t.into(), UnitQuaternion::from_scaled_axis(rotation_vector));
    let normal = Vector3::new(0.2, 0.1, -1.0).normalize();
    let mut found = Scene {
        k,
        motion,
        p1: Vec::new(),
        p2: Vec::new(),
        is_true: Vec::new(),
    };
    let num_true = num_on_plane + num_elsewhere;
    while found.p1.len() < num_true + num_wrong {
        let (u, v) = (random.uniform(0.0, 1000.0), random.uniform(0.0, 800.0));
        let pixel = Point2::new(u, v);
        let is_true = found.p1.len() < num_true;
        let other = if is_true {
            let ray = k.ray(&pixel);
            let depth = if found.p1.len() < num_on_plane {
                -5.0 / normal.dot(&ray)
            } else {
                random.uniform(2.0, 8.0)
            };
            let in_cam2 = motion * Point3::from(ray * depth);
            match k.project(&in_cam2) {
                Ok(q) if (0.0..1000.0).contains(&q.x) && (0.0..800.0).contains(&q.y) => q,
                _ => continue,
            }
        } else {
            Point2::new(random.uniform(0.0, 1000.0), random.uniform(0.0, 800.0))
        };
        let mut noisy = |p: Point2<f64>| {
            let size = if is_true { noise_px } else { 0.0 };
            Point2::new(p.x + size * random.normal(), p.y + size * random.normal())
        };
        found.p1.push(noisy(pixel));
        found.p2.push(noisy(other));
        found.is_true.push(is_true);
    }
    found
}

/// The larger one of the errors of rotation and direction.
fn error_deg(pose: &RelativePose, motion: &RigidTransform) -> f64 {
    let found = pose.cam2_from_cam1();
    let angle = found.rotation.angle_to(&motion.rotation);
    angle
        .max(pose.direction.angle(&motion.translation.vector))
        .to_degrees()
}

impl Scene {
    fn estimate(&self, seed: u64) -> epipole::robust::RansacReport<RelativePose> {
        let options = RansacOptions::default()
            .with_max_error_px(1.5)
            .with_seed(seed);
        estimate_relative_pose(
            &self.p1,
            &self.p2,
            [&Camera::pinhole(self.k, 640, 480); 2],
            &options,
            &mut (),
        )
        .unwrap()
    }

    /// Least-squares fit to the right matches alone, from the given pose.
    fn by_the_true_ones(&self, start: &RelativePose) -> RelativePose {
        let only = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let inliers = pixels.iter().zip(&self.is_true).filter(|(_, is)| **is);
            inliers.map(|(pixel, _)| *pixel).collect()
        };
        let (p1, p2) = (only(&self.p1), only(&self.p2));
        refine_relative_pose(
            start,
            &p1,
            &p2,
            [&Camera::pinhole(self.k, 640, 480); 2],
            RobustLoss::Trivial,
        )
        .unwrap()
    }
}

/// Half of the matches are wrong. Where the camera drives forward, many of the wrong ones near to
/// their lines move towards the epipole, which nothing in front of the cameras does.
#[test]
fn what_is_behind_a_camera_supports_no_pose() {
    let (mut ours, mut best, mut wrong) = (0.0, 0.0, 0);
    const NUM_SCENES: usize = 30;
    for seed in 0..NUM_SCENES as u64 {
        let mut random = Random::new(seed);
        let t = Vector3::new(0.03 * random.normal(), 0.03 * random.normal(), -0.6);
        let s = scene(&mut random, t, [0, 500, 500], 0.5);
        let report = s.estimate(seed);
        ours += error_deg(&report.model, &s.motion);
        best += error_deg(&s.by_the_true_ones(&report.model), &s.motion);
        for i in (0..s.p1.len()).filter(|&i| report.inliers[i]) {
            wrong += usize::from(!s.is_true[i]);
            // a + d b = −t up to noise: b is rotated from a towards t, unless both are the same.
            let a = (report.model.rotation * s.k.ray(&s.p1[i])).normalize();
            let b = s.k.ray(&s.p2[i]).normalize();
            let t = report.model.direction;
            let slack = 2.0 * 1.5 / 800.0;
            assert!(
                (b - a * a.dot(&b)).dot(&(t - a * a.dot(&t))) > -slack,
                "{seed}: {i}"
            );
        }
    }
    // Least squares cannot know which matches are right.
    assert!(ours < 1.3 * best, "{ours} {best}");
    assert!(wrong < 2 * NUM_SCENES, "{wrong} wrong matches");
}

/// 95 % of the true matches lie on a plane, which allows two motions; the others decide.
#[test]
fn a_plane_does_not_hide_the_motion() {
    for (counts, noise_px) in [
        ([475, 25, 500], 0.5),
        ([285, 15, 100], 0.3),
        ([285, 15, 300], 0.5),
    ] {
        let mut wrong = Vec::new();
        for seed in 0..30 {
            let mut random = Random::new(seed);
            let t = Vector3::from_fn(|_, _| random.normal()).normalize() * 0.6;
            let s = scene(&mut random, t, counts, noise_px);
            let error = error_deg(&s.estimate(seed).model, &s.motion);
            if error > 5.0 {
                wrong.push((seed, error));
            }
        }
        assert!(wrong.is_empty(), "{counts:?} {noise_px}: {wrong:?}");
    }
}

/// A motion so small that a wrong rotation can account for the parallax of most points, with the
/// direction reversed.
#[test]
fn a_small_step_is_not_reversed() {
    for seed in 0..30 {
        let mut random = Random::new(seed);
        let t = Vector3::from_fn(|_, _| random.normal()).normalize() * 0.03;
        let s = scene(&mut random, t, [0, 500, 500], 0.5);
        let error = error_deg(&s.estimate(seed).model, &s.motion);
        assert!(error < 15.0, "{seed}: {error}");
    }
}
