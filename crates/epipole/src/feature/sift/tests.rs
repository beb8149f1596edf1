//! End-to-end tests of SIFT.

use super::*;
use crate::Error;
use crate::feature::{Descriptors, Keypoint};
use crate::imaging::GrayImage32;
use crate::imaging::fixture;
use crate::progress::{Stage, Status};
use std::f32::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;

fn blobs(width: u32, height: u32) -> GrayImage32 {
    let mut random = crate::math::random::Random::new(5);
    let spots: Vec<[f64; 4]> = (0..60)
        .map(|_| {
            [
                random.uniform(0.0, f64::from(width)),
                random.uniform(0.0, f64::from(height)),
                random.uniform(1.5, 9.0),
                random.uniform(-0.4, 0.4),
            ]
        })
        .collect();
    GrayImage32::from_fn(width, height, |u, v| {
        let mut value = 0.5;
        for [x, y, size, height] in &spots {
            let (dx, dy) = ((f64::from(u) - x) / size, (f64::from(v) - y) / (1.4 * size));
            value += height * libm::exp(-0.5 * (dx * dx + 0.3 * dx * dy + dy * dy));
        }
        image::Luma([value as f32])
    })
}

/// Fraction of keypoints with a partner within `px`, and the mean distance of partners.
fn partners(a: &[Keypoint], b: &[Keypoint], map: impl Fn(f64, f64) -> (f64, f64), px: f64) -> f64 {
    let near = a.iter().filter(|p| {
        let (u, v) = map(p.u, p.v);
        b.iter().any(|q| {
            (q.u - u).abs() <= px
                && (q.v - v).abs() <= px
                && (q.scale_px / p.scale_px - 1.0).abs() < 0.02
        })
    });
    near.count() as f64 / a.len() as f64
}

#[test]
fn mirrored_and_rotated_images_give_mirrored_and_rotated_keypoints() {
    for (width, height) in [(160, 120), (161, 119), (150, 131)] {
        let image = blobs(width, height);
        let (right, bottom) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
        for upsample in [true, false] {
            let options = SiftOptions {
                upsample,
                ..SiftOptions::default()
            };
            let detect =
                |image: &GrayImage32| detect_sift(image, &options, &mut ()).unwrap().keypoints;
            let here = detect(&image);
            assert!(here.len() > 20, "{}", here.len());
            let mirrored = detect(&image::imageops::flip_horizontal(&image));
            let rotated = detect(&image::imageops::rotate180(&image));
            assert_eq!(here.len(), mirrored.len());
            assert_eq!(here.len(), rotated.len());
            let mirror = |u, v| (right - u, v);
            assert_eq!(partners(&here, &mirrored, mirror, 0.02), 1.0);
            let rotate = |u, v| (right - u, bottom - v);
            assert_eq!(partners(&here, &rotated, rotate, 0.02), 1.0);
        }
    }
}

#[test]
fn a_blob_is_found_at_its_center_and_size() {
    for size in [2.0, 4.0, 7.0] {
        let (x, y) = (40.3, 37.8);
        let blob = GrayImage32::from_fn(81, 77, |u, v| {
            let (dx, dy) = (f64::from(u) - x, f64::from(v) - y);
            image::Luma([libm::exp(-0.5 * (dx * dx + dy * dy) / (size * size)) as f32])
        });
        let features = detect_sift(&blob, &SiftOptions::default(), &mut ()).unwrap();
        let best = features.keypoints[0];
        // The fitted quadratic is accurate to a twentieth of a sample of its octave.
        let off = (best.u - x).abs().max((best.v - y).abs());
        assert!(off < 0.05 * libm::exp2(f64::from(best.octave)), "{best:?}");
        // Blur s has the maximum response to a Gaussian blob of size t if k s² = t², k = 2^(1/3).
        let expected = size / libm::exp2(1.0 / 6.0);
        assert!(
            (f64::from(best.scale_px) / expected - 1.0).abs() < 0.05,
            "{best:?}"
        );
    }
}

