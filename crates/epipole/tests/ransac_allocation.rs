//! The RANSAC loop takes no memory: everything is allocated before the first step.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
// A counting allocator is the only way to see allocations, and its trait is unsafe.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use epipole::absolute_pose::AbsolutePoseEstimator;
use epipole::camera::Camera;
use epipole::epipolar::{EssentialEstimator, FundamentalEstimator};
use epipole::homography::HomographyEstimator;
use epipole::robust::{
    Estimator, LineEstimator, MatchSet, Ransac, RansacOptions, SamplerKind, ScoreKind,
    SimilarityEstimator, Step,
};
use epipole::synthetic::{Structure, TwoViewProblem, TwoViewProblemOptions};
use epipole::two_view::RotationEstimator;

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

/// Matches of points of which some lie on a plane; every third match is wrong.
fn matches(num_on_plane: usize) -> TwoViewProblem {
    let draw = |structure, num_points| {
        let options = TwoViewProblemOptions::default()
            .with_num_points(num_points)
            .with_structure(structure)
            .with_noise_px(0.3)
            .with_outlier_fraction(1.0 / 3.0)
            .with_seed(5);
        TwoViewProblem::new(&options).unwrap()
    };
    let half_side_m = 1.5;
    let mut all = draw(Structure::Plane { half_side_m }, num_on_plane);
    // The same two cameras see both.
    let others = draw(Structure::Cube { half_side_m }, 300 - num_on_plane);
    all.pixels1.extend(others.pixels1);
    all.pixels2.extend(others.pixels2);
    all.points.extend(others.points);
    all
}

/// Every way to draw and to judge samples. A copy of an estimator would lack its buffers, so each
/// run gets one that is `made` for it.
fn check<E: Estimator>(name: &str, made: impl Fn() -> E) {
    for sampler in [SamplerKind::Uniform, SamplerKind::Prosac] {
        for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
            for score_every_trial in [false, true] {
                let options = RansacOptions::default()
                    .with_min_iterations(300)
                    .with_max_iterations(300)
                    .with_sampler(sampler)
                    .with_score(score)
                    .with_score_every_trial(score_every_trial);
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
    let world = matches(0);
    let (p1, k) = (&world.pixels1, world.camera1.camera.intrinsics);
    let camera = Camera::pinhole(k, 640, 480);
    let set = || MatchSet::new(p1, &world.pixels2).unwrap();
    check("line", || LineEstimator::new(p1).unwrap());
    check("similarity", || SimilarityEstimator::new(set()));
    check("homography", || HomographyEstimator::new(set()).unwrap());
    check("fundamental", || FundamentalEstimator::new(set()).unwrap());
    check("essential", || {
        EssentialEstimator::new(p1, &world.pixels2, [&camera; 2]).unwrap()
    });
    check("rotation", || {
        RotationEstimator::new(set(), [&camera; 2]).unwrap()
    });
    check("absolute pose", || {
        AbsolutePoseEstimator::new(&world.points, p1, &camera).unwrap()
    });
}

#[test]
fn recovery_from_a_plane_does_not_allocate() {
    let world = matches(270);
    let set = || MatchSet::new(&world.pixels1, &world.pixels2).unwrap();
    check("fundamental", || FundamentalEstimator::new(set()).unwrap());
}

#[test]
fn the_counter_counts() {
    let before = COUNT.with(Cell::get);
    let list: Vec<usize> = (0..100).collect();
    assert_eq!(list.len(), 100);
    assert!(COUNT.with(Cell::get) > before);
}
