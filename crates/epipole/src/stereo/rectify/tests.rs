//! Rectification of rotated and converging rigs.

use super::cover::LARGEST_CROP;
use super::*;
use crate::Error;
use crate::camera::{Camera, Distortion, Intrinsics, Lens, LensKind, RigidTransform};
use crate::math::random::Random;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3, Vector4};

fn camera(fu: f64, fv: f64, cu: f64, cv: f64, k: [f64; 5]) -> Camera {
    Camera {
        width: 752,
        height: 480,
        intrinsics: Intrinsics::new(fu, fv, cu, cv).unwrap(),
        lens: Lens::Brown(Distortion::from_coefficients(k).unwrap()),
    }
}

/// Returns the camera with another image size.
fn sized(camera: Camera, width: u32, height: u32) -> Camera {
    Camera {
        width,
        height,
        ..camera
    }
}

fn motion(rotation: [f64; 3], translation: [f64; 3]) -> RigidTransform {
    RigidTransform::from_parts(
        Vector3::from(translation).into(),
        UnitQuaternion::from_scaled_axis(Vector3::from(rotation)),
    )
}

fn project(camera: &Camera, x_in_cam: &Point3<f64>) -> Point2<f64> {
    camera.project(x_in_cam).unwrap()
}

fn wide_rig() -> [Camera; 2] {
    [
        camera(
            458.654,
            457.296,
            367.215,
            248.375,
            [-0.2834, 0.074, 0.0002, 1.8e-5, 0.0],
        ),
        camera(
            457.587,
            456.134,
            379.999,
            255.238,
            [-0.2837, 0.0745, -0.0001, -3.6e-5, 0.0],
        ),
    ]
}

/// World points project to the same row or column, with the disparity that Q converts back to their
/// position, the right way up.
#[test]
fn matches_share_a_line_and_q_gives_them_back() {
    let mut random = Random::new(5);
    for (rotation, translation, vertical) in [
        ([0.0141, -0.0004, -0.0023], [-0.11, 0.0004, -0.0009], false),
        ([0.1, 0.15, -0.2], [-0.2, 0.05, 0.06], false),
        ([0.02, -0.1, 0.1], [0.03, -0.15, 0.02], true),
        ([0.02, 0.1, 0.1], [0.01, 0.15, 0.02], true),
        ([0.0, 0.0, 0.0], [0.3, 0.0, 0.0], false),
    ] {
        let cam2_from_cam1 = motion(rotation, translation);
        for (alpha, same) in [(0.0, true), (1.0, true), (0.5, false)] {
            let options = RectifyOptions {
                alpha,
                zero_disparity_at_infinity: same,
                ..Default::default()
            };
            let cameras = wide_rig();
            let rig = rectify_calibrated(&cameras, &cam2_from_cam1, &options).unwrap();
            assert_eq!(rig.is_vertical, vertical);
            let mut tested = 0;
            for _ in 0..200 {
                let x1 = Point3::new(
                    random.uniform(-1.0, 1.0),
                    random.uniform(-0.7, 0.7),
                    random.uniform(1.5, 6.0),
                );
                let x2 = cam2_from_cam1 * x1;
                if x2.z < 1.0 || x2.x.abs() > 0.9 * x2.z || x2.y.abs() > 0.7 * x2.z {
                    continue;
                }
                tested += 1;
                let [p1, p2] = [(0, x1), (1, x2)].map(|(i, x)| {
                    let pixel = project(&cameras[i], &x);
                    let p = rig.rectify_pixel(i, &pixel).unwrap();
                    let back = rig.source_pixel(i, &p).unwrap().unwrap();
                    assert!((back - pixel).norm() < 1e-7);
                    p
                });
                let d = p1 - p2;
                let (along, across) = if vertical { (d.y, d.x) } else { (d.x, d.y) };
                assert!(across.abs() < 1e-7, "off by {across}");
                let x = rig.q * Vector4::new(p1.x, p1.y, along, 1.0);
                let found = Point3::new(x.x / x.w, x.y / x.w, x.z / x.w);
                assert!((found - rig.rect_from_cam[0] * x1).norm() < 1e-6);
            }
            assert!(tested > 50);
            for (rotation, h) in rig.rect_from_cam.iter().zip(&rig.homographies) {
                assert!(rotation.angle() < 0.6, "turned by {}", rotation.angle());
                // Up stays up.
                let m = rotation.matrix();
                assert!(m[(0, 0)] > 0.7 && m[(1, 1)] > 0.7);
                assert!(h.determinant() > 0.0);
            }
        }
    }
}