#[test]
fn the_angle_points_up_the_gradient() {
    // A ramp under a blob: v grows downwards, so brighter below means +π/2.
    for (gu, gv, want) in [
        (0.0f32, 1.0f32, FRAC_PI_2),
        (1.0, 0.0, 0.0),
        (-1.0, 1.0, 0.75 * PI),
    ] {
        let image = GrayImage32::from_fn(64, 64, |u, v| {
            let (x, y) = (u as f32 - 32.0, v as f32 - 32.0);
            let blob = 0.4 / (1.0 + (x * x + y * y) / 20.0);
            image::Luma([0.4 + blob + 0.006 * (gu * x + gv * y)])
        });
        let features = detect_sift(&image, &SiftOptions::default(), &mut ()).unwrap();
        let best = features.keypoints[0];
        assert!((best.angle_rad - want).abs() < 0.1, "{best:?}");
    }
}

#[test]
fn options_change_what_they_name() {
    let image = blobs(160, 120);
    let base = SiftOptions::default();
    let all = detect_sift(&image, &base, &mut ()).unwrap();
    assert!(all.keypoints.is_sorted_by(|a, b| a.response >= b.response));
    assert_eq!(all.keypoints.len(), all.descriptors.len());

    let few = detect_sift(
        &image,
        &SiftOptions {
            max_features: 17,
            ..base
        },
        &mut (),
    )
    .unwrap();
    assert_eq!(few.keypoints, all.keypoints[..17]);
    assert_eq!(few.descriptors.get(16), all.descriptors.get(16));

    let upright = detect_sift(
        &image,
        &SiftOptions {
            upright: true,
            ..base
        },
        &mut (),
    )
    .unwrap();
    assert!(upright.keypoints.iter().all(|k| k.angle_rad == 0.0));
    assert!(upright.keypoints.len() <= all.keypoints.len());

    let root = SiftOptions {
        normalization: SiftNormalization::Root,
        ..base
    };
    let root = detect_sift(&image, &root, &mut ()).unwrap();
    assert_eq!(root.keypoints, all.keypoints);
    for features in [&all, &root] {
        for k in 0..features.descriptors.len() {
            let d = features.descriptors.get(k).unwrap();
            let norm = d.iter().map(|v| v * v).sum::<f32>().sqrt();
            assert!((norm - 512.0).abs() < 8.0, "{norm}");
        }
    }
}

#[test]
fn nothing_to_find_is_no_error() {
    for (w, h) in [
        (0, 0),
        (1, 1),
        (1, 90),
        (90, 1),
        (2, 2),
        (9, 9),
        (13, 300),
        (64, 48),
    ] {
        let flat = GrayImage32::from_pixel(w, h, image::Luma([0.5]));
        for upsample in [true, false] {
            let options = SiftOptions {
                upsample,
                ..SiftOptions::default()
            };
            let features = detect_sift(&flat, &options, &mut ()).unwrap();
            assert!(features.keypoints.is_empty() && features.descriptors.is_empty());
        }
    }
}

#[test]
fn bad_pixels_and_options_are_refused() {
    let mut image = blobs(40, 40);
    let bad = |change: fn(&mut SiftOptions)| {
        let mut options = SiftOptions::default();
        change(&mut options);
        assert!(detect_sift(&image, &options, &mut ()).is_err());
    };
    bad(|o| o.layers_per_octave = 0);
    bad(|o| o.layers_per_octave = 11);
    bad(|o| o.sigma_px = f64::NAN);
    bad(|o| o.input_blur_px = 3.0);
    bad(|o| o.contrast_threshold = -1.0);
    bad(|o| o.edge_threshold = 1.0);
    bad(|o| o.max_orientations = 0);
    bad(|o| o.orientation_peak_ratio = f32::NAN);
    image.put_pixel(3, 3, image::Luma([f32::NAN]));
    let result = detect_sift(&image, &SiftOptions::default(), &mut ());
    assert!(matches!(result, Err(Error::NotFinite { .. })));
}

#[test]
fn progress_rises_and_can_stop_the_work() {
    let image = blobs(160, 120);
    let mut fractions = Vec::new();
    let all = detect_sift(&image, &SiftOptions::default(), &mut |status: Status| {
        assert_eq!(status.stage, Stage::FeatureDetection);
        fractions.push(status.fraction);
        ControlFlow::Continue(())
    });
    // Five octaves have five blurs each, and three layers that are described.
    assert!(fractions.len() > 5 * (5 + 3), "{}", fractions.len());
    assert!(fractions.is_sorted() && fractions.iter().all(|s| *s <= 1.0));
    assert_eq!(
        all.unwrap(),
        detect_sift(&image, &SiftOptions::default(), &mut ()).unwrap()
    );
    let mut calls = 0;
    let stopped = detect_sift(&image, &SiftOptions::default(), &mut |_| {
        calls += 1;
        if calls < 3 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    });
    assert_eq!((stopped, calls), (Err(Error::Canceled), 3));
}

