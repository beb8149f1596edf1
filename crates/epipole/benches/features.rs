//! Filters, Harris, SIFT and matching, on images and descriptors made from a seed.

use criterion::{Criterion, criterion_group, criterion_main};
use epipole::feature::{
    Descriptors, OrbOptions, SiftOptions, StructureTensorOptions, detect_orb, detect_sift,
    harris_response, nearest_two,
};
use epipole::imaging::{
    Border, GrayImage32, gaussian_blur, gaussian_kernel, separable_filter, sobel,
};
use epipole::math::random::Random;
use std::hint::black_box;

/// Rectangles of random size and gray, a little blurred: corners and blobs at all scales.
fn scene(width: u32, height: u32) -> GrayImage32 {
    let mut random = Random::new(1);
    let mut image = GrayImage32::from_pixel(width, height, image::Luma([0.5]));
    for _ in 0..width * height / 300 {
        let (x, y) = (
            random.below(width as usize) as u32,
            random.below(height as usize) as u32,
        );
        let (w, h) = (random.below(30) as u32 + 2, random.below(30) as u32 + 2);
        let gray = random.unit() as f32;
        for v in y..(y + h).min(height) {
            for u in x..(x + w).min(width) {
                image.put_pixel(u, v, image::Luma([gray]));
            }
        }
    }
    gaussian_blur(&image, 0.8, Border::Reflect101, &mut ()).expect("a valid blur")
}

fn filters(criterion: &mut Criterion) {
    let frame = scene(1280, 720);
    let kernel = gaussian_kernel(1.1, 5).expect("a valid kernel");
    criterion.bench_function("sobel both 1280x720", |b| {
        b.iter(|| sobel(black_box(&frame), Border::Reflect101));
    });
    criterion.bench_function("gaussian 5x5 1280x720", |b| {
        b.iter(|| {
            separable_filter(
                black_box(&frame),
                &kernel,
                &kernel,
                Border::Reflect101,
                &mut (),
            )
        });
    });
    let options = StructureTensorOptions::default();
    criterion.bench_function("harris 1280x720", |b| {
        b.iter(|| harris_response(black_box(&frame), 0.04, &options, &mut ()));
    });
}

fn features(criterion: &mut Criterion) {
    let image = scene(800, 640);
    let mut group = criterion.benchmark_group("features");
    group.sample_size(10);
    group.bench_function("sift 800x640", |b| {
        b.iter(|| detect_sift(black_box(&image), &SiftOptions::default(), &mut ()));
    });
    group.bench_function("orb 800x640", |b| {
        b.iter(|| detect_orb(black_box(&image), &OrbOptions::default(), &mut ()));
    });
    let mut random = Random::new(2);
    let mut list = || -> Vec<u8> { (0..2048 * 128).map(|_| random.below(160) as u8).collect() };
    let bytes = [list(), list()].map(|v| Descriptors::from_bytes(128, v).expect("whole rows"));
    group.bench_function("two nearest 2048x2048x128", |b| {
        b.iter(|| nearest_two(black_box(&bytes[0]), black_box(&bytes[1]), &mut ()));
    });
    group.finish();
}

criterion_group!(benches, filters, features);
criterion_main!(benches);
