//! The threshold estimated from the data, on scenes with known noise.

use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{decompose_essential, select_pose};
use epipole::math::random::Random;
use epipole::progress::{Monitor, Status};
use epipole::robust::{
    LineEstimator, RansacOptions, StopReason, ThresholdKind, estimate_similarity, ransac,
};
use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_calibrated};
use epipole::{Error, estimate_fundamental, estimate_homography, estimate_relative_pose};
use nalgebra::{Matrix3, Point2, Point3, UnitQuaternion, Vector3};
use std::ops::ControlFlow;

const WIDTH: f64 = 1000.0;
const HEIGHT: f64 = 800.0;

/// Thresholds in standard deviations: 99 % of errors in one dimension, and in two.
const IN_ONE: f64 = 2.576;
const IN_TWO: f64 = 3.035;

struct Scene {
    k: Intrinsics,
    motion: RigidTransform,
    /// x · plane = −1 for its points.
    plane: Vector3<f64>,
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
}

fn anywhere(random: &mut Random) -> Point2<f64> {
    Point2::new(random.uniform(0.0, WIDTH), random.uniform(0.0, HEIGHT))
}

fn moved(p: &Point2<f64>, noise_px: f64, random: &mut Random) -> Point2<f64> {
    Point2::new(
        p.x + noise_px * random.normal(),
        p.y + noise_px * random.normal(),
    )
}

/// 250 matches: points two to eight units away, or on a plane, and wrong ones anywhere.
fn scene(seed: u64, wrong: f64, noise_px: f64, planar: bool) -> Scene {
    let mut random = Random::new(seed);
    let k = Intrinsics::new(800.0, 800.0, 500.0, 400.0).unwrap();
    let rotation_vector = Vector3::from_fn(|_, _| 0.1 * random.normal());
    let way = [1.0, 0.3, 0.5].map(|size| size * random.normal());
    let t = 0.7 * Vector3::from(way).normalize();
    let motion =
        RigidTransform::from_parts(t.into(), UnitQuaternion::from_scaled_axis(rotation_vector));
    let slope = [0, 1].map(|_| 0.2 * random.normal());
    let plane = Vector3::new(slope[0], slope[1], -1.0).normalize() / 5.0;
    let (mut p1, mut p2) = (Vec::new(), Vec::new());
    while p1.len() < 250 {
        let pixel = anywhere(&mut random);
        if (p1.len() as f64) < 250.0 * wrong {
            p1.push(pixel);
            p2.push(anywhere(&mut random));
            continue;
        }
        let ray = k.ray(&pixel);
        let depth = match planar {
            true => -1.0 / plane.dot(&ray),
            false => random.uniform(2.0, 8.0),
        };
        if let Ok(other) = k.project(&(motion * Point3::from(ray * depth)))
            && (0.0..WIDTH).contains(&other.x)
            && (0.0..HEIGHT).contains(&other.y)
        {
            p1.push(moved(&pixel, noise_px, &mut random));
            p2.push(moved(&other, noise_px, &mut random));
        }
    }
    Scene {
        k,
        motion,
        plane,
        p1,
        p2,
    }
}

fn within(max_error_px: f64) -> RansacOptions {
    RansacOptions::default().within(max_error_px)
}

fn from_noise() -> RansacOptions {
    RansacOptions::default().with_threshold(ThresholdKind::Noise)
}

/// Error of a model, and the threshold that it was found with.
type Outcome = (f64, f64);

impl Scene {
    fn pose_error_deg(&self, found: &RigidTransform) -> f64 {
        let angle = found.rotation.angle_to(&self.motion.rotation);
        let way = (found.translation.vector).angle(&self.motion.translation.vector);
        angle.max(way).to_degrees()
    }

    fn essential(&self, options: &RansacOptions) -> Outcome {
        let report = estimate_relative_pose(
            &self.p1,
            &self.p2,
            [&Camera::pinhole(self.k, 640, 480); 2],
            options,
            &mut (),
        )
        .unwrap();
        let error_deg = self.pose_error_deg(&report.model.cam2_from_cam1());
        (error_deg, report.max_error_px)
    }

