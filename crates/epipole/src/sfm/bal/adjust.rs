//! Bundle adjustment of BAL problems.

use super::problem::BalProblem;
use super::residuals::{Problem, State};
use crate::optim::{LmOptions, LmReport, RobustLoss, SchurSystem, minimize};
use crate::progress::{Monitor, Part, Stage};
use crate::sfm::bundle::observation_pairs;
use crate::{Error, Result};

/// Refines all cameras and points of a problem, in place.
///
/// * `loss`: width in pixels
/// * `monitor`: notified before the first step and after each, in the only stage,
///   [`Stage::BundleAdjustment`]
///
/// All observations count, even those of points behind their camera, so that costs are comparable.
///
/// # Errors
/// [`TooFew`](crate::Error::TooFew) without observations, [`OutOfRange`](crate::Error::OutOfRange)
/// if an observation refers to a missing camera or point, or for a loss that [`RobustLoss::check`]
/// rejects, [`NotFinite`](crate::Error::NotFinite) if the initial cost is not finite,
/// [`Canceled`](crate::Error::Canceled); the problem is then the best found so far.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis".
pub fn adjust_bal(
    problem: &mut BalProblem,
    options: &LmOptions,
    loss: RobustLoss,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    loss.check()?;
    let pairs = observation_pairs(
        &problem.observations,
        problem.cameras.len(),
        problem.points.len(),
    )?;
    let mut state = State::new(problem);
    let bundle = Problem {
        observations: &problem.observations,
        pairs,
        num_cameras: problem.cameras.len(),
        num_points: problem.points.len(),
        loss,
    };
    let mut system = SchurSystem::new(&bundle);
    let mut step = Part::new(monitor, 0.0, 1.0).of_stage(Stage::BundleAdjustment);
    let report = minimize(&mut system, &mut state, options, &mut step);
    if !matches!(report, Ok(_) | Err(Error::Canceled)) {
        return report;
    }
    for (camera, new) in problem.cameras.iter_mut().zip(&state.cameras) {
        camera.rotation = new.pose.rotation.scaled_axis();
        camera.translation = new.pose.translation;
        [camera.focal_px, camera.k1, camera.k2] = new.intrinsics;
    }
    problem.points = state.points;
    report
}

#[cfg(test)]
mod tests {
    use super::super::problem::BalCamera;
    use super::*;
    use crate::math::random::Random;
    use crate::optim::{BundleProblem, BundleStep, check_jacobian};
    use crate::sfm::BundleObservation;
    use nalgebra::{DMatrix, DVector, Point2, Point3, Vector3};

    /// Cameras around a ball of points; every camera sees every point.
    fn ring(num_cameras: usize, num_points: usize, noise_px: f64, seed: u64) -> BalProblem {
        let mut random = Random::new(seed);
        let mut problem = BalProblem::default();
        for i in 0..num_cameras {
            let rotation_vector =
                Vector3::new(0.1 * random.normal(), 0.3 * i as f64, 0.1 * random.normal());
            problem.cameras.push(BalCamera {
                rotation: rotation_vector,
                translation: Vector3::new(0.0, 0.1, -6.0),
                focal_px: 500.0 + 5.0 * i as f64,
                k1: 0.01,
                k2: -0.002,
            });
        }
        for _ in 0..num_points {
            let mut coordinate = || random.uniform(-1.0, 1.0);
            problem
                .points
                .push(Point3::new(coordinate(), coordinate(), coordinate()));
        }
        let state = State::new(&problem);
        for camera in 0..num_cameras {
            for point in 0..num_points {
                let mut o = BundleObservation {
                    camera,
                    point,
                    pixel: Point2::origin(),
                };
                let [u, v] = state.residual(&o);
                o.pixel = Point2::new(
                    u + noise_px * random.normal(),
                    v + noise_px * random.normal(),
                );
                problem.observations.push(o);
            }
        }
        problem
    }

    fn disturb(problem: &mut BalProblem, amount: f64, seed: u64) {
        let mut random = Random::new(seed);
        for camera in &mut problem.cameras {
            camera.rotation += Vector3::from_fn(|_, _| amount * random.normal());
            camera.translation += Vector3::from_fn(|_, _| amount * random.normal());
            camera.focal_px += 100.0 * amount * random.normal();
        }
        for point in &mut problem.points {
            *point += Vector3::from_fn(|_, _| amount * random.normal());
        }
    }

