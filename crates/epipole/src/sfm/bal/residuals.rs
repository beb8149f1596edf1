//! BAL problem for the solver: residuals, derivatives and steps.

use super::problem::BalProblem;
use super::radial::radial_terms;
use crate::optim::{BundleProblem, BundleStep, ObservationTerms, RobustLoss};
use crate::sfm::bundle::{BundleObservation, PoseState, move_points, sum_of_squares};
use nalgebra::{Point3, UnitQuaternion, Vector3};

#[derive(Clone)]
pub(super) struct CameraState {
    pub(super) pose: PoseState,
    /// f, k1, k2.
    pub(super) intrinsics: [f64; 3],
}

#[derive(Clone)]
pub(super) struct State {
    pub(super) cameras: Vec<CameraState>,
    pub(super) points: Vec<Point3<f64>>,
}

impl State {
    pub(super) fn new(problem: &BalProblem) -> Self {
        let cameras = problem
            .cameras
            .iter()
            .map(|camera| CameraState {
                pose: PoseState::new(
                    UnitQuaternion::from_scaled_axis(camera.rotation),
                    camera.translation,
                ),
                intrinsics: [camera.focal_px, camera.k1, camera.k2],
            })
            .collect();
        Self {
            cameras,
            points: problem.points.clone(),
        }
    }

    #[inline]
    pub(super) fn residual(&self, o: &BundleObservation) -> [f64; 2] {
        let camera = &self.cameras[o.camera];
        let p = camera.pose.rotated(&self.points[o.point]) + camera.pose.translation;
        let (x, y) = (-p.x / p.z, -p.y / p.z);
        let [focal, k1, k2] = camera.intrinsics;
        let r_sq = x * x + y * y;
        let scale = focal * (1.0 + r_sq * (k1 + r_sq * k2));
        [scale * x - o.pixel.x, scale * y - o.pixel.y]
    }
}

impl BalProblem {
    /// Returns the cost `½ Σ ρ(‖r‖²)` over all observations, including those of points behind their
    /// camera.
    ///
    /// Infinite or NaN if a point lies in the center plane of a camera that sees it.
    pub fn cost(&self, loss: RobustLoss) -> f64 {
        let state = State::new(self);
        let mut sum = 0.0;
        for o in &self.observations {
            let [u, v] = state.residual(o);
            sum += loss.rho(u * u + v * v);
        }
        0.5 * sum
    }
}

pub(super) struct Problem<'a> {
    pub(super) observations: &'a [BundleObservation],
    pub(super) pairs: Vec<(u32, u32)>,
    pub(super) num_cameras: usize,
    pub(super) num_points: usize,
    pub(super) loss: RobustLoss,
}

impl BundleProblem<9, 0> for Problem<'_> {
    type Parameters = State;

    fn num_cameras(&self) -> usize {
        self.num_cameras
    }
    fn num_points(&self) -> usize {
        self.num_points
    }
    fn observations(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn loss(&self) -> RobustLoss {
        self.loss
    }
    fn residual(&self, state: &State, observation: usize) -> [f64; 2] {
        state.residual(&self.observations[observation])
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<9, 0> {
        let o = &self.observations[observation];
        let camera = &state.cameras[o.camera];
        let rotated = camera.pose.rotated(&state.points[o.point]);
        let p = rotated + camera.pose.translation;
        let [focal, k1, k2] = camera.intrinsics;
        let normalized = [-p.x / p.z, -p.y / p.z];
        let radial = radial_terms(normalized, k1, k2);
        let [x, y] = normalized;
        let mut terms = ObservationTerms {
            residual: [
                focal * radial.factor * x - o.pixel.x,
                focal * radial.factor * y - o.pixel.y,
            ],
            camera: [[0.0; 9]; 2],
            shared: [[], []],
            point: [[0.0; 3]; 2],
        };
        for row in 0..2 {
            // ∂p/∂P = −1/z [1 0 x; 0 1 y], with x and y after the division.
            let (a, b) = (
                focal * radial.jacobian[row][0],
                focal * radial.jacobian[row][1],
            );
            let by_p = Vector3::new(-a / p.z, -b / p.z, -(a * x + b * y) / p.z);
            let (by_pose, by_point) = camera.pose.derivatives(&rotated, &by_p);
            terms.camera[row][..6].copy_from_slice(&by_pose);
            terms.camera[row][6] = radial.factor * normalized[row];
            terms.camera[row][7] = focal * radial.r_sq * normalized[row];
            terms.camera[row][8] = focal * radial.r_sq * radial.r_sq * normalized[row];
            terms.point[row] = by_point;
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<9, 0>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            new.pose = old.pose.moved([d[0], d[1], d[2], d[3], d[4], d[5]]);
            for k in 0..3 {
                new.intrinsics[k] = old.intrinsics[k] + d[6 + k];
            }
        }
        move_points(&from.points, &step.points, &mut into.points);
    }

    fn parameter_norm(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for camera in &state.cameras {
            sum += 1.0 + camera.pose.translation.norm_squared();
            sum += camera.intrinsics.iter().map(|x| x * x).sum::<f64>();
        }
        (sum + sum_of_squares(&state.points)).sqrt()
    }
}
