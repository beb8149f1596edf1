//! Cameras around points, put right again after they were disturbed.

use super::*;
use crate::camera::look_at;
use crate::math::random::Random;
use crate::optim::{BundleProblem, BundleStep, Termination, check_jacobian};
use nalgebra::{DMatrix, DVector, Vector3};

/// Cameras on an arc look at a ball of points.
fn arc(num_cameras: usize, num_points: usize, distortion: RadialDistortion) -> Bundle {
    let mut random = Random::new(21);
    let mut bundle = Bundle {
        distortion,
        ..Bundle::default()
    };
    let up = Vector3::new(0.0, -1.0, 0.0);
    for i in 0..num_cameras {
        let (s, c) = libm::sincos(0.15 * i as f64);
        let center = Point3::new(6.0 * s, 0.2 * i as f64, -6.0 * c);
        bundle.cameras.push(Camera {
            intrinsics: Intrinsics::centered(800.0, 640, 480).unwrap(),
            cam_from_world: look_at(&center, &Point3::origin(), &up).unwrap(),
        });
    }
    for _ in 0..num_points {
        let mut coordinate = || random.uniform(-1.5, 1.5);
        bundle
            .points
            .push(Point3::new(coordinate(), coordinate(), coordinate()));
    }
    for camera in 0..num_cameras {
        for point in 0..num_points {
            bundle.observations.push(Observation {
                camera,
                point,
                pixel: Point2::origin(),
            });
            let last = bundle.observations.len() - 1;
            bundle.observations[last].pixel = Point2::from(bundle.residual_px(last));
        }
    }
    bundle
}

fn disturb(bundle: &mut Bundle, amount: f64) {
    let mut random = Random::new(22);
    for camera in bundle.cameras.iter_mut().skip(1) {
        let turn = Vector3::from_fn(|_, _| amount * random.normal());
        let shift = Vector3::from_fn(|_, _| amount * random.normal());
        camera.cam_from_world = RigidTransform::new(shift, turn) * camera.cam_from_world;
    }
    for point in &mut bundle.points {
        *point += Vector3::from_fn(|_, _| amount * random.normal());
    }
}

fn go_on(_: &Iteration) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn exact() -> LmOptions {
    LmOptions {
        cost_tolerance: 0.0,
        max_iterations: 100,
        ..LmOptions::default()
    }
}

#[test]
fn jacobians_are_those_of_central_differences() {
    let distortion = RadialDistortion { k1: -0.1, k2: 0.03 };
    let mut bundle = arc(3, 5, distortion);
    disturb(&mut bundle, 0.02);
    let options = BundleOptions {
        refine_focal: true,
        refine_distortion: true,
        ..BundleOptions::default()
    };
    // The second half is seen by a sensor that looks from the side.
    let turn = Vector3::new(0.05, -0.2, 0.1);
    bundle.sensors.push(Sensor {
        sensor_from_camera: RigidTransform::new(Vector3::new(-0.5, 0.1, 0.05), turn),
        intrinsics: Intrinsics::new(700.0, 710.0, 300.0, 200.0).unwrap(),
    });
    bundle.sensor_of_observation = (0..15).map(|o| usize::from(o >= 8)).collect();
    let problem = Problem {
        bundle: &bundle,
        pairs: observation_pairs(&bundle.observations, 3, 5).unwrap(),
        options: &options,
        held_cameras: vec![[false; 6]; 3],
    };
    let state = State::new(&bundle);
    for (index, o) in bundle.observations.iter().enumerate() {
        let terms = problem.linearize(&state, index);
        let mut analytic = DMatrix::zeros(2, 12);
        for row in 0..2 {
            for (column, value) in terms.camera[row]
                .iter()
                .chain(&terms.shared[row])
                .chain(&terms.point[row])
                .enumerate()
            {
                analytic[(row, column)] = *value;
            }
        }
        let residuals = |d: &DVector<f64>| {
            let d = d.as_slice();
            let mut step = BundleStep {
                cameras: vec![[0.0; 6]; 3],
                shared: [d[6], d[7], d[8]],
                points: vec![[0.0; 3]; 5],
            };
            step.cameras[o.camera].copy_from_slice(&d[..6]);
            step.points[o.point].copy_from_slice(&d[9..]);
            let mut moved = state.clone();
            problem.step(&state, &step, &mut moved);
            DVector::from_row_slice(&problem.residual(&moved, index))
        };
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
        let residual = bundle.residual_px(index);
        assert!((residual - Vector2::from(terms.residual)).norm() < 1e-9);
    }
}