/// The second camera is to the side and ahead: up to 60° off the image plane there is an overlap,
/// or the error states the limit.
#[test]
fn a_baseline_far_off_the_image_plane_is_rectified() {
    for off_deg in [30.0_f64, 37.0, 45.0, 55.0] {
        let off = off_deg.to_radians();
        let mut num_rectified = 0;
        for focal_px in [300.0, 500.0, 700.0, 1000.0, 2000.0, 5000.0] {
            let lens = camera(focal_px, focal_px, 319.5, 239.5, [0.0; 5]);
            let (sideways, ahead) = (-0.3 * libm::cos(off), -0.3 * libm::sin(off));
            let corner = libm::atan(319.5 / focal_px);
            let half = sideways * core::f64::consts::FRAC_1_SQRT_2;
            for translation in [
                [sideways, 0.0, ahead],
                [0.0, -sideways, ahead],
                [half, half, ahead],
                [0.5 * sideways, -0.75_f64.sqrt() * sideways, ahead],
            ] {
                let cam2_from_cam1 = motion([0.0; 3], translation);
                for alpha in [0.0, 1.0] {
                    let options = RectifyOptions {
                        alpha,
                        ..Default::default()
                    };
                    let rig =
                        rectify_calibrated(&[sized(lens, 640, 480); 2], &cam2_from_cam1, &options);
                    let rig = match rig {
                        Ok(rig) => rig,
                        Err(error) => {
                            assert!(corner + off > 1.45, "{off_deg}° at {focal_px} px: {error}");
                            assert!(error.to_string().contains("along the baseline"));
                            continue;
                        }
                    };
                    num_rectified += 1;
                    for i in 0..2 {
                        let valid = rig.valid[i];
                        let size = (valid.u_max - valid.u_min, valid.v_max - valid.v_min);
                        let least = (1.0 - alpha) * 0.999;
                        assert!(size.0 > least * 639.0, "{focal_px} {valid:?}");
                        assert!(size.1 > least * 479.0, "{focal_px} {valid:?}");
                        for (u, v) in [
                            (valid.u_min, valid.v_min),
                            (valid.u_max, valid.v_min),
                            (valid.u_min, valid.v_max),
                            (valid.u_max, valid.v_max),
                        ] {
                            let source = rig.source_pixel(i, &Point2::new(u, v)).unwrap();
                            let p = source.unwrap();
                            assert!((-1e-6..639.0 + 1e-6).contains(&p.x), "{p}");
                            assert!((-1e-6..479.0 + 1e-6).contains(&p.y), "{p}");
                        }
                    }
                    let x1 = Point3::new(0.1, -0.2, 9.0);
                    let x2 = cam2_from_cam1 * x1;
                    let p1 = rig.rectify_pixel(0, &project(&lens, &x1)).unwrap();
                    let p2 = rig.rectify_pixel(1, &project(&lens, &x2)).unwrap();
                    let across = 1 - usize::from(rig.is_vertical);
                    assert!((p1 - p2)[across].abs() < 1e-6);
                    let d = (p1 - p2)[1 - across];
                    let x = rig.q * Vector4::new(p1.x, p1.y, d, 1.0);
                    let found = Point3::new(x.x / x.w, x.y / x.w, x.z / x.w);
                    assert!((found - rig.rect_from_cam[0] * x1).norm() < 1e-6);
                }
            }
        }
        assert!(num_rectified >= 12, "{off_deg}°: {num_rectified}");
    }
    // The limit is that of the error, whichever way the baseline slants in the image plane.
    let lens = camera(2000.0, 2000.0, 319.5, 239.5, [0.0; 5]);
    for slant_deg in (0..180).step_by(15) {
        let (sin, cos) = libm::sincos(f64::from(slant_deg).to_radians());
        for (off_deg, is_within) in [(59.9_f64, true), (60.1, false)] {
            let (ahead, sideways) = libm::sincos(off_deg.to_radians());
            let motion = motion([0.0; 3], [-sideways * cos, -sideways * sin, -ahead]);
            let rig = rectify_calibrated(
                &[sized(lens, 640, 480); 2],
                &motion,
                &RectifyOptions::default(),
            );
            match rig {
                Ok(_) => assert!(is_within, "{slant_deg}° {off_deg}°"),
                Err(error) => {
                    assert!(!is_within, "{slant_deg}° {off_deg}°: {error}");
                    assert!(error.to_string().contains("60°"));
                }
            }
        }
    }
}

