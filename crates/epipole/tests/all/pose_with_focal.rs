//! The motion and the focal length that two cameras share, from matches of which many are wrong.

use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{PoseWithFocal, estimate_relative_pose_and_focal};
use epipole::math::random::Random;
use epipole::robust::{RansacOptions, RansacReport};
use epipole::{Error, estimate_relative_pose};
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

struct Scene {
    k: Intrinsics,
    motion: RigidTransform,
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
}

/// 200 matches, the first ones wrong.
fn scene(seed: u64, num_wrong: usize, noise_px: f64) -> Scene {
    scene_of(200, seed, num_wrong, noise_px)
}

/// Matches in photographs of 1000 × 800 pixels, the first ones wrong. The cameras turn by some ten
/// degrees about any axis and step in any direction, so that their axes do not meet.
fn scene_of(num: usize, seed: u64, num_wrong: usize, noise_px: f64) -> Scene {
    let mut random = Random::new(seed);
    let f = 800.0 * libm::exp(random.uniform(-0.4, 0.7));
    let k = Intrinsics::new(f, f, 500.0, 400.0).unwrap();
    let rotation_vector = Vector3::from_fn(|_, _| 0.2 * random.normal());
    let t = Vector3::from_fn(|_, _| random.normal()).normalize();
    let motion =
        RigidTransform::from_parts(t.into(), UnitQuaternion::from_scaled_axis(rotation_vector));
    let (mut p1, mut p2) = (Vec::new(), Vec::new());
    while p1.len() < num {
        let anywhere = |random: &mut Random| {
            Point2::new(random.uniform(0.0, 1000.0), random.uniform(0.0, 800.0))
        };
        let pixel = anywhere(&mut random);
        if p1.len() < num_wrong {
            p1.push(pixel);
            p2.push(anywhere(&mut random));
            continue;
        }
        let x = Point3::from(k.ray(&pixel) * random.uniform(2.0, 8.0));
        if let Ok(other) = k.project(&(motion * x))
            && (0.0..1000.0).contains(&other.x)
            && (0.0..800.0).contains(&other.y)
        {
            let mut noisy = |p: Point2<f64>| {
                Point2::new(
                    p.x + noise_px * random.normal(),
                    p.y + noise_px * random.normal(),
                )
            };
            let (a, b) = (noisy(pixel), noisy(other));
            p1.push(a);
            p2.push(b);
        }
    }
    Scene { k, motion, p1, p2 }
}

impl Scene {
    fn estimate(&self) -> RansacReport<PoseWithFocal> {
        let middle = self.k.principal_point();
        let options = RansacOptions::default();
        estimate_relative_pose_and_focal(&self.p1, &self.p2, &middle, &middle, &options, &mut ())
            .unwrap()
    }