#[test]
fn more_layers_than_the_window_holds() {
    let image = blobs(120, 90);
    for layers_per_octave in [1, 2, 5, 8] {
        let options = SiftOptions {
            layers_per_octave,
            ..SiftOptions::default()
        };
        let features = detect_sift(&image, &options, &mut ()).unwrap();
        assert!(features.keypoints.len() > 10, "{layers_per_octave}");
    }
}

#[test]
fn keypoints_equal_those_of_opencv_where_both_find_them() {
    let image = crate::imaging::gray_to_f32(&fixture::gray8("sift_image.npy"));
    let expected = fixture::floats("sift_keypoints.npy");
    let ours = detect_sift(&image, &SiftOptions::default(), &mut ())
        .unwrap()
        .keypoints;
    let found = expected.values.chunks_exact(3).filter(|k| {
        ours.iter().any(|o| {
            let (du, dv) = (o.u - f64::from(k[0]), o.v - f64::from(k[1]));
            (du * du + dv * dv).sqrt() < 0.3 && (o.scale_px / k[2] - 1.0).abs() < 0.1
        })
    });
    let fraction = found.count() as f64 / expected.shape[0] as f64;
    assert!(
        fraction > 0.9,
        "{fraction} of {} (ours: {})",
        expected.shape[0],
        ours.len()
    );
}

/// An image with much detail.
fn photo() -> Option<GrayImage32> {
    let path = fixture::data("homography/graf/img1.png")?;
    let bytes = std::fs::read(path).unwrap();
    let options = epipole_io::photo::DecodeOptions::default();
    let whole = epipole_io::photo::decode_gray(&bytes, &options)
        .unwrap()
        .image;
    Some(image::imageops::crop_imm(&whole, 200, 120, 360, 360).to_image())
}

/// Ratio of the intersection and union of two discs; the radius is the keypoint's blur.
fn overlap(p: &Keypoint, q: &Keypoint) -> f64 {
    let (du, dv) = (p.u - q.u, p.v - q.v);
    let d = (du * du + dv * dv).sqrt();
    let (r, s) = (f64::from(p.scale_px), f64::from(q.scale_px));
    let pi = std::f64::consts::PI;
    let shared = if d >= r + s {
        0.0
    } else if d <= (r - s).abs() {
        pi * r.min(s) * r.min(s)
    } else {
        let a = libm::acos((d * d + r * r - s * s) / (2.0 * d * r));
        let b = libm::acos((d * d + s * s - r * r) / (2.0 * d * s));
        r * r * (a - libm::sin(2.0 * a) / 2.0) + s * s * (b - libm::sin(2.0 * b) / 2.0)
    };
    shared / (pi * (r * r + s * s) - shared)
}

/// For each keypoint, its largest overlap with one of `others`, and the index.
fn best_overlaps(keypoints: &[Keypoint], others: &[Keypoint]) -> Vec<(f64, usize)> {
    let best = |p: &Keypoint| {
        let all = others.iter().enumerate().map(|(k, q)| (overlap(p, q), k));
        all.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a })
    };
    keypoints.iter().map(best).collect()
}

fn fraction(part: usize, whole: usize) -> f64 {
    part as f64 / whole as f64
}