/// A model fitted to marks in the middle often folds before the corners: the rest of the image is
/// rectified, and content beyond the fold is not shown.
#[test]
fn images_whose_lens_folds_before_the_corners_are_rectified() {
    let folding = |k1: f64| Camera {
        width: 800,
        height: 600,
        intrinsics: Intrinsics::new(700.0, 702.0, 400.0, 300.0).unwrap(),
        lens: Lens::Brown(Distortion {
            k1,
            ..Distortion::NONE
        }),
    };
    let cam2_from_cam1 = motion([0.02, 0.03, -0.01], [-0.2, 0.01, 0.02]);
    for k1 in [-0.6, -0.9] {
        let cameras = [folding(k1); 2];
        assert!(cameras[0].unproject(&Point2::new(0.0, 0.0)).is_err());
        for alpha in [0.0, 1.0] {
            let options = RectifyOptions {
                alpha,
                ..Default::default()
            };
            let rig = rectify_calibrated(&cameras, &cam2_from_cam1, &options).unwrap();
            let x = Point3::new(0.1, -0.1, 2.0);
            let [a, b] = [(0, x), (1, cam2_from_cam1 * x)]
                .map(|(i, x)| rig.rectify_pixel(i, &project(&cameras[i], &x)).unwrap());
            assert!((a.y - b.y).abs() < 1e-6);
            for i in 0..2 {
                let valid = rig.valid[i];
                assert!(valid.u_max - valid.u_min > 100.0 && valid.v_max - valid.v_min > 100.0);
                for n in 0..=400 {
                    let fraction = |k: i32| f64::from(k) / 20.0;
                    let u = valid.u_min + fraction(n % 21) * (valid.u_max - valid.u_min);
                    let v = valid.v_min + fraction(n / 21) * (valid.v_max - valid.v_min);
                    let p = rig.source_pixel(i, &Point2::new(u, v)).unwrap();
                    let p = p.unwrap_or_else(|| panic!("{k1} {alpha}: nothing at {u}, {v}"));
                    assert!((-0.1..799.1).contains(&p.x) && (-0.1..599.1).contains(&p.y));
                }
            }
        }
    }
    let error = rectify_calibrated(
        &[folding(-3.0); 2],
        &cam2_from_cam1,
        &RectifyOptions::default(),
    );
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("folds inside of the picture")
    );
}

