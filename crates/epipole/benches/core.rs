//! Benchmarks of the functions that the figures call while a slider moves: image processing, RANSAC
//! for a line, F from two cameras.

use criterion::{Criterion, criterion_group, criterion_main};
use epipole::camera::PosedCamera;
use epipole::epipolar::fundamental_from_cameras;
use epipole::math::random::Random;
use epipole::robust::{LineEstimator, RansacOptions, ransac};
use epipole_scenes::{Sampling, Scene, still_life_camera};
use nalgebra::{Point2, Translation3};
use std::hint::black_box;

fn images(criterion: &mut Criterion) {
    let scene = Scene::still_life();
    let mut group = criterion.benchmark_group("photograph");
    group.sample_size(10);
    for (name, width, height, sampling) in [
        ("full-640x480", 640, 480, Sampling::Full),
        ("draft-240x180", 240, 180, Sampling::Draft),
    ] {
        let camera = still_life_camera(width, height);
        group.bench_function(name, |bencher| {
            bencher.iter(|| scene.render(black_box(&camera), width, height, sampling));
        });
    }
    group.bench_function("scene", |bencher| bencher.iter(Scene::still_life));
    group.finish();
}

fn line(criterion: &mut Criterion) {
    let mut random = Random::new(1);
    let points: Vec<Point2<f64>> = (0..200)
        .map(|index| {
            let u = random.uniform(0.0, 640.0);
            let v = if index % 10 < 7 {
                0.3 * u + random.normal()
            } else {
                random.uniform(0.0, 400.0)
            };
            Point2::new(u, v)
        })
        .collect();
    criterion.bench_function("ransac/line-200-points-30-percent-outliers", |bencher| {
        bencher.iter(|| {
            let estimator = LineEstimator::new(black_box(&points));
            estimator.and_then(|estimator| ransac(estimator, &RansacOptions::default(), &mut ()))
        });
    });
}

fn two_cameras(criterion: &mut Criterion) {
    let camera1 = still_life_camera(640, 480);
    let cam_from_world = Translation3::new(-0.3, 0.0, -0.2) * camera1.cam_from_world;
    let camera2 = PosedCamera {
        cam_from_world,
        ..camera1
    };
    criterion.bench_function("epipolar/fundamental-from-cameras", |bencher| {
        bencher.iter(|| fundamental_from_cameras(black_box(&camera1), black_box(&camera2)));
    });
}

criterion_group!(benches, images, line, two_cameras);
criterion_main!(benches);
