//! Times of the solvers, of robust estimation and of triangulation.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use epipole::absolute_pose::pose_p3p;
use epipole::camera::{Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{essential_5point, fundamental_7point, fundamental_8point};
use epipole::homography::homography_4point;
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use epipole::triangulation::triangulate_dlt_all;
use epipole::{
    estimate_absolute_pose, estimate_fundamental, estimate_homography, estimate_relative_pose,
};
use nalgebra::{Point2, Point3, Vector3};

struct Scene {
    points: Vec<Point3<f64>>,
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
    left: PosedCamera,
    right: PosedCamera,
}

/// `num_matches` matches in random order, half a pixel of noise.
fn scene(seed: u64, num_matches: usize, share_true: f64, plane: bool) -> Scene {
    let mut random = Random::new(seed);
    let intrinsics = Intrinsics::centered(800.0, 640, 480).expect("a valid camera");
    let left = PosedCamera {
        intrinsics,
        cam_from_world: RigidTransform::identity(),
    };
    let right = PosedCamera {
        intrinsics,
        cam_from_world: RigidTransform::new(
            Vector3::new(-0.6, 0.1, 0.1),
            Vector3::new(0.03, 0.12, -0.05),
        ),
    };
    let (mut points, mut p1, mut p2) = (Vec::new(), Vec::new(), Vec::new());
    while p1.len() < num_matches {
        let depth = if plane { 5.0 } else { random.uniform(3.0, 7.0) };
        let point = Point3::new(random.uniform(-1.5, 1.5), random.uniform(-1.1, 1.1), depth);
        let (Ok(a), Ok(mut b)) = (left.project(&point), right.project(&point)) else {
            continue;
        };
        if random.unit() > share_true {
            b = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        }
        let mut noisy =
            |p: Point2<f64>| Point2::new(p.x + 0.5 * random.normal(), p.y + 0.5 * random.normal());
        p1.push(noisy(a));
        p2.push(noisy(b));
        points.push(point);
    }
    Scene {
        points,
        p1,
        p2,
        left,
        right,
    }
}

fn solvers(c: &mut Criterion) {
    let mut group = c.benchmark_group("solver");
    let s = scene(1, 100, 1.0, false);
    let k = s.left.intrinsics;
    let first = |p: &[Point2<f64>], i: usize| p[i];
    let (p7, q7) = (
        core::array::from_fn(|i| first(&s.p1, i)),
        core::array::from_fn(|i| first(&s.p2, i)),
    );
    group.bench_function("F7", |b| {
        b.iter(|| fundamental_7point(black_box(&p7), black_box(&q7)))
    });
    group.bench_function("F8", |b| {
        b.iter(|| fundamental_8point(black_box(&s.p1[..8]), black_box(&s.p2[..8])))
    });
    group.bench_function("F8 of 100", |b| {
        b.iter(|| fundamental_8point(black_box(&s.p1), black_box(&s.p2)))
    });
    let (r1, r2) = (
        core::array::from_fn(|i| k.ray(&s.p1[i])),
        core::array::from_fn(|i| k.ray(&s.p2[i])),
    );
    group.bench_function("E5", |b| {
        b.iter(|| essential_5point(black_box(&r1), black_box(&r2)))
    });
    let (p4, q4) = (
        core::array::from_fn(|i| s.p1[i]),
        core::array::from_fn(|i| s.p2[i]),
    );
    group.bench_function("H4", |b| {
        b.iter(|| homography_4point(black_box(&p4), black_box(&q4)))
    });
    let (rays, points) = (
        core::array::from_fn(|i| k.ray(&s.p2[i])),
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
        RansacOptions {
            seed,
            ..RansacOptions::default()
        }
    };
    let s = scene(2, 1000, 0.6, false);
    let k = s.left.intrinsics;
    group.bench_function("F 1000, 40 % outliers", |b| {
        b.iter(|| estimate_fundamental(&s.p1, &s.p2, &options()))
    });
    group.bench_function("E 1000, 40 % outliers", |b| {
        b.iter(|| estimate_relative_pose(&s.p1, &s.p2, &k, &k, &options()))
    });
    group.bench_function("P3P 1000, 40 % outliers", |b| {
        b.iter(|| estimate_absolute_pose(&s.points, &s.p2, &k, &options()))
    });
    let plane = scene(3, 1000, 0.6, true);
    group.bench_function("H 1000, 40 % outliers", |b| {
        b.iter(|| estimate_homography(&plane.p1, &plane.p2, &options()))
    });
    let few = scene(4, 200, 0.7, false);
    group.bench_function("F 200, 30 % outliers", |b| {
        b.iter(|| estimate_fundamental(&few.p1, &few.p2, &options()))
    });
    group.finish();
}

fn triangulation(c: &mut Criterion) {
    let s = scene(5, 100_000, 1.0, false);
    let (p1, p2) = (s.left.projection_matrix(), s.right.projection_matrix());
    let mut group = c.benchmark_group("triangulation");
    group.sample_size(20);
    group.bench_function("DLT of 100 000 pairs", |b| {
        b.iter(|| triangulate_dlt_all(&p1, &p2, &s.p1, &s.p2))
    });
    group.finish();
}

criterion_group!(benches, solvers, robust, triangulation);
criterion_main!(benches);