    fn fundamental(&self, options: &RansacOptions) -> Outcome {
        let report = estimate_fundamental(&self.p1, &self.p2, options, &mut ()).unwrap();
        let essential = self.k.matrix().transpose() * report.model * self.k.matrix();
        let inliers = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let selected = pixels.iter().zip(&report.inliers).filter(|(_, is)| **is);
            selected.map(|(pixel, _)| *pixel).collect()
        };
        let (in1, in2) = (inliers(&self.p1), inliers(&self.p2));
        let motions = decompose_essential(&essential).unwrap();
        let pose = select_pose(&motions, &in1, &in2, &self.k, &self.k).unwrap();
        let error_deg = self.pose_error_deg(&pose.cam2_from_cam1);
        (error_deg, report.max_error_px)
    }

    /// The error is the mean of the four corners', in pixels.
    fn homography(&self, options: &RansacOptions) -> Outcome {
        let report = estimate_homography(&self.p1, &self.p2, options, &mut ()).unwrap();
        let rotation = self.motion.rotation.to_rotation_matrix().into_inner();
        let rays = rotation - self.motion.translation.vector * self.plane.transpose();
        let truth = self.k.matrix() * rays * self.k.inverse_matrix();
        let map = |h: &Matrix3<f64>, (u, v): (f64, f64)| {
            Point2::from_homogeneous(h * Vector3::new(u, v, 1.0)).unwrap()
        };
        let corners = [(0.0, 0.0), (WIDTH, 0.0), (0.0, HEIGHT), (WIDTH, HEIGHT)];
        let off = |&corner: &_| (map(&report.model, corner) - map(&truth, corner)).norm();
        let error_px = corners.iter().map(off).sum::<f64>() / 4.0;
        (error_px, report.max_error_px)
    }
}

/// The mean over all thresholds up to the limit of the share of errors below them, in percent.
fn auc(errors: impl Iterator<Item = f64>, limit: f64) -> f64 {
    let scores: Vec<f64> = errors.map(|error| (1.0 - error / limit).max(0.0)).collect();
    100.0 * scores.iter().sum::<f64>() / scores.len() as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// For one noise level and three outlier ratios, models are as good as with the best of six
/// thresholds, and the noise is found.
///
/// * `num_scenes`: enough for their mean to separate two points
/// * `scale`: the threshold of a standard deviation in each image's pixels
fn compare(
    num_scenes: u64,
    noise_px: f64,
    planar: bool,
    scale: f64,
    limit: f64,
    estimate: impl Fn(&Scene, &RansacOptions) -> Outcome,
) {
    let wrongs = [0.2, 0.45, 0.65];
    let scenes: Vec<Scene> = (0..num_scenes)
        .map(|seed| scene(seed, wrongs[seed as usize % 3], noise_px, planar))
        .collect();
    let found: Vec<Outcome> = scenes.iter().map(|s| estimate(s, &from_noise())).collect();
    let ours = auc(found.iter().map(|(error, _)| *error), limit);
    for max_error_px in [0.25, 0.5, 1.0, 2.0, 4.0, 10.0] {
        // Thresholds that cut off most of the right matches, or let in many wrong ones, cost time
        // only.
        if max_error_px < noise_px || max_error_px > 10.0 * noise_px {
            continue;
        }
        let options = within(max_error_px);
        let fixed = auc(scenes.iter().map(|s| estimate(s, &options).0), limit);
        assert!(
            ours > fixed - 2.0,
            "noise {noise_px}: {ours} {fixed} at {max_error_px}"
        );
    }
    for (_, max_error_px) in &found {
        let ratio = max_error_px / (scale * noise_px);
        assert!((0.7..1.3).contains(&ratio), "noise {noise_px}: {ratio}");
    }
    let middle = median(
        found
            .iter()
            .map(|(_, px)| px / (scale * noise_px))
            .collect(),
    );
    assert!(
        (0.9..1.1).contains(&middle),
        "noise {noise_px}, in the middle {middle}"
    );
}

const NOISES_PX: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

#[test]
fn the_essential_matrix_finds_its_threshold() {
    for noise_px in NOISES_PX {
        compare(9, noise_px, false, IN_ONE, 5.0, Scene::essential);
    }
}

#[test]
fn the_fundamental_matrix_finds_its_threshold() {
    for noise_px in NOISES_PX {
        compare(36, noise_px, false, IN_ONE, 5.0, Scene::fundamental);
    }
}

/// The distance in image 2 has the noise of both images.
#[test]
fn the_homography_finds_its_threshold() {
    let scale = IN_TWO * std::f64::consts::SQRT_2;
    for noise_px in NOISES_PX {
        compare(9, noise_px, true, scale, 10.0, Scene::homography);
    }
}

#[test]
fn a_line_finds_its_threshold() {
    for noise_px in NOISES_PX {
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let points: Vec<_> = (0..200)
                .map(|i| match anywhere(&mut random) {
                    p if i % 2 == 0 => Point2::new(p.x, 100.0 + noise_px * random.normal()),
                    p => p,
                })
                .collect();
            let report =
                ransac(LineEstimator::new(&points).unwrap(), &from_noise(), &mut ()).unwrap();
            let ratio = report.max_error_px / (IN_ONE * noise_px);
            assert!(
                (0.7..1.3).contains(&ratio),
                "noise {noise_px}, seed {seed}: {ratio}"
            );
        }
    }
}

#[test]
fn no_guess_of_the_threshold_matters() {
    let scene = scene(1, 0.4, 0.7, false);
    let find = |max_error_px| {
        let options = from_noise().with_max_error_px(max_error_px);
        estimate_fundamental(&scene.p1, &scene.p2, &options, &mut ()).unwrap()
    };
    let first = find(0.25);
    for max_error_px in [1.0, 3.0, 10.0] {
        assert_eq!(find(max_error_px), first);
    }
}