/// A second camera above and beside the first, or one of the two rolled: the rectified images are
/// slanted, yet a good part of them is visible, at any angle.
#[test]
fn slanted_cameras_are_rectified() {
    let lens = camera(800.0, 800.0, 399.5, 299.5, [-0.1, 0.02, 0.0, 0.0, 0.0]);
    for slant_deg in (0..=360).step_by(9) {
        let slant = f64::from(slant_deg).to_radians();
        let (sideways, up) = (-0.2 * libm::cos(slant), -0.2 * libm::sin(slant));
        for shares_infinity in [true, false] {
            for alpha in [0.0, 1.0] {
                let options = RectifyOptions {
                    alpha,
                    zero_disparity_at_infinity: shares_infinity,
                    ..Default::default()
                };
                // The cameras also converge by 7°.
                let cam2_from_cam1 = motion([0.02, 0.12, 0.03], [sideways, up, 0.03]);
                let rig =
                    rectify_calibrated(&[sized(lens, 800, 600); 2], &cam2_from_cam1, &options);
                let rig = rig.unwrap_or_else(|error| panic!("{slant_deg}°: {error}"));
                let focal_px = rig.intrinsics[0].fu_px();
                // Images rotated by 45° leave a rectangle that fills the results at 1340 px. To
                // keep the principal points in the middle may cost at most twice that.
                assert!(
                    focal_px < LARGEST_CROP * 1340.0,
                    "{slant_deg}°: {focal_px} px"
                );
                for i in 0..2 {
                    let valid = rig.valid[i];
                    assert!(valid.u_max > valid.u_min && valid.v_max > valid.v_min);
                    for k in 0..=20 {
                        let fraction = f64::from(k) / 20.0;
                        let u = valid.u_min + fraction * (valid.u_max - valid.u_min);
                        let v = valid.v_min + fraction * (valid.v_max - valid.v_min);
                        for (u, v) in [
                            (u, valid.v_min),
                            (u, valid.v_max),
                            (valid.u_min, v),
                            (valid.u_max, v),
                        ] {
                            let p = rig.source_pixel(i, &Point2::new(u, v)).unwrap().unwrap();
                            // Borders are sampled in 64 steps per side.
                            assert!((-0.1..799.1).contains(&p.x), "{slant_deg}°: {p}");
                            assert!((-0.1..599.1).contains(&p.y), "{slant_deg}°: {p}");
                        }
                    }
                }
                let x1 = Point3::new(0.05, -0.1, 2.0);
                let x2 = cam2_from_cam1 * x1;
                let p1 = rig.rectify_pixel(0, &project(&lens, &x1)).unwrap();
                let p2 = rig.rectify_pixel(1, &project(&lens, &x2)).unwrap();
                let across = 1 - usize::from(rig.is_vertical);
                assert!((p1 - p2)[across].abs() < 1e-5, "{slant_deg}°");
            }
        }
    }
}

#[test]
fn alpha_zero_shows_only_source_pixels_and_one_shows_all() {
    let cam2_from_cam1 = motion([0.0141, -0.0004, -0.0023], [-0.11, 0.0004, -0.0009]);
    let mut options = RectifyOptions::default();
    let tight = rectify_calibrated(&wide_rig(), &cam2_from_cam1, &options).unwrap();
    for i in 0..2 {
        let mask = tight.map(i, &mut ()).unwrap().mask(752, 480);
        assert!(mask.as_raw().iter().all(|&m| m == 255));
        let valid = tight.valid[i];
        assert_eq!((valid.u_min, valid.v_min), (0.0, 0.0));
        assert_eq!((valid.u_max, valid.v_max), (751.0, 479.0));
    }
    options.alpha = 1.0;
    let wide = rectify_calibrated(&wide_rig(), &cam2_from_cam1, &options).unwrap();
    for i in 0..2 {
        for (u, v) in [
            (0.0, 0.0),
            (751.0, 0.0),
            (0.0, 479.0),
            (751.0, 479.0),
            (375.0, 0.0),
        ] {
            let p = wide.rectify_pixel(i, &Point2::new(u, v)).unwrap();
            assert!(p.x > -1e-6 && p.y > -1e-6 && p.x < 751.000001 && p.y < 479.000001);
        }
        assert!(
            wide.map(i, &mut ())
                .unwrap()
                .mask(752, 480)
                .as_raw()
                .contains(&0)
        );
    }
    assert!(wide.intrinsics[0].fu_px() < tight.intrinsics[0].fu_px());
}

#[test]
fn hopeless_rigs_are_refused() {
    let options = RectifyOptions::default();
    let rig = |m: RigidTransform, w, h, o: &RectifyOptions| {
        rectify_calibrated(&wide_rig().map(|c| sized(c, w, h)), &m, o)
    };
    let side = motion([0.0; 3], [-0.1, 0.0, 0.0]);
    assert!(matches!(
        rig(motion([0.1, 0.0, 0.0], [0.0; 3]), 752, 480, &options),
        Err(Error::Degenerate { .. })
    ));
    assert!(matches!(
        rig(motion([0.0; 3], [0.01, 0.0, -0.5]), 752, 480, &options),
        Err(Error::Degenerate { .. })
    ));
    assert!(
        rig(
            motion([0.0, 3.0, 0.0], [-0.1, 0.0, 0.0]),
            752,
            480,
            &options
        )
        .is_err()
    );
    assert!(rig(motion([0.0; 3], [f64::NAN, 0.0, 0.0]), 752, 480, &options).is_err());
    assert!(rig(side, 0, 480, &options).is_err());
    for alpha in [-0.1, 1.1, f64::NAN] {
        assert!(rig(side, 752, 480, &RectifyOptions { alpha, ..options }).is_err());
    }
    let good = rig(side, 752, 480, &options).unwrap();
    assert!(good.map(2, &mut ()).is_err());
    assert!(good.rectify_pixel(2, &Point2::new(0.0, 0.0)).is_err());
    assert!(q_from_rig(0.0, 1.0, 0.0, 0.0).is_err());
    assert!(q_from_rig(1.0, f64::NAN, 0.0, 0.0).is_err());
}

