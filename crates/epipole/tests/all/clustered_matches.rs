//! Many wrong matches that lead to nearly one pixel: a model that maps everything there fits all of
//! them.

use epipole::math::random::Random;
use epipole::robust::{RansacOptions, RansacReport, ThresholdKind, estimate_similarity};
use epipole::{Result, estimate_fundamental, estimate_homography};
use nalgebra::{Matrix3, Point2, Vector2};

const NUM_MATCHES: usize = 300;
const NUM_CLUSTERED: usize = 180;

struct Scene {
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
}

/// The first 180 of 300 matches lead to one place, up to `reach_px` of it along u and v; the others
/// follow `truth`, with noise of .3 px.
fn scene(
    seed: u64,
    reach_px: f64,
    truth: impl Fn(&Point2<f64>, &mut Random) -> Point2<f64>,
) -> Scene {
    let mut random = Random::new(seed);
    let anywhere =
        |random: &mut Random| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
    let place = anywhere(&mut random);
    let p1: Vec<_> = (0..NUM_MATCHES).map(|_| anywhere(&mut random)).collect();
    let other = |(i, p): (usize, &Point2<f64>)| {
        if i < NUM_CLUSTERED {
            let mut off = || random.uniform(-reach_px, reach_px);
            return place + Vector2::new(off(), off());
        }
        let exact = truth(p, &mut random);
        exact + Vector2::new(0.3 * random.normal(), 0.3 * random.normal())
    };
    let p2 = p1.iter().enumerate().map(other).collect();
    Scene { p1, p2 }
}

fn options(seed: u64) -> RansacOptions {
    RansacOptions::default().with_seed(seed)
}

/// Nearly all true matches are inliers, and of the others only those that fit by chance.
fn is_true<M>(found: &Result<RansacReport<M>>) -> bool {
    let report = found.as_ref().unwrap();
    let count = |mask: &[bool]| mask.iter().filter(|fits| **fits).count();
    let (clustered, honest) = report.inliers.split_at(NUM_CLUSTERED);
    count(honest) * 10 > honest.len() * 9 && count(clustered) * 5 < clustered.len()
}

fn rotated(p: &Point2<f64>, _: &mut Random) -> Point2<f64> {
    Point2::new(0.9 * p.x - 0.2 * p.y + 30.0, 0.2 * p.x + 0.9 * p.y - 10.0)
}

fn tilted(p: &Point2<f64>, _: &mut Random) -> Point2<f64> {
    let h = Matrix3::new(0.9, -0.2, 30.0, 0.2, 0.9, -10.0, 1e-4, -5e-5, 1.0);
    Point2::from_homogeneous(h * p.to_homogeneous()).unwrap()
}

fn sideways(p: &Point2<f64>, random: &mut Random) -> Point2<f64> {
    Point2::new(p.x + random.uniform(5.0, 80.0), p.y)
}

#[test]
fn one_place_wins_no_similarity() {
    for seed in 0..20 {
        for reach_px in [0.05, 0.2, 0.5] {
            let Scene { p1, p2 } = scene(seed, reach_px, rotated);
            let found = estimate_similarity(&p1, &p2, &options(seed), &mut ());
            assert!(is_true(&found), "{seed} {reach_px} {found:?}");
        }
    }
}

#[test]
fn one_place_wins_no_homography() {
    for seed in 0..20 {
        for reach_px in [0.05, 0.2, 0.5] {
            let Scene { p1, p2 } = scene(seed, reach_px, tilted);
            let found = estimate_homography(&p1, &p2, &options(seed), &mut ());
            assert!(is_true(&found), "{seed} {reach_px} {found:?}");
        }
    }
}

/// The epipole there fits all of them, whichever of the images it is.
#[test]
fn one_place_wins_no_fundamental() {
    for seed in 0..20 {
        let Scene { p1, p2 } = scene(seed, 0.2, sideways);
        for (p1, p2) in [(&p1, &p2), (&p2, &p1)] {
            let found = estimate_fundamental(p1, p2, &options(seed), &mut ());
            let report = found.as_ref().unwrap();
            let honest = report.inliers[NUM_CLUSTERED..].iter().filter(|fits| **fits);
            assert!(honest.count() > 100, "{seed} {found:?}");
        }
    }
}

/// A threshold that finds itself is not lured there either.
#[test]
fn one_place_wins_with_no_threshold() {
    for seed in 0..10 {
        let Scene { p1, p2 } = scene(seed, 0.2, tilted);
        let of_noise = options(seed).with_threshold(ThresholdKind::Noise);
        let found = estimate_homography(&p1, &p2, &of_noise, &mut ());
        assert!(is_true(&found), "{seed} {found:?}");
    }
}

/// The spread of the inliers matters, not the size of the map from pixels to meters and back.
#[test]
fn maps_to_meters_and_from_them_are_as_good() {
    for (unit, size_m) in [(1e-3, 0.6), (1e-2, 6.0), (1.0, 600.0)] {
        for seed in 0..5 {
            let Scene { p1, p2 } = scene(seed, 0.2, rotated);
            let plan: Vec<_> = p2.iter().map(|p| p * unit).collect();
            let meters = options(seed).with_max_error_px(unit);
            let found = estimate_similarity(&p1, &plan, &meters, &mut ());
            assert!(is_true(&found), "{size_m} m {found:?}");
            // Only the honest ones back: in an area of millimeters each is far from the others by
            // the pixel.
            let (from, to) = (&plan[NUM_CLUSTERED..], &p1[NUM_CLUSTERED..]);
            let back = estimate_similarity(from, to, &options(seed), &mut ()).unwrap();
            assert!(back.num_inliers > 110, "{size_m} m {back:?}");
        }
    }
}

/// Points that all lie within the threshold are a small image, not one place, if the model
/// distinguishes their positions.
#[test]
fn a_picture_smaller_than_the_threshold_is_no_place() {
    let at = |i: usize| Point2::new((i * 37 % 64) as f64 / 640.0, (i * 71 % 48) as f64 / 480.0);
    let p1: Vec<_> = (0..40).map(at).collect();
    let moved = |p: &Point2<f64>| rotated(p, &mut Random::new(0));
    let p2: Vec<_> = p1.iter().map(moved).collect();
    let report = estimate_similarity(&p1, &p2, &options(0), &mut ()).unwrap();
    assert!((report.model.a - 0.9).abs() < 1e-9 && report.num_inliers == 40);
    let report = estimate_homography(&p1, &p2, &options(0), &mut ()).unwrap();
    assert_eq!(report.num_inliers, 40);
}

/// With no other structure, a cluster does not pass as a model, and the report of the best model
/// marks it as not significant.
#[test]
fn a_single_image_region_is_no_model() {
    fn is_insignificant<M>(found: &Result<RansacReport<M>>) -> bool {
        found.as_ref().map_or(true, |report| {
            let unsure = report.required_iterations > report.iterations as u64;
            report.num_inliers < 20 && (unsure || report.could_be_random())
        })
    }
    for seed in 0..10 {
        let anywhere = |_: &Point2<f64>, random: &mut Random| {
            Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0))
        };
        let Scene { p1, p2 } = scene(seed, 0.2, anywhere);
        let similarity = estimate_similarity(&p1, &p2, &options(seed), &mut ());
        assert!(is_insignificant(&similarity), "{seed} {similarity:?}");
        let homography = estimate_homography(&p1, &p2, &options(seed), &mut ());
        assert!(is_insignificant(&homography), "{seed} {homography:?}");
    }
}
