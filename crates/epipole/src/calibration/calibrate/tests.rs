//! Calibration recovers known cameras from the views of boards.

use super::*;
use crate::calibration::synthetic::{poses, true_view};
use crate::calibration::{CalibrationWarning, Pattern};
use crate::camera::Lens;
use crate::math::random::Random;
use crate::progress::Status;
use nalgebra::{Point2, Vector3};
use std::ops::ControlFlow;

fn board() -> Board {
    Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap()
}

fn truth(kind: LensKind) -> Camera {
    let (focal, coefficients): (f64, &[f64]) = match kind {
        LensKind::Brown => (540.0, &[-0.27, 0.05, 0.001, -0.0005, 0.02]),
        LensKind::Rational => (400.0, &[0.5, 0.05, 0.001, 0.0, 0.0, 0.8, 0.15, 0.01]),
        LensKind::Fisheye => (260.0, &[-0.02, 0.004, -0.001, 0.0002]),
        LensKind::Division => (380.0, &[-0.35]),
    };
    Camera {
        intrinsics: Intrinsics::new(focal, focal + 3.0, 342.0, 235.0).unwrap(),
        lens: Lens::from_coefficients(kind, coefficients).unwrap(),
        width: 640,
        height: 480,
    }
}

fn views(camera: &Camera, poses: &[RigidTransform], noise: f64) -> Vec<Option<BoardView>> {
    let mut random = Random::new(9);
    let view = |pose: &RigidTransform| {
        let mut view = true_view(&board(), camera, pose);
        for pixel in view.pixels.iter_mut().flatten() {
            *pixel += Vector3::from_fn(|_, _| noise * random.normal()).xy();
        }
        Some(view)
    };
    poses.iter().map(view).collect()
}

#[test]
fn exact_views_give_the_exact_camera() {
    for kind in [
        LensKind::Brown,
        LensKind::Rational,
        LensKind::Fisheye,
        LensKind::Division,
    ] {
        let camera = truth(kind);
        let distance = camera.intrinsics.fu_px() / 35.0;
        let views = views(&camera, &poses(&board(), 12, distance, 5), 0.0);
        let options = CalibrationOptions {
            lens: kind,
            ..CalibrationOptions::default()
        };
        let found = calibrate(&board(), &views, (640, 480), &options, &mut ()).unwrap();
        assert!(found.rms_px < 1e-4, "{kind:?} {}", found.rms_px);
        // Coefficients of a quotient are correlated, but their effect on pixels is not ambiguous.
        for (u, v) in [(100.0, 100.0), (320.0, 240.0), (560.0, 380.0)] {
            let pixel = Point2::new(u, v);
            let (a, b) = (
                camera.ray(&pixel).unwrap(),
                found.camera.ray(&pixel).unwrap(),
            );
            assert!(
                a.normalize().cross(&b.normalize()).norm() < 1e-5,
                "{kind:?}"
            );
        }
    }
}

/// A hundred noisy sets: the spread of the parameters equals their estimated deviations.
#[test]
fn deviations_are_what_repetition_shows() {
    let camera = truth(LensKind::Brown);
    let exact = views(&camera, &poses(&board(), 10, 15.0, 6), 0.0);
    let mut random = Random::new(1);
    let (mut focals, mut stated) = (Vec::new(), 0.0);
    for _ in 0..100 {
        let mut noisy = exact.clone();
        for pixel in noisy
            .iter_mut()
            .flatten()
            .flat_map(|v| v.pixels.iter_mut().flatten())
        {
            *pixel += Vector3::from_fn(|_, _| 0.3 * random.normal()).xy();
        }
        let found = calibrate(
            &board(),
            &noisy,
            (640, 480),
            &CalibrationOptions::default(),
            &mut (),
        )
        .unwrap();
        // Two coordinates, minus the degrees of freedom that the parameters absorb.
        assert!((found.rms_px / (0.3 * 2.0_f64.sqrt()) - 1.0).abs() < 0.15);
        focals.push(found.camera.intrinsics.fu_px());
        stated += found.std_dev_k[0] / 100.0;
    }
    let mean = focals.iter().sum::<f64>() / 100.0;
    let spread = (focals.iter().map(|f| (f - mean) * (f - mean)).sum::<f64>() / 99.0).sqrt();
    assert!((spread / stated - 1.0).abs() < 0.25, "{spread} {stated}");
    assert!((mean - 540.0).abs() < 0.4 * spread, "{mean} {spread}");
}