/// The report is that of a run at the threshold found: its inliers are the data within it.
#[test]
fn inliers_are_within_the_threshold_found() {
    let scene = scene(2, 0.4, 0.7, false);
    let report = estimate_fundamental(&scene.p1, &scene.p2, &from_noise(), &mut ()).unwrap();
    for (i, inlier) in report.inliers.iter().enumerate() {
        let error_px = epipole::epipolar::sampson_px(&report.model, &scene.p1[i], &scene.p2[i]);
        assert_eq!(error_px < report.max_error_px, *inlier);
    }
    assert_eq!(report.stop, StopReason::Confident);
    assert!(!report.could_be_random());
}

/// E, F, H and the rotation are compared within one threshold.
#[test]
fn two_views_share_the_threshold_of_the_fundamental_matrix() {
    let options = TwoViewOptions::default().with_ransac(from_noise());
    for noise_px in [0.25, 2.0] {
        for (planar, expected) in [
            (false, Configuration::General),
            (true, Configuration::Planar),
        ] {
            for seed in 0..5 {
                let s = scene(seed, 0.4, noise_px, planar);
                let report = estimate_two_view_calibrated(
                    &s.p1,
                    &s.p2,
                    [&Camera::pinhole(s.k, 640, 480); 2],
                    &options,
                    &mut (),
                )
                .unwrap();
                let ratio = report.max_error_px / (IN_ONE * noise_px);
                assert!((0.6..1.4).contains(&ratio), "{planar} {seed}: {ratio}");
                assert_eq!(report.configuration, expected, "{noise_px} {seed}");
            }
        }
    }
}

#[test]
fn exact_matches_have_a_threshold_above_zero() {
    let s = scene(3, 0.3, 0.0, false);
    let report = estimate_fundamental(&s.p1, &s.p2, &from_noise(), &mut ()).unwrap();
    // A wrong match that happens to lie within it may add a little.
    assert!((0.05..0.055).contains(&report.max_error_px));
    assert!(report.inliers[75..].iter().all(|inlier| *inlier));
    // Not one too many, either: all points on one line.
    let row: Vec<_> = (0..20).map(|i| Point2::new(f64::from(i), 7.0)).collect();
    let report = ransac(LineEstimator::new(&row).unwrap(), &from_noise(), &mut ()).unwrap();
    assert!((report.max_error_px - 0.05).abs() < 1e-12);
    assert_eq!(report.num_inliers, 20);
}

#[test]
fn bad_input_is_refused_and_never_gives_a_strange_threshold() {
    let options = from_noise();
    let few = scene(4, 0.0, 0.5, false);
    let refused = estimate_fundamental(&few.p1[..6], &few.p2[..6], &options, &mut ());
    assert!(matches!(refused, Err(Error::TooFew { .. })));
    let same = vec![Point2::new(3.0, 4.0); 50];
    assert!(estimate_fundamental(&same, &same, &options, &mut ()).is_err());
    assert!(estimate_homography(&same, &same, &options, &mut ()).is_err());
    let sane = |px: f64| (0.05..1000.0).contains(&px);
    // A sample and at most a few more leave no redundancy to estimate the noise from.
    for count in [7, 8, 9, 12] {
        if let Ok(report) =
            estimate_fundamental(&few.p1[..count], &few.p2[..count], &options, &mut ())
        {
            assert!(sane(report.max_error_px), "{count}");
        }
    }
    for count in [2, 3, 4] {
        let (p1, p2) = (&few.p1[..count], &few.p2[..count]);
        if let Ok(report) = estimate_similarity(p1, p2, &options, &mut ()) {
            assert!(sane(report.max_error_px), "{count}");
        }
    }
    // Nothing but wrong matches.
    let nothing = scene(5, 1.0, 0.0, false);
    let report = estimate_fundamental(&nothing.p1, &nothing.p2, &options, &mut ()).unwrap();
    assert!(sane(report.max_error_px) && report.could_be_random());
}

#[test]
fn progress_rises_over_all_runs_and_the_search_can_be_canceled() {
    let points: Vec<_> = (0..100)
        .map(|i| Point2::new(f64::from(i), f64::from(i * 7 % 3)))
        .collect();
    let run = |monitor: &mut dyn Monitor| {
        ransac(LineEstimator::new(&points).unwrap(), &from_noise(), monitor)
    };
    let mut fractions = Vec::new();
    let mut watch = |status: Status| {
        fractions.push(status.fraction);
        ControlFlow::Continue(())
    };
    assert!(run(&mut watch).unwrap().iterations >= 600);
    assert!(fractions.len() > 15 && fractions.is_sorted() && fractions.iter().all(|s| *s <= 1.0));
    let canceled = run(&mut |status: Status| match status.fraction > 0.2 {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    });
    assert_eq!(canceled.unwrap_err(), Error::Canceled);
}