    fn error_deg(&self, found: &RigidTransform) -> f64 {
        let angle = found.rotation.angle_to(&self.motion.rotation);
        let way = (found.translation.vector).angle(&self.motion.translation.vector);
        angle.max(way).to_degrees()
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn exact_matches_give_the_exact_focal_length() {
    for seed in 0..20 {
        let scene = scene(seed, 60, 0.0);
        let report = scene.estimate();
        let ratio = report.model.focal_px / scene.k.fu_px();
        assert!((ratio - 1.0).abs() < 1e-3, "{seed}: {ratio}");
        let error_deg = scene.error_deg(&report.model.pose.cam2_from_cam1());
        assert!(error_deg < 0.05, "{seed}: {error_deg}");
        assert!(report.inliers[60..].iter().all(|is| *is));
    }
}

/// With half a pixel of noise and a third of the matches wrong, the pose is nearly as good as with
/// the true focal length, and far better than with one that is a third too long.
#[test]
fn a_found_focal_length_is_better_than_a_guess() {
    let (mut ours, mut known, mut guessed, mut ratios) = (vec![], vec![], vec![], vec![]);
    let mut deviations = vec![];
    for seed in 0..40 {
        let scene = scene(seed, 66, 0.5);
        let report = scene.estimate();
        let off_px = (report.model.focal_px - scene.k.fu_px()).abs();
        ratios.push(off_px / scene.k.fu_px());
        deviations.push(off_px / report.model.focal_std_px.unwrap());
        ours.push(scene.error_deg(&report.model.pose.cam2_from_cam1()));
        let with = |factor: f64| {
            let f = factor * scene.k.fu_px();
            let k = Intrinsics::new(f, f, 500.0, 400.0).unwrap();
            let options = RansacOptions::default();
            let report = estimate_relative_pose(
                &scene.p1,
                &scene.p2,
                [&Camera::pinhole(k, 640, 480); 2],
                &options,
                &mut (),
            )
            .unwrap();
            scene.error_deg(&report.model.cam2_from_cam1())
        };
        known.push(with(1.0));
        guessed.push(with(4.0 / 3.0));
    }
    let [ours, known, guessed, ratio] = [ours, known, guessed, ratios].map(median);
    println!("pose {ours}, known {known}, guessed {guessed} degrees, focal {ratio}");
    assert!(ratio < 0.02, "{ratio}");
    // Half of Gaussian errors are within 0.67 standard deviations.
    let middle = median(deviations);
    assert!((0.4..1.0).contains(&middle), "{middle}");
    assert!(
        ours < 3.0 * known && 3.0 * ours < guessed,
        "{ours} {known} {guessed}"
    );
}

/// Two cameras whose axes are parallel, or that look at one thing from the same distance.
/// Other focal lengths are compared on a part of many matches; the deviation is that of all.
#[test]
fn many_matches_determine_the_focal_length_exactly() {
    let mut deviations = vec![];
    for seed in 0..12 {
        let scene = scene_of(6000, seed, 3000, 0.5);
        let report = scene.estimate();
        let off_px = (report.model.focal_px - scene.k.fu_px()).abs();
        let std_px = report.model.focal_std_px.unwrap();
        assert!(off_px < 0.01 * scene.k.fu_px(), "{seed}: {off_px}");
        assert!(std_px < 0.01 * scene.k.fu_px(), "{seed}: {std_px}");
        deviations.push(off_px / std_px);
    }
    let middle = median(deviations.clone());
    assert!((0.2..1.5).contains(&middle), "{deviations:?}");
}

#[test]
fn an_undetermined_focal_length_is_reported() {
    let k = Intrinsics::new(800.0, 800.0, 500.0, 400.0).unwrap();
    for (step, angle_rad) in [
        (Vector3::new(-1.0, 0.1, 0.2), 0.0),
        (Vector3::new(-1.0, 0.0, 0.1), 0.2),
    ] {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, angle_rad, 0.0));
        // About a point five units ahead, for the second.
        let t = if angle_rad == 0.0 {
            step
        } else {
            Vector3::new(0.0, 0.0, 5.0) - rotation * Vector3::new(0.0, 0.0, 5.0)
        };
        let motion = RigidTransform::from_parts(t.into(), rotation);
        let mut random = Random::new(4);
        let (mut p1, mut p2) = (Vec::new(), Vec::new());
        for _ in 0..200 {
            let pixel = Point2::new(random.uniform(200.0, 800.0), random.uniform(100.0, 700.0));
            let x = Point3::from(k.ray(&pixel) * random.uniform(4.0, 7.0));
            let other = k.project(&(motion * x)).unwrap();
            p1.push(Point2::new(pixel.x + 0.5 * random.normal(), pixel.y));
            p2.push(Point2::new(other.x, other.y + 0.5 * random.normal()));
        }
        let middle = k.principal_point();
        let options = RansacOptions::default();
        let found = estimate_relative_pose_and_focal(&p1, &p2, &middle, &middle, &options, &mut ())
            .unwrap();
        let open =
            (found.model.focal_std_px).is_none_or(|std_px| std_px > 0.1 * found.model.focal_px);
        assert!(
            open && !found.model.constrains_focal(),
            "{angle_rad}: {:?}",
            found.model
        );
    }
    assert!(scene(3, 60, 0.5).estimate().model.constrains_focal());
}

#[test]
fn bad_input_is_refused() {
    let scene = scene(1, 0, 0.0);
    let middle = scene.k.principal_point();
    let options = RansacOptions::default();
    let find = |p1: &[Point2<f64>], p2: &[Point2<f64>], c: &Point2<f64>| {
        estimate_relative_pose_and_focal(p1, p2, c, c, &options, &mut ())
    };
    let few = find(&scene.p1[..5], &scene.p2[..5], &middle);
    assert!(matches!(few, Err(Error::TooFew { needed: 6, .. })));
    let row: Vec<_> = (0..50).map(|i| Point2::new(f64::from(i), 3.0)).collect();
    let line = find(&row, &row, &middle);
    assert!(matches!(line, Err(Error::Degenerate { .. })));
    let nowhere = find(&scene.p1, &scene.p2, &Point2::new(f64::NAN, 0.0));
    assert!(matches!(nowhere, Err(Error::NotFinite { .. })));
    // A camera that did not move at all: whatever is said is finite.
    if let Ok(report) = find(&scene.p1, &scene.p1, &middle) {
        assert!(report.model.focal_px.is_finite());
    }
}

/// One wrong match far outside of the images takes no focal length from the plausible ones.
#[test]
fn one_far_pixel_does_not_move_the_focal_length() {
    for seed in 0..10 {
        let mut scene = scene(seed, 0, 0.0);
        scene.p1.truncate(50);
        scene.p2.truncate(50);
        scene.p1.push(Point2::new(10_000.0, 0.0));
        scene.p2.push(Point2::new(0.0, 300.0));
        let report = scene.estimate();
        let ratio = report.model.focal_px / scene.k.fu_px();
        assert!((ratio - 1.0).abs() < 1e-3, "{seed}: {ratio}");
        assert_eq!(report.num_inliers, 50, "{seed}");
    }
}
