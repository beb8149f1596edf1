//! Times of the solvers, of robust estimation and of triangulation.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use epipole::absolute_pose::pose_p3p;
use epipole::camera::Camera;
use epipole::epipolar::{essential_5point, fundamental_7point, fundamental_8point};
use epipole::homography::homography_4point;
use epipole::robust::RansacOptions;
use epipole::synthetic::{Structure, TwoViewProblem, TwoViewProblemOptions};
use epipole::triangulation::triangulate_dlt_all;
use epipole::{
    estimate_absolute_pose, estimate_fundamental, estimate_homography, estimate_relative_pose,
};
use nalgebra::Point2;

const CUBE: Structure = Structure::Cube { half_side_m: 1.5 };
const PLANE: Structure = Structure::Plane { half_side_m: 1.5 };

/// Matches in random order, half a pixel of noise.
fn world(
    seed: u64,
    num_points: usize,
    outlier_fraction: f64,
    structure: Structure,
) -> TwoViewProblem {
    let options = TwoViewProblemOptions::default()
        .with_num_points(num_points)
        .with_structure(structure)
        .with_noise_px(0.5)
        .with_outlier_fraction(outlier_fraction)
        .with_seed(seed);
    TwoViewProblem::new(&options).expect("two cameras that see the structure")
}

fn solvers(c: &mut Criterion) {
    let mut group = c.benchmark_group("solver");
    let s = world(1, 100, 0.0, CUBE);
    let k = s.camera1.camera.intrinsics;
    let first = |p: &[Point2<f64>], i: usize| p[i];
    let (p7, q7) = (
        core::array::from_fn(|i| first(&s.pixels1, i)),
        core::array::from_fn(|i| first(&s.pixels2, i)),
    );
    group.bench_function("F7", |b| {
        b.iter(|| fundamental_7point(black_box(&p7), black_box(&q7)))
    });
    group.bench_function("F8", |b| {
        b.iter(|| fundamental_8point(black_box(&s.pixels1[..8]), black_box(&s.pixels2[..8])))
    });
    group.bench_function("F8 of 100", |b| {
        b.iter(|| fundamental_8point(black_box(&s.pixels1), black_box(&s.pixels2)))
    });
    let (r1, r2) = (
        core::array::from_fn(|i| k.ray(&s.pixels1[i])),
        core::array::from_fn(|i| k.ray(&s.pixels2[i])),
    );
    group.bench_function("E5", |b| {
        b.iter(|| essential_5point(black_box(&r1), black_box(&r2)))
    });
    let (p4, q4) = (
        core::array::from_fn(|i| s.pixels1[i]),
        core::array::from_fn(|i| s.pixels2[i]),
    );
    group.bench_function("H4", |b| {
        b.iter(|| homography_4point(black_box(&p4), black_box(&q4)))
    });
    let (rays, points) = (
        core::array::from_fn(|i| k.ray(&s.pixels2[i])),
        core::array::from_fn(|i| s.points[i]),
    );
    group.bench_function("P3P", |b| {
        b.iter(|| pose_p3p(black_box(&rays), black_box(&points)))
    });
    group.finish();
}

fn robust(c: &mut Criterion) {
    let mut group = c.benchmark_group("ransac");
    group.sample_size(30);
    let mut seed = 0;
    let mut options = || {
        seed += 1;
        RansacOptions::default().with_seed(seed)
    };
    let s = world(2, 1000, 0.4, CUBE);
    let k = s.camera1.camera.intrinsics;
    group.bench_function("F 1000, 40 % outliers", |b| {
        b.iter(|| estimate_fundamental(&s.pixels1, &s.pixels2, &options(), &mut ()))
    });
    group.bench_function("E 1000, 40 % outliers", |b| {
        b.iter(|| {
            estimate_relative_pose(
                &s.pixels1,
                &s.pixels2,
                [&Camera::pinhole(k, 640, 480); 2],
                &options(),
                &mut (),
            )
        })
    });
    group.bench_function("P3P 1000, 40 % outliers", |b| {
        b.iter(|| {
            estimate_absolute_pose(
                &s.points,
                &s.pixels2,
                &Camera::pinhole(k, 640, 480),
                &options(),
                &mut (),
            )
        })
    });
    let plane = world(3, 1000, 0.4, PLANE);
    group.bench_function("H 1000, 40 % outliers", |b| {
        b.iter(|| estimate_homography(&plane.pixels1, &plane.pixels2, &options(), &mut ()))
    });
    let few = world(4, 200, 0.3, CUBE);
    group.bench_function("F 200, 30 % outliers", |b| {
        b.iter(|| estimate_fundamental(&few.pixels1, &few.pixels2, &options(), &mut ()))
    });
    group.finish();
}

fn triangulation(c: &mut Criterion) {
    let s = world(5, 100_000, 0.0, CUBE);
    let (p1, p2) = (s.camera1.projection_matrix(), s.camera2.projection_matrix());
    let mut group = c.benchmark_group("triangulation");
    group.sample_size(20);
    group.bench_function("DLT of 100 000 pairs", |b| {
        b.iter(|| triangulate_dlt_all(&p1, &p2, &s.pixels1, &s.pixels2))
    });
    group.finish();
}

criterion_group!(benches, solvers, robust, triangulation);
criterion_main!(benches);