/// For each lens model, including a fisheye of 190° whose circle leaves the corners black: matches
/// share a row, with the disparity of their depth, and each result is read where its image shows
/// the point.
#[test]
fn rigs_of_any_lens_are_rectified() {
    let mut random = Random::new(8);
    let of = |kind, focal_px: f64, coefficients: &[f64]| Camera {
        width: 600,
        height: 400,
        intrinsics: Intrinsics::new(focal_px, focal_px * 1.002, 300.0, 198.0).unwrap(),
        lens: Lens::from_coefficients(kind, coefficients).unwrap(),
    };
    let lenses = [
        of(LensKind::Brown, 450.0, &[-0.28, 0.07, 0.0002, 1e-4, 0.0]),
        of(
            LensKind::Rational,
            450.0,
            &[0.3, 0.02, 0.0, 0.001, 0.0, 0.6, 0.1, 0.0],
        ),
        of(LensKind::Fisheye, 180.0, &[-0.02, 0.008, -0.004, 6e-4]),
        of(LensKind::Division, 450.0, &[-0.25]),
    ];
    let cam2_from_cam1 = motion([0.03, 0.08, -0.05], [-0.2, 0.01, 0.02]);
    for camera in lenses {
        let kind = camera.lens.kind();
        let options = RectifyOptions::default();
        let rig = rectify_calibrated(&[camera; 2], &cam2_from_cam1, &options).unwrap();
        let mut num_shown = 0;
        for _ in 0..500 {
            let mut to = |reach: f64| random.uniform(-reach, reach);
            let x = Point3::new(to(2.5), to(2.0), 2.0 + to(1.0));
            let pixels = [x, cam2_from_cam1 * x].map(|x| {
                let pixel = camera.project(&x);
                let inside =
                    |p: &Point2<f64>| (0.0..600.0).contains(&p.x) && (0.0..400.0).contains(&p.y);
                pixel.ok().filter(inside)
            });
            let [Some(first), Some(second)] = pixels else {
                continue;
            };
            let [Ok(a), Ok(b)] = [(0, first), (1, second)].map(|(i, p)| rig.rectify_pixel(i, &p))
            else {
                continue;
            };
            assert!((a.y - b.y).abs() < 1e-6, "{kind:?}");
            let place = rig.q * Vector4::new(a.x, a.y, a.x - b.x, 1.0);
            let rotated = rig.rect_from_cam[0] * x;
            let found = Point3::from(place.xyz() / place.w);
            assert!(
                (found - rotated).norm() < 1e-6 * rotated.coords.norm(),
                "{kind:?}"
            );
            let back = rig.source_pixel(0, &a).unwrap().unwrap();
            assert!((back - first).norm() < 1e-6, "{kind:?}");
            num_shown += 1;
        }
        assert!(num_shown > 80, "{kind:?}: {num_shown}");
        for i in 0..2 {
            // Every pixel of the result has image content.
            for (u, v) in [
                (0.0, 0.0),
                (599.0, 0.0),
                (0.0, 399.0),
                (599.0, 399.0),
                (300.0, 200.0),
            ] {
                let source = rig.source_pixel(i, &Point2::new(u, v)).unwrap().unwrap();
                let slack = 0.5;
                assert!(
                    (-slack..=599.0 + slack).contains(&source.x)
                        && (-slack..=399.0 + slack).contains(&source.y),
                    "{kind:?}: {source}"
                );
            }
        }
    }
}
