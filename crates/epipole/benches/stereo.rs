//! Dense stereo and rectification at the sizes that the peers are timed at: 640×480, 64
//! disparities.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use epipole::camera::{Camera, Distortion, Intrinsics, RigidTransform};
use epipole::math::random::Random;
use epipole::stereo::{
    RectifyOptions, StereoBm, StereoPaths, StereoSgm, fill_gaps, rectify_calibrated,
};
use image::{GrayImage, Luma};
use std::hint::black_box;

const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;

/// A slanted, textured wall: disparities from 5 to 37 px.
fn pair() -> (GrayImage, GrayImage) {
    let mut random = Random::new(1);
    let columns = WIDTH as usize + 100;
    let noise: Vec<f64> = (0..columns * HEIGHT as usize)
        .map(|_| random.uniform(0.0, 255.0))
        .collect();
    let at = |u: f64, v: u32| {
        let k = (u as usize).min(columns - 2);
        let row = v as usize * columns;
        let fraction = u - k as f64;
        (noise[row + k] * (1.0 - fraction) + noise[row + k + 1] * fraction) as u8
    };
    let left = GrayImage::from_fn(WIDTH, HEIGHT, |u, v| Luma([at(f64::from(u), v)]));
    let right = GrayImage::from_fn(WIDTH, HEIGHT, |u, v| {
        Luma([at((f64::from(u) + 5.0) / 0.95, v)])
    });
    (left, right)
}

fn dense(criterion: &mut Criterion) {
    let (left, right) = pair();
    let mut group = criterion.benchmark_group("stereo-640x480x64");
    group.sample_size(20);
    group.throughput(Throughput::Elements(u64::from(WIDTH * HEIGHT * 64)));
    let bm = StereoBm::default();
    group.bench_function("block-matching", |bencher| {
        bencher.iter(|| bm.compute(black_box(&left), black_box(&right), &mut ()));
    });
    let plain = StereoBm::default().with_filter(
        StereoBm::default()
            .filter
            .with_left_right_max_px(None)
            .with_speckle_size(0),
    );
    group.bench_function("block-matching-plain", |bencher| {
        bencher.iter(|| plain.compute(black_box(&left), black_box(&right), &mut ()));
    });
    for (name, paths) in [
        ("semi-global-4", StereoPaths::Four),
        ("semi-global-5", StereoPaths::Five),
        ("semi-global-8", StereoPaths::Eight),
    ] {
        let sgm = StereoSgm::default().with_paths(paths);
        group.bench_function(name, |bencher| {
            bencher.iter(|| sgm.compute(black_box(&left), black_box(&right), &mut ()));
        });
    }
    group.finish();
    let disparity = StereoSgm::default().compute(&left, &right, &mut ());
    if let Ok(disparity) = disparity {
        criterion.bench_function("stereo-fill-640x480", |bencher| {
            bencher.iter(|| fill_gaps(black_box(&disparity), &left, &mut ()));
        });
    }
}

fn rectification(criterion: &mut Criterion) {
    let (left, _) = pair();
    let camera = || -> epipole::Result<Camera> {
        Ok(Camera {
            width: WIDTH,
            height: HEIGHT,
            intrinsics: Intrinsics::centered(460.0, WIDTH, HEIGHT)?,
            lens: Distortion::from_coefficients([-0.28, 0.07, 0.0002, 0.0, 0.0])?.into(),
        })
    };
    let rig = || {
        let motion = RigidTransform::translation(-0.1, 0.002, -0.001);
        let options = RectifyOptions::default();
        rectify_calibrated(&[camera()?, camera()?], &motion, &options)
    };
    let map = rig().and_then(|rig| rig.map(0, &mut ()));
    criterion.bench_function("rectify-map-640x480", |bencher| {
        bencher.iter(|| rig().and_then(|rig| rig.map(0, &mut ())));
    });
    if let Ok(map) = map {
        criterion.bench_function("rectify-warp-640x480", |bencher| {
            bencher.iter(|| map.warp(black_box(&left), &mut ()));
        });
    }
}

criterion_group!(benches, dense, rectification);
criterion_main!(benches);
