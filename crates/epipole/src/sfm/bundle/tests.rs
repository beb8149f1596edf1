//! Bundle adjustment recovers disturbed cameras and points.

use super::lens_state::OF_BROWN;
use super::problem::{Problem, State};
use super::*;
use crate::Error;
use crate::camera::{Camera, Distortion, Intrinsics, Lens, PosedCamera, RigidTransform, look_at};
use crate::math::random::Random;
use crate::optim::{BundleProblem, BundleStep, LmOptions, RobustLoss, check_jacobian};
use crate::progress::{Stage, Status};
use nalgebra::{DMatrix, DVector, Point2, Point3, Vector2, Vector3};
use std::ops::ControlFlow;

fn brown(lens: &Lens) -> Distortion {
    match lens {
        Lens::Brown(distortion) => *distortion,
        other => panic!("{other:?} is not Brown's"),
    }
}

/// Cameras on an arc look at a ball of points.
fn arc(num_cameras: usize, num_points: usize, distortion: impl Into<Lens>) -> Bundle {
    let mut random = Random::new(21);
    let mut bundle = Bundle::default();
    let lens = distortion.into();
    let up = Vector3::new(0.0, -1.0, 0.0);
    for i in 0..num_cameras {
        let (s, c) = libm::sincos(0.15 * i as f64);
        let center = Point3::new(6.0 * s, 0.2 * i as f64, -6.0 * c);
        bundle.cameras.push(PosedCamera {
            camera: Camera {
                lens,
                ..Camera::pinhole(Intrinsics::centered(800.0, 640, 480).unwrap(), 640, 480)
            },
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
            bundle.observations.push(BundleObservation {
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

/// Gives each camera the lens of its number.
pub(super) fn set_lenses(bundle: &mut Bundle, lenses: &[Lens]) {
    for index in 0..bundle.cameras.len() {
        bundle.cameras[index].camera.lens = lenses[bundle.lens_of(index)];
    }
}

pub(super) fn disturb(bundle: &mut Bundle, amount: f64) {
    let mut random = Random::new(22);
    for camera in bundle.cameras.iter_mut().skip(1) {
        let rotation_vector = Vector3::from_fn(|_, _| amount * random.normal());
        let shift = Vector3::from_fn(|_, _| amount * random.normal());
        camera.cam_from_world = RigidTransform::new(shift, rotation_vector) * camera.cam_from_world;
    }
    for point in &mut bundle.points {
        *point += Vector3::from_fn(|_, _| amount * random.normal());
    }
}

fn exact() -> LmOptions {
    LmOptions {
        cost_tolerance: 0.0,
        max_iterations: 100,
        ..LmOptions::default()
    }
}

pub(super) fn all_free() -> BundleOptions {
    BundleOptions {
        lm: exact(),
        refine_focal: true,
        refine_principal_point: true,
        refine_distortion: true,
        refine_tangential: true,
        ..BundleOptions::default()
    }
}

fn bent(k1: f64, p1: f64) -> Distortion {
    Distortion {
        k1,
        k2: -0.3 * k1,
        p1,
        p2: -0.5 * p1,
        k3: 0.01,
    }
}

#[test]
fn jacobians_are_those_of_central_differences() {
    let mut bundle = arc(3, 5, bent(-0.1, 0.004));
    disturb(&mut bundle, 0.02);
    let options = BundleOptions {
        position_priors: vec![None, known(&bundle.cameras[1], 0.3)],
        ..all_free()
    };
    // A sensor that looks sideways through its own lens sees the second half.
    let rotation_vector = Vector3::new(0.05, -0.2, 0.1);
    bundle.sensors.push(Sensor {
        sensor_from_camera: RigidTransform::new(Vector3::new(-0.5, 0.1, 0.05), rotation_vector),
        camera: Camera::pinhole(
            Intrinsics::new(700.0, 710.0, 300.0, 200.0).unwrap(),
            640,
            480,
        ),
        lens: 2,
    });
    bundle.sensor_of_observation = (0..15).map(|o| usize::from(o >= 8)).collect();
    bundle.lens_of_camera = vec![0, 1];
    bundle.cameras[1].camera.lens = bent(0.05, 0.002).into();
    bundle.cameras[2].camera.lens = bundle.cameras[0].camera.lens;
    check_derivatives::<OF_BROWN>(&bundle, &options);
}

/// Compares the derivatives of every residual with differences; the second camera has a known
/// position.
pub(super) fn check_derivatives<const S: usize>(bundle: &Bundle, options: &BundleOptions) {
    let (num_cameras, num_points) = (bundle.cameras.len(), bundle.points.len());
    let problem = Problem::<S> {
        bundle,
        pairs: observation_pairs(&bundle.observations, num_cameras, num_points).unwrap(),
        options,
        held_cameras: vec![[false; 6]; num_cameras],
        refined: lens_state::refined(&bundle.lenses().unwrap(), options),
    };
    let state = State::new(bundle, &bundle.lenses().unwrap());
    let nothing = BundleStep {
        cameras: vec![[0.0; 6]; num_cameras],
        shared: vec![[0.0; S]; bundle.num_lenses()],
        points: vec![[0.0; 3]; num_points],
    };
    let moved = |step: &BundleStep<6, S>| {
        let mut moved = state.clone();
        problem.step(&state, step, &mut moved);
        moved
    };
    for (index, o) in bundle.observations.iter().enumerate() {
        let terms = problem.linearize(&state, index);
        let mut analytic = DMatrix::zeros(2, 9 + S);
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
            let mut step = nothing.clone();
            step.cameras[o.camera].copy_from_slice(&d[..6]);
            let group = problem.group(index);
            step.shared[group].copy_from_slice(&d[6..6 + S]);
            // Fixed parameters must not move.
            for (step, refined) in step.shared[group][1..]
                .iter_mut()
                .zip(problem.refined[group])
            {
                *step = if refined { *step } else { 0.0 };
            }
            step.shared[group][S - 2..].copy_from_slice(&d[4 + S..6 + S]);
            step.points[o.point].copy_from_slice(&d[6 + S..]);
            DVector::from_row_slice(&problem.residual(&moved(&step), index))
        };
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
        let residual = bundle.residual_px(index);
        assert!((residual - Vector2::from(terms.residual)).norm() < 1e-9);
    }
    if options.position_priors.is_empty() {
        return;
    }
    // The prior of the second camera's position.
    assert!(problem.prior(&state, 0).is_none() && problem.prior(&state, 2).is_none());
    let prior = problem.prior(&state, 1).unwrap();
    let analytic = DMatrix::from_fn(3, 6, |row, column| prior.camera[row][column]);
    let residuals = |d: &DVector<f64>| {
        let mut step = nothing.clone();
        step.cameras[1].copy_from_slice(d.as_slice());
        DVector::from_row_slice(&problem.prior(&moved(&step), 1).unwrap().residual)
    };
    assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
}

/// A prior at the camera's true position.
fn known(camera: &PosedCamera, sigma: f64) -> Option<PositionPrior> {
    Some(PositionPrior {
        center_in_world: camera.center_in_world(),
        sigma: Vector3::new(sigma, 2.0 * sigma, 3.0 * sigma),
    })
}

/// Sets the observed pixels of a bundle to their projections.
pub(super) fn project_points(bundle: &mut Bundle) {
    for index in 0..bundle.observations.len() {
        let off = bundle.residual_px(index);
        bundle.observations[index].pixel += off;
    }
}

#[test]
fn each_lens_is_refined_by_its_own_observations() {
    let mut bundle = arc(9, 120, Distortion::NONE);
    bundle.lens_of_camera = (0..9).map(|camera| camera % 3).collect();
    let lenses = [(-0.1, 0.003), (0.06, -0.002), (-0.02, 0.001)];
    set_lenses(&mut bundle, &lenses.map(|(k1, p1)| bent(k1, p1).into()));
    let k = [
        Intrinsics::new(800.0, 800.0, 322.0, 236.0).unwrap(),
        Intrinsics::new(900.0, 905.0, 315.0, 244.0).unwrap(),
        Intrinsics::new(700.0, 690.0, 320.0, 240.0).unwrap(),
    ];
    for (index, camera) in bundle.cameras.iter_mut().enumerate() {
        camera.camera.intrinsics = k[index % 3];
    }
    project_points(&mut bundle);
    let truth = bundle.clone();
    disturb(&mut bundle, 0.01);
    for (index, camera) in bundle.cameras.iter_mut().enumerate() {
        // Each lens has another focal length with the same aspect ratio.
        let factor = [1.03, 0.98, 1.01][index % 3];
        let k = k[index % 3];
        camera.camera.intrinsics =
            Intrinsics::new(factor * k.fu_px(), factor * k.fv_px(), 320.0, 240.0).unwrap();
    }
    // The third terms are not refined.
    let only_third = Distortion {
        k3: 0.01,
        ..Distortion::NONE
    };
    set_lenses(&mut bundle, &[only_third.into(); 3]);
    let report = adjust_bundle(&mut bundle, &all_free(), &mut ()).unwrap();
    assert!(report.final_cost < 1e-12, "{report:?}");
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let (got, want) = (got.camera.intrinsics, want.camera.intrinsics);
        assert!(
            (got.fu_px() - want.fu_px()).abs() < 1e-3,
            "{got:?} {want:?}"
        );
        assert!(
            (got.fv_px() - want.fv_px()).abs() < 1e-3,
            "{got:?} {want:?}"
        );
        assert!((got.principal_point() - want.principal_point()).norm() < 1e-2);
    }
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let (got, want) = (brown(&got.camera.lens), brown(&want.camera.lens));
        for (got, want) in [
            (got.k1, want.k1),
            (got.k2, want.k2),
            (got.p1, want.p1),
            (got.p2, want.p2),
        ] {
            assert!((got - want).abs() < 1e-4, "{got} {want}");
        }
        assert_eq!(got.k3, 0.01);
    }
    // One shared lens does not fit three lenses.
    let mut shared = truth.clone();
    shared.lens_of_camera = Vec::new();
    let refused = adjust_bundle(&mut shared, &all_free(), &mut ());
    assert!(
        matches!(refused, Err(Error::Degenerate { .. })),
        "{refused:?}"
    );
    set_lenses(&mut shared, &[only_third.into()]);
    let report = adjust_bundle(&mut shared, &all_free(), &mut ()).unwrap();
    assert!(report.final_cost > 1.0, "{report:?}");
}

#[test]
fn what_is_not_to_be_refined_stays_the_same_bits() {
    let mut bundle = arc(5, 40, bent(-0.1, 0.003));
    disturb(&mut bundle, 0.01);
    let before = bundle.clone();
    for (refine_tangential, refine_distortion) in [(true, false), (false, true), (false, false)] {
        let options = BundleOptions {
            refine_tangential,
            refine_distortion,
            ..BundleOptions::default()
        };
        let mut bundle = before.clone();
        adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
        let (new, old) = (
            brown(&bundle.cameras[0].camera.lens),
            brown(&before.cameras[0].camera.lens),
        );
        assert_eq!((new.p1, new.p2) == (old.p1, old.p2), !refine_tangential);
        assert_eq!((new.k1, new.k2) == (old.k1, old.k2), !refine_distortion);
        for (new, old) in bundle.cameras.iter().zip(&before.cameras) {
            assert_eq!(new.camera.intrinsics, old.camera.intrinsics);
        }
    }
}

#[test]
fn known_positions_move_the_world_there_and_wrong_ones_do_not() {
    let mut bundle = arc(8, 60, Distortion::NONE);
    let truth = bundle.clone();
    let mut priors: Vec<_> = truth.cameras.iter().map(|c| known(c, 0.05)).collect();
    // One position is far off, one camera has none.
    priors[3].as_mut().unwrap().center_in_world.x += 40.0;
    priors[5] = None;
    // A similarity transform of everything, since a reconstruction has its own frame.
    let elsewhere = nalgebra::Similarity3::new(
        Vector3::new(0.3, -0.2, 0.1),
        Vector3::new(0.02, 0.05, 0.01),
        1.1,
    );
    for camera in &mut bundle.cameras {
        camera.cam_from_world =
            crate::sfm::reconstruction::moved_pose(&camera.cam_from_world, &elsewhere);
    }
    for point in &mut bundle.points {
        *point = elsewhere * *point;
    }
    let options = BundleOptions {
        lm: exact(),
        position_priors: priors,
        position_loss: RobustLoss::Cauchy { width: 2.0 },
        ..BundleOptions::default()
    };
    adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let off = (got.center_in_world() - want.center_in_world()).norm();
        assert!(off < 0.01, "{off}");
    }
    for (got, want) in bundle.points.iter().zip(&truth.points) {
        assert!((got - want).norm() < 0.01);
    }
}

#[test]
fn a_rig_knows_its_size() {
    let mut bundle = arc(4, 30, Distortion::NONE);
    let truth = bundle.clone();
    bundle.sensors.push(Sensor {
        sensor_from_camera: RigidTransform::translation(-0.4, 0.0, 0.0),
        camera: Camera::pinhole(Intrinsics::centered(800.0, 640, 480).unwrap(), 640, 480),
        lens: 0,
    });
    bundle.sensor_of_observation = vec![0; bundle.observations.len()];
    for index in 0..bundle.observations.len() {
        let copy = BundleObservation {
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
    let report = adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
    assert!(report.final_cost < 1e-15, "{report:?}");
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let error = (got.center_in_world() - want.center_in_world()).norm();
        assert!(error < 1e-7, "{error}");
    }
    bundle.sensor_of_observation[0] = 2;
    assert!(adjust_bundle(&mut bundle, &options, &mut ()).is_err());
}

#[test]
fn two_cameras_fix_the_gauge_and_the_truth_is_found() {
    let mut bundle = arc(5, 50, Distortion::NONE);
    let truth = bundle.clone();
    disturb(&mut bundle, 0.02);
    // Restore the coordinate of the far camera that holds the scale.
    bundle.cameras[4] = truth.cameras[4];
    let options = BundleOptions {
        lm: exact(),
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
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
    let distortion = Distortion {
        k1: -0.08,
        k2: 0.02,
        ..Distortion::NONE
    };
    let mut bundle = arc(6, 80, distortion);
    let start = Intrinsics::centered(830.0, 640, 480).unwrap();
    for camera in &mut bundle.cameras {
        camera.camera = Camera::pinhole(start, 640, 480);
    }
    disturb(&mut bundle, 0.01);
    let options = BundleOptions {
        lm: exact(),
        refine_focal: true,
        refine_distortion: true,
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
    assert!(report.final_cost < 1e-12, "{report:?}");
    assert!((bundle.cameras[3].camera.intrinsics.fu_px() - 800.0).abs() < 1e-4);
    let found = brown(&bundle.cameras[3].camera.lens);
    assert!((found.k1 + 0.08).abs() < 1e-6);
    assert!((found.k2 - 0.02).abs() < 1e-5);
}

#[test]
fn held_cameras_and_points_stay() {
    let mut bundle = arc(4, 20, Distortion::NONE);
    disturb(&mut bundle, 0.01);
    let before = bundle.clone();
    let options = BundleOptions {
        held_cameras: vec![false, true, true],
        held_points: vec![true, true],
        ..BundleOptions::default()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
    assert!(report.final_cost < report.initial_cost);
    assert_eq!(bundle.cameras[1], before.cameras[1]);
    assert_eq!(bundle.cameras[2], before.cameras[2]);
    assert_ne!(bundle.cameras[0], before.cameras[0]);
    assert_eq!(bundle.points[..2], before.points[..2]);
}

#[test]
fn canceling_leaves_the_best_so_far() {
    let mut bundle = arc(4, 20, Distortion::NONE);
    disturb(&mut bundle, 0.02);
    let whole = adjust_bundle(&mut bundle.clone(), &BundleOptions::default(), &mut ()).unwrap();
    let mut calls = 0;
    let mut stop = |status: Status| {
        assert_eq!(status.stage, Stage::BundleAdjustment);
        calls += 1;
        match calls {
            2 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    };
    let canceled = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut stop);
    assert_eq!(canceled, Err(Error::Canceled));
    let sum: f64 = (0..bundle.observations.len())
        .map(|o| 0.5 * bundle.residual_px(o).norm_squared())
        .sum();
    assert!((sum - whole.history[1].cost).abs() <= 1e-9 * sum);
    assert!(sum < whole.initial_cost);
}

#[test]
fn bad_observations_are_refused() {
    let good = arc(2, 8, Distortion::NONE);
    let options = BundleOptions::default();
    let mut none = good.clone();
    none.observations.clear();
    assert!(matches!(
        adjust_bundle(&mut none, &options, &mut ()),
        Err(Error::TooFew { .. })
    ));
    let mut beyond = good.clone();
    beyond.observations[3].point = 8;
    assert!(matches!(
        adjust_bundle(&mut beyond, &options, &mut ()),
        Err(Error::OutOfRange { value: 8.0, .. })
    ));
    let mut nan = good.clone();
    nan.observations[3].pixel.x = f64::NAN;
    assert!(matches!(
        adjust_bundle(&mut nan, &options, &mut ()),
        Err(Error::NotFinite { .. })
    ));
    let mut many = good.clone();
    many.lens_of_camera = vec![0, 2];
    assert!(matches!(
        adjust_bundle(&mut many, &options, &mut ()),
        Err(Error::OutOfRange { value: 2.0, .. })
    ));
    for (sigma, x) in [
        (0.0, 0.0),
        (-1.0, 0.0),
        (f64::NAN, 0.0),
        (1.0, f64::INFINITY),
    ] {
        let mut prior = known(&good.cameras[0], sigma).unwrap();
        prior.center_in_world.x += x;
        let options = BundleOptions {
            position_priors: vec![Some(prior)],
            ..BundleOptions::default()
        };
        assert!(adjust_bundle(&mut good.clone(), &options, &mut ()).is_err());
    }
}