/// Thresholds and protocol of OpenCV's modules/features2d/test/test_descriptors_invariance.cpp and
/// test_detectors_invariance.cpp: repeated keypoints (overlap above one half), of these the angles
/// within 15°; nearest descriptors at the correct position.
#[test]
fn keypoints_and_descriptors_survive_rotation() {
    use crate::imaging::{Interpolation, WarpOptions, warp_affine};
    let Some(image) = photo() else { return };
    let options = SiftOptions::default();
    let (c, radius) = (179.5, 150.0);
    let detect = |image: &GrayImage32| {
        let mut features = detect_sift(image, &options, &mut ()).unwrap();
        let inside: Vec<usize> = (0..features.keypoints.len())
            .filter(|&k| {
                let (u, v) = (features.keypoints[k].u - c, features.keypoints[k].v - c);
                u * u + v * v < radius * radius
            })
            .collect();
        let bytes = features.descriptors.as_bytes().unwrap().chunks_exact(128);
        let bytes: Vec<&[u8]> = bytes.collect();
        let inner_bytes = inside.iter().flat_map(|&k| bytes[k]).copied().collect();
        let descriptors = Descriptors::from_bytes(128, inner_bytes).unwrap();
        features.keypoints = inside.iter().map(|&k| features.keypoints[k]).collect();
        features.descriptors = descriptors;
        features
    };
    let here = detect(&image);
    for degrees in (15..360).step_by(15) {
        let angle_rad = f64::from(degrees).to_radians();
        let (sin, cos) = (libm::sin(angle_rad), libm::cos(angle_rad));
        #[rustfmt::skip]
        let map = nalgebra::Matrix2x3::new(
            cos, -sin, c - cos * c + sin * c,
            sin, cos, c - sin * c - cos * c,
        );
        let warp = WarpOptions {
            interpolation: Interpolation::Bicubic,
            ..WarpOptions::new(image.width(), image.height())
        };
        let there = detect(&warp_affine(&image, &map, &warp, &mut ()).unwrap());
        let moved: Vec<Keypoint> = here
            .keypoints
            .iter()
            .map(|k| Keypoint {
                u: map[(0, 0)] * k.u + map[(0, 1)] * k.v + map[(0, 2)],
                v: map[(1, 0)] * k.u + map[(1, 1)] * k.v + map[(1, 2)],
                ..*k
            })
            .collect();
        let near =
            crate::feature::nearest_two(&here.descriptors, &there.descriptors, &mut ()).unwrap();
        let (mut found, mut angles, mut descriptors) = (0, 0, 0);
        for (k, (ratio, other)) in best_overlaps(&moved, &there.keypoints)
            .into_iter()
            .enumerate()
        {
            if ratio < 0.5 {
                continue;
            }
            found += 1;
            let q = &there.keypoints[other];
            let difference = f64::from(q.angle_rad - moved[k].angle_rad) - angle_rad;
            let difference = difference.rem_euclid(std::f64::consts::TAU);
            if difference.min(std::f64::consts::TAU - difference) < 15f64.to_radians() {
                angles += 1;
                let nearest = &there.keypoints[near[k].index];
                descriptors += usize::from(overlap(&moved[k], nearest) >= 0.5);
            }
        }
        let fractions = [
            fraction(found, moved.len()),
            fraction(angles, found),
            fraction(descriptors, angles),
        ];
        println!("{degrees}°: found, angles, descriptors {fractions:.3?}");
        assert!(
            fractions[0] >= 0.45 && fractions[1] >= 0.70 && fractions[2] >= 0.98,
            "{fractions:?}"
        );
    }
}

/// Likewise for smaller images: repeated keypoints, sizes within 4/5, descriptors.
#[test]
fn keypoints_and_descriptors_survive_scaling() {
    let Some(image) = photo() else { return };
    let options = SiftOptions::default();
    let here = detect_sift(&image, &options, &mut ()).unwrap();
    for scale in [1.5, 2.0, 2.5] {
        let side = (360.0 / scale) as u32;
        let small = crate::imaging::resize(&image, side, side).unwrap();
        let there = detect_sift(&small, &options, &mut ()).unwrap();
        let grown: Vec<Keypoint> = there
            .keypoints
            .iter()
            .map(|k| Keypoint {
                u: (k.u + 0.5) * scale - 0.5,
                v: (k.v + 0.5) * scale - 0.5,
                scale_px: k.scale_px * scale as f32,
                ..*k
            })
            .collect();
        let near =
            crate::feature::nearest_two(&there.descriptors, &here.descriptors, &mut ()).unwrap();
        let (mut found, mut sizes, mut descriptors) = (0, 0, 0);
        for (k, (ratio, other)) in best_overlaps(&grown, &here.keypoints)
            .into_iter()
            .enumerate()
        {
            if ratio < 0.5 {
                continue;
            }
            found += 1;
            let (a, b) = (grown[k].scale_px, here.keypoints[other].scale_px);
            sizes += usize::from(a.min(b) > 0.8 * a.max(b));
            let nearest = &here.keypoints[near[k].index];
            descriptors += usize::from(overlap(&grown[k], nearest) >= 0.5);
        }
        let fractions = [
            fraction(found, grown.len()),
            fraction(sizes, found),
            fraction(descriptors, found),
        ];
        println!("1/{scale}: found, sizes, descriptors {fractions:.3?}");
        assert!(
            fractions[0] >= 0.69 && fractions[1] >= 0.98 && fractions[2] >= 0.78,
            "{fractions:?}"
        );
    }
}