    #[test]
    fn jacobians_are_those_of_central_differences() {
        let mut problem = ring(3, 4, 0.0, 1);
        disturb(&mut problem, 0.05, 2);
        let state = State::new(&problem);
        let pairs = observation_pairs(&problem.observations, 3, 4).unwrap();
        let bundle = Problem {
            observations: &problem.observations,
            pairs,
            num_cameras: 3,
            num_points: 4,
            loss: RobustLoss::Trivial,
        };
        for (index, o) in problem.observations.iter().enumerate() {
            let terms = bundle.linearize(&state, index);
            let mut analytic = DMatrix::zeros(2, 12);
            for row in 0..2 {
                for c in 0..9 {
                    analytic[(row, c)] = terms.camera[row][c];
                }
                for k in 0..3 {
                    analytic[(row, 9 + k)] = terms.point[row][k];
                }
            }
            let residuals = |d: &DVector<f64>| {
                let mut step = BundleStep {
                    cameras: vec![[0.0; 9]; 3],
                    shared: Vec::new(),
                    points: vec![[0.0; 3]; 4],
                };
                step.cameras[o.camera].copy_from_slice(&d.as_slice()[..9]);
                step.points[o.point].copy_from_slice(&d.as_slice()[9..]);
                let mut moved = state.clone();
                bundle.step(&state, &step, &mut moved);
                DVector::from_row_slice(&bundle.residual(&moved, index))
            };
            assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
            assert_eq!(terms.residual, bundle.residual(&state, index));
        }
    }

    #[test]
    fn exact_data_are_met_exactly() {
        let mut problem = ring(5, 60, 0.0, 3);
        disturb(&mut problem, 0.02, 4);
        assert!(problem.cost(RobustLoss::Trivial) > 1e3);
        let options = LmOptions {
            max_iterations: 100,
            cost_tolerance: 0.0,
            ..LmOptions::default()
        };
        let report = adjust_bal(&mut problem, &options, RobustLoss::Trivial, &mut ()).unwrap();
        assert!(report.final_cost < 1e-15, "{report:?}");
        let again = problem.cost(RobustLoss::Trivial);
        assert!(again < 1e-15, "{again}");
    }

    #[test]
    fn noise_leaves_what_statistics_predicts() {
        let mut problem = ring(6, 200, 0.5, 5);
        disturb(&mut problem, 0.01, 6);
        let report = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut (),
        )
        .unwrap();
        // E[½ Σ r²] = ½ σ² (residuals − parameters + 7 for the gauge).
        let freedom = (2 * 6 * 200 - 9 * 6 - 3 * 200 + 7) as f64;
        let expected = 0.5 * 0.25 * freedom;
        assert!(
            (report.final_cost / expected - 1.0).abs() < 0.1,
            "{report:?} {expected}"
        );
    }

    #[test]
    fn the_robust_cost_falls_monotonically_beside_outliers() {
        let mut problem = ring(5, 80, 0.3, 7);
        let truth = problem.clone();
        for o in problem.observations.iter_mut().step_by(17) {
            o.pixel.x += 60.0;
        }
        disturb(&mut problem, 0.005, 8);
        let loss = RobustLoss::Cauchy { width: 1.0 };
        let report = adjust_bal(&mut problem, &LmOptions::default(), loss, &mut ()).unwrap();
        let mut pairs = report.history.windows(2);
        assert!(pairs.all(|pair| pair[1].cost <= pair[0].cost));
        assert!((problem.cost(loss) - report.final_cost).abs() < 1e-9 * report.final_cost);
        // Without the outliers the refined cameras fit as well as the true ones.
        problem.observations = truth.observations.clone();
        let clean = problem.cost(RobustLoss::Trivial);
        assert!(clean < 1.5 * truth.cost(RobustLoss::Trivial), "{clean}");
    }

    #[test]
    fn cameras_and_points_without_observations_stay() {
        let mut problem = ring(4, 30, 0.2, 9);
        let mut isolated = problem.cameras[0];
        isolated.focal_px = 777.0;
        problem.cameras.push(isolated);
        problem.points.push(Point3::new(5.0, 6.0, 7.0));
        let report = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut (),
        )
        .unwrap();
        assert!(report.termination.is_converged(), "{report:?}");
        assert_eq!(problem.cameras[4].focal_px, 777.0);
        assert_eq!(problem.points[30], Point3::new(5.0, 6.0, 7.0));
    }

    #[test]
    fn a_point_in_the_center_plane_is_an_error() {
        let mut problem = ring(1, 1, 0.0, 10);
        problem.cameras[0].rotation = Vector3::zeros();
        problem.cameras[0].translation = Vector3::zeros();
        problem.points[0] = Point3::new(1.0, 2.0, 0.0);
        let result = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut (),
        );
        assert!(matches!(result, Err(Error::NotFinite { .. })));
    }
}
