//! Tests of SIFT as a whole.

use super::*;
use crate::imaging::fixture;
use std::f32::consts::{FRAC_PI_2, PI};

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

/// Share of keypoints with a partner within `px`, and the mean distance of partners.
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
fn mirrored_and_turned_images_give_mirrored_and_turned_keypoints() {
    for (width, height) in [(160, 120), (161, 119), (150, 131)] {
        let image = blobs(width, height);
        let (right, bottom) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
        for upsample in [true, false] {
            let options = SiftOptions {
                upsample,
                ..SiftOptions::default()
            };
            let detect = |image: &GrayImage32| detect_sift(image, &options).unwrap().keypoints;
            let here = detect(&image);
            assert!(here.len() > 20, "{}", here.len());
            let mirrored = detect(&image::imageops::flip_horizontal(&image));
            let turned = detect(&image::imageops::rotate180(&image));
            assert_eq!(here.len(), mirrored.len());
            assert_eq!(here.len(), turned.len());
            let mirror = |u, v| (right - u, v);
            assert_eq!(partners(&here, &mirrored, mirror, 0.02), 1.0);
            let turn = |u, v| (right - u, bottom - v);
            assert_eq!(partners(&here, &turned, turn, 0.02), 1.0);
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
        let features = detect_sift(&blob, &SiftOptions::default()).unwrap();
        let best = features.keypoints[0];
        // What the fitted quadratic misses grows with the blob.
        let off = (best.u - x).abs().max((best.v - y).abs());
        assert!(off < 0.01 * size, "{best:?}");
        // Blur s answers most to a Gaussian blob of size t where k s² = t², k = 2^(1/3).
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
        let features = detect_sift(&image, &SiftOptions::default()).unwrap();
        let best = features.keypoints[0];
        assert!((best.angle_rad - want).abs() < 0.1, "{best:?}");
    }
}

#[test]
fn options_change_what_they_name() {
    let image = blobs(160, 120);
    let base = SiftOptions::default();
    let all = detect_sift(&image, &base).unwrap();
    assert!(all.keypoints.is_sorted_by(|a, b| a.response >= b.response));
    assert_eq!(all.keypoints.len(), all.descriptors.len());

    let few = detect_sift(
        &image,
        &SiftOptions {
            max_features: 17,
            ..base
        },
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
    )
    .unwrap();
    assert!(upright.keypoints.iter().all(|k| k.angle_rad == 0.0));
    assert!(upright.keypoints.len() <= all.keypoints.len());

    let root = SiftOptions {
        normalization: SiftNormalization::Root,
        ..base
    };
    let root = detect_sift(&image, &root).unwrap();
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
            let features = detect_sift(&flat, &options).unwrap();
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
        assert!(detect_sift(&image, &options).is_err());
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
    let result = detect_sift(&image, &SiftOptions::default());
    assert!(matches!(result, Err(Error::NotFinite { .. })));
}

#[test]
fn progress_rises_and_can_stop_the_work() {
    let image = blobs(160, 120);
    let mut shares = Vec::new();
    let all = detect_sift_with_progress(&image, &SiftOptions::default(), &mut |share| {
        shares.push(share);
        true
    });
    assert!(shares.len() > 4 && shares.is_sorted() && shares.iter().all(|s| *s <= 1.0));
    assert_eq!(
        all.unwrap(),
        detect_sift(&image, &SiftOptions::default()).unwrap()
    );
    let mut calls = 0;
    let stopped = detect_sift_with_progress(&image, &SiftOptions::default(), &mut |_| {
        calls += 1;
        calls < 3
    });
    assert_eq!((stopped, calls), (Err(Error::Cancelled), 3));
}

#[test]
fn more_layers_than_the_window_holds() {
    let image = blobs(120, 90);
    for layers_per_octave in [1, 2, 5, 8] {
        let options = SiftOptions {
            layers_per_octave,
            ..SiftOptions::default()
        };
        let features = detect_sift(&image, &options).unwrap();
        assert!(features.keypoints.len() > 10, "{layers_per_octave}");
    }
}

#[test]
fn keypoints_equal_those_of_opencv_where_both_find_them() {
    let image = crate::imaging::gray_to_f32(&fixture::gray8("sift_image.npy"));
    let expected = fixture::floats("sift_keypoints.npy");
    let ours = detect_sift(&image, &SiftOptions::default())
        .unwrap()
        .keypoints;
    let found = expected.values.chunks_exact(3).filter(|k| {
        ours.iter().any(|o| {
            let (du, dv) = (o.u - f64::from(k[0]), o.v - f64::from(k[1]));
            (du * du + dv * dv).sqrt() < 0.3 && (o.scale_px / k[2] - 1.0).abs() < 0.1
        })
    });
    let share = found.count() as f64 / expected.shape[0] as f64;
    assert!(
        share > 0.9,
        "{share} of {} (ours: {})",
        expected.shape[0],
        ours.len()
    );
}