#[test]
fn it_can_be_stopped_at_every_step() {
    let camera = truth(LensKind::Brown);
    let views = views(&camera, &poses(&board(), 5, 15.0, 6), 0.1);
    let options = CalibrationOptions::default();
    let run = |most: usize| {
        let (mut calls, mut last) = (0, 0.0);
        let found = calibrate(
            &board(),
            &views,
            (640, 480),
            &options,
            &mut |status: Status| {
                assert_eq!(status.stage, Stage::Calibration);
                assert!((last..=1.0).contains(&status.fraction));
                (calls, last) = (calls + 1, status.fraction);
                if calls <= most {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            },
        );
        (found, calls)
    };
    let (found, calls) = run(usize::MAX);
    assert_eq!(
        found,
        calibrate(&board(), &views, (640, 480), &options, &mut ())
    );
    assert!(calls > 4, "{calls}");
    for most in 0..calls {
        assert_eq!(run(most), (Err(Error::Canceled), most + 1));
    }
}

#[test]
fn bad_sets_get_a_sentence() {
    let camera = truth(LensKind::Brown);
    let options = CalibrationOptions::default();
    let poses = poses(&board(), 6, 15.0, 8);
    let good = views(&camera, &poses, 0.2);
    let run =
        |views: &[Option<BoardView>]| calibrate(&board(), views, (640, 480), &options, &mut ());
    assert!(run(&good).unwrap().warnings.iter().all(|w| matches!(
        w,
        CalibrationWarning::LowCoverage { .. } | CalibrationWarning::UncertainFocal { .. }
    )));
    for few in [&good[..0], &good[..1], &[None, None, good[0].clone()]] {
        let error = run(few).unwrap_err();
        assert!(matches!(error, Error::TooFew { needed: 2, .. }), "{error}");
    }
    // Parallel to each other, and to the image.
    for tilt in [Vector3::new(0.3, 0.2, 0.0), Vector3::zeros()] {
        let parallel: Vec<RigidTransform> = (0..6)
            .map(|i| {
                let at = 0.02 * f64::from(i) - 0.15;
                RigidTransform::new(Vector3::new(at, at + 0.08, 0.4 + 0.03 * f64::from(i)), tilt)
            })
            .collect();
        match run(&views(&camera, &parallel, 0.3)) {
            Err(error) => assert!(matches!(error, Error::Degenerate { .. }), "{error}"),
            Ok(found) => {
                println!("{:?}", found.warnings);
                let parallel =
                    |w: &CalibrationWarning| matches!(w, CalibrationWarning::Parallel { .. });
                assert!(found.warnings.iter().any(parallel));
            }
        }
    }
    let mut short = good.clone();
    short[1].as_mut().unwrap().pixels.pop();
    assert!(matches!(run(&short), Err(Error::SizeMismatch { .. })));
    let mut nan = good.clone();
    nan[1].as_mut().unwrap().pixels[3] = Some(Point2::new(f64::NAN, 0.0));
    assert!(matches!(run(&nan), Err(Error::NotFinite { .. })));
    let mut line = good.clone();
    line[1].as_mut().unwrap().pixels[9..].fill(None);
    assert!(matches!(run(&line), Err(Error::Degenerate { .. })));
    line[1].as_mut().unwrap().pixels[3..].fill(None);
    assert!(matches!(run(&line), Err(Error::TooFew { .. })));
    assert!(calibrate(&board(), &good, (0, 480), &options, &mut ()).is_err());
    // Corners of another board: any result or an error, but no panic and no NaN.
    let mut random = Random::new(3);
    let anywhere = |_: &Option<BoardView>| {
        let pixel = |_| {
            Some(Point2::new(
                random.uniform(0.0, 640.0),
                random.uniform(0.0, 480.0),
            ))
        };
        Some(BoardView {
            pixels: (0..54).map(pixel).collect(),
        })
    };
    let scattered: Vec<_> = good.iter().map(anywhere).collect();
    if let Ok(found) = run(&scattered) {
        assert!(found.rms_px.is_finite() && found.rms_px > 20.0);
    }
    // A view of a bent board is reported.
    let mut bent = good.clone();
    for pixel in bent[2].as_mut().unwrap().pixels.iter_mut().flatten() {
        pixel.y += 2.0 * libm::sin(pixel.x / 15.0);
    }
    let warnings = run(&bent).unwrap().warnings;
    let named = |w: &CalibrationWarning| matches!(w, CalibrationWarning::BadView { number: 3, .. });
    assert!(warnings.iter().any(named), "{warnings:?}");
}
