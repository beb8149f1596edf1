//! The RANSAC loop takes no memory: everything is allocated before the first step.

#![allow(
    clippy::unwrap_used,
    clippy::type_complexity,
    reason = "a test may fail"
)]
// A counting allocator is the only way to see allocations, and its trait is unsafe.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use epipole::absolute_pose::AbsolutePoseEstimator;
use epipole::camera::{Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{EssentialEstimator, FundamentalEstimator};
use epipole::homography::HomographyEstimator;
use epipole::math::random::Random;
use epipole::robust::{
    Estimator, LineEstimator, MatchSet, Ransac, RansacOptions, SamplerKind, ScoreKind,
    SimilarityEstimator, Step,
};
use epipole::two_view::RotationEstimator;
use nalgebra::{Point2, Point3, Vector3};

struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator unchanged; counting touches no memory of it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promises are passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Matches of a scene of which `share_on_plane` lies on a plane; every third match is wrong.
fn matches(
    share_on_plane: f64,
) -> (
    Vec<Point2<f64>>,
    Vec<Point2<f64>>,
    Vec<Point3<f64>>,
    Intrinsics,
) {
    let mut random = Random::new(5);
    let intrinsics = Intrinsics::centered(700.0, 640, 480).unwrap();
    let left = PosedCamera {
        intrinsics,
        cam_from_world: RigidTransform::identity(),
    };
    let right = PosedCamera {
        intrinsics,
        cam_from_world: RigidTransform::new(
            Vector3::new(-0.5, 0.1, 0.2),
            Vector3::new(0.02, 0.1, -0.03),
        ),
    };
    let (mut p1, mut p2, mut points) = (Vec::new(), Vec::new(), Vec::new());
    while p1.len() < 300 {
        let depth = if random.unit() < share_on_plane {
            5.0
        } else {
            random.uniform(3.0, 8.0)
        };
        let point = Point3::new(random.uniform(-2.0, 2.0), random.uniform(-1.5, 1.5), depth);
        let (Ok(a), Ok(mut b)) = (left.project(&point), right.project(&point)) else {
            continue;
        };
        if p1.len() % 3 == 0 {
            b = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        }
        let mut noisy =
            |p: Point2<f64>| Point2::new(p.x + 0.3 * random.normal(), p.y + 0.3 * random.normal());
        p1.push(noisy(a));
        p2.push(noisy(b));
        points.push(point);
    }
    (p1, p2, points, intrinsics)
}

/// Every way to draw and to judge samples. A copy of an estimator would lack its buffers, so each run
/// gets one that is `made` for it.
fn check<E: Estimator>(name: &str, made: impl Fn() -> E) {
    for sampler in [SamplerKind::Uniform, SamplerKind::Prosac] {
        for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
            for score_every_trial in [false, true] {
                let options = RansacOptions {
                    min_iterations: 300,
                    max_iterations: 300,
                    sampler,
                    score,
                    score_every_trial,
                    ..RansacOptions::default()
                };
                let what = format!("{name}, {sampler:?}, {score:?}, {score_every_trial}");
                check_run(&what, made(), options);
            }
        }
    }
}

fn check_run<E: Estimator>(name: &str, estimator: E, options: RansacOptions) {
    let mut run = Ransac::new(estimator, options).unwrap();
    let before = COUNT.with(Cell::get);
    let (mut trials, mut improved) = (0, 0);
    while let Step::Trial(trial) = run.step() {
        trials += 1;
        improved += usize::from(trial.is_best);
    }
    let allocated = COUNT.with(Cell::get) - before;
    assert_eq!(trials, 300);
    assert!(improved > 0, "{name} found nothing");
    assert_eq!(allocated, 0, "{name} allocated in the loop");
}

#[test]
fn no_step_allocates() {
    let (p1, p2, points, k) = matches(0.0);
    let set = || MatchSet::new(&p1, &p2).unwrap();
    check("line", || LineEstimator::new(&p1).unwrap());
    check("similarity", || SimilarityEstimator::new(set()));
    check("homography", || HomographyEstimator::new(set()).unwrap());
    check("fundamental", || FundamentalEstimator::new(set()).unwrap());
    check("essential", || {
        EssentialEstimator::new(set(), k, k).unwrap()
    });
    check("rotation", || RotationEstimator::new(set(), k, k).unwrap());
    check("absolute pose", || {
        AbsolutePoseEstimator::new(&points, &p1, k).unwrap()
    });
}

#[test]
fn recovery_from_a_plane_does_not_allocate() {
    let (p1, p2, _, _) = matches(0.9);
    let set = || MatchSet::new(&p1, &p2).unwrap();
    check("fundamental", || FundamentalEstimator::new(set()).unwrap());
}

#[test]
fn the_counter_counts() {
    let before = COUNT.with(Cell::get);
    let list: Vec<usize> = (0..100).collect();
    assert_eq!(list.len(), 100);
    assert!(COUNT.with(Cell::get) > before);
}