#[test]
fn a_rig_knows_its_size() {
    let mut bundle = arc(4, 30, RadialDistortion::default());
    let truth = bundle.clone();
    bundle.sensors.push(Sensor {
        sensor_from_camera: RigidTransform::translation(-0.4, 0.0, 0.0),
        intrinsics: Intrinsics::centered(800.0, 640, 480).unwrap(),
    });
    bundle.sensor_of_observation = vec![0; bundle.observations.len()];
    for index in 0..bundle.observations.len() {
        let copy = Observation {
            pixel: Point2::origin(),
            ..bundle.observations[index]
        };
        bundle.observations.push(copy);
        bundle.sensor_of_observation.push(1);
        let last = bundle.observations.len() - 1;
        bundle.observations[last].pixel = Point2::from(bundle.residual_px(last));
    }
    disturb(&mut bundle, 0.02);
    let options = BundleOptions {
        lm: exact(),
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
    assert!(report.final_cost < 1e-15, "{report:?}");
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let error = (got.center_in_world() - want.center_in_world()).norm();
        assert!(error < 1e-7, "{error}");
    }
    bundle.sensor_of_observation[0] = 2;
    assert!(adjust_bundle(&mut bundle, &options, &mut go_on).is_err());
}

#[test]
fn two_cameras_fix_the_gauge_and_the_truth_is_found() {
    let mut bundle = arc(5, 50, RadialDistortion::default());
    let truth = bundle.clone();
    disturb(&mut bundle, 0.02);
    // Give the far camera back the coordinate that holds the scale.
    bundle.cameras[4] = truth.cameras[4];
    let options = BundleOptions {
        lm: exact(),
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
    assert!(report.final_cost < 1e-15, "{report:?}");
    assert_eq!(bundle.cameras[0], truth.cameras[0]);
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let error = (got.center_in_world() - want.center_in_world()).norm();
        assert!(error < 1e-8, "{error}");
    }
    for (got, want) in bundle.points.iter().zip(&truth.points) {
        assert!((got - want).norm() < 1e-8);
    }
}

#[test]
fn a_shared_focal_length_and_distortion_are_refined() {
    let distortion = RadialDistortion {
        k1: -0.08,
        k2: 0.02,
    };
    let mut bundle = arc(6, 80, distortion);
    bundle.distortion = RadialDistortion::default();
    for camera in &mut bundle.cameras {
        camera.intrinsics = Intrinsics::centered(830.0, 640, 480).unwrap();
    }
    disturb(&mut bundle, 0.01);
    let options = BundleOptions {
        lm: exact(),
        refine_focal: true,
        refine_distortion: true,
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
    assert!(report.final_cost < 1e-12, "{report:?}");
    assert!((bundle.cameras[3].intrinsics.fu_px() - 800.0).abs() < 1e-4);
    assert!((bundle.distortion.k1 + 0.08).abs() < 1e-6);
    assert!((bundle.distortion.k2 - 0.02).abs() < 1e-5);
}

#[test]
fn held_cameras_and_points_stay() {
    let mut bundle = arc(4, 20, RadialDistortion::default());
    disturb(&mut bundle, 0.01);
    let before = bundle.clone();
    let options = BundleOptions {
        held_cameras: vec![false, true, true],
        held_points: vec![true, true],
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
    assert!(report.final_cost < report.initial_cost);
    assert_eq!(bundle.cameras[1], before.cameras[1]);
    assert_eq!(bundle.cameras[2], before.cameras[2]);
    assert_ne!(bundle.cameras[0], before.cameras[0]);
    assert_eq!(bundle.points[..2], before.points[..2]);
}

#[test]
fn canceling_leaves_the_best_so_far() {
    let mut bundle = arc(4, 20, RadialDistortion::default());
    disturb(&mut bundle, 0.02);
    let mut stop = |i: &Iteration| {
        if i.index == 1 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let report = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut stop).unwrap();
    assert_eq!(report.termination, Termination::Canceled);
    let sum: f64 = (0..bundle.observations.len())
        .map(|o| 0.5 * bundle.residual_px(o).norm_squared())
        .sum();
    assert!((sum - report.final_cost).abs() <= 1e-9 * sum);
    assert!(report.final_cost < report.initial_cost);
}

#[test]
fn bad_observations_are_refused() {
    let good = arc(2, 8, RadialDistortion::default());
    let options = BundleOptions::default();
    let mut none = good.clone();
    none.observations.clear();
    assert!(matches!(
        adjust_bundle(&mut none, &options, &mut go_on),
        Err(Error::TooFew { .. })
    ));
    let mut beyond = good.clone();
    beyond.observations[3].point = 8;
    assert!(matches!(
        adjust_bundle(&mut beyond, &options, &mut go_on),
        Err(Error::OutOfRange { value: 8.0, .. })
    ));
    let mut nan = good.clone();
    nan.observations[3].pixel.x = f64::NAN;
    assert!(matches!(
        adjust_bundle(&mut nan, &options, &mut go_on),
        Err(Error::NotFinite { .. })
    ));
}
