//! What the solver sees of a bundle: residuals, their derivatives, and steps.

use super::radial::radial_terms;
use super::{Bundle, BundleOptions};
use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
use crate::optim::{BundleProblem, BundleStep, ObservationTerms, RobustLoss};
use nalgebra::{Point3, Vector3};

#[derive(Clone)]
pub(super) struct State {
    pub(super) cameras: Vec<PoseState>,
    /// Factor of all focal lengths, k1, k2.
    pub(super) shared: [f64; 3],
    pub(super) points: Vec<Point3<f64>>,
}

impl State {
    pub(super) fn new(bundle: &Bundle) -> Self {
        let cameras = bundle
            .cameras
            .iter()
            .map(|camera| {
                let pose = camera.cam_from_world;
                PoseState::new(pose.rotation, pose.translation.vector)
            })
            .collect();
        Self {
            cameras,
            shared: [1.0, bundle.distortion.k1, bundle.distortion.k2],
            points: bundle.points.clone(),
        }
    }
}

pub(super) struct Problem<'a> {
    pub(super) bundle: &'a Bundle,
    pub(super) pairs: Vec<(u32, u32)>,
    pub(super) options: &'a BundleOptions,
    pub(super) held_cameras: Vec<[bool; 6]>,
}

impl BundleProblem<6, 3> for Problem<'_> {
    type Parameters = State;

    fn num_cameras(&self) -> usize {
        self.bundle.cameras.len()
    }
    fn num_points(&self) -> usize {
        self.bundle.points.len()
    }
    fn observations(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn loss(&self) -> RobustLoss {
        self.options.loss
    }
    fn held_camera(&self, camera: usize) -> [bool; 6] {
        self.held_cameras[camera]
    }
    fn held_shared(&self) -> [bool; 3] {
        let (focal, distortion) = (self.options.refine_focal, self.options.refine_distortion);
        [!focal, !distortion, !distortion]
    }
    fn held_point(&self, point: usize) -> bool {
        self.options
            .held_points
            .get(point)
            .copied()
            .unwrap_or(false)
    }

    fn residual(&self, state: &State, observation: usize) -> [f64; 2] {
        let o = &self.bundle.observations[observation];
        let camera = &state.cameras[o.camera];
        let (intrinsics, sensor) = self.bundle.lens(observation);
        let mut p = camera.rotated(&state.points[o.point]) + camera.translation;
        if let Some(sensor) = sensor {
            p = (sensor.sensor_from_camera * Point3::from(p)).coords;
        }
        let (x, y) = (p.x / p.z, p.y / p.z);
        let [focal, k1, k2] = state.shared;
        let r_sq = x * x + y * y;
        let factor = focal * (1.0 + r_sq * (k1 + r_sq * k2));
        let center = intrinsics.principal_point();
        [
            factor * intrinsics.fu_px() * x + center.x - o.pixel.x,
            factor * intrinsics.fv_px() * y + center.y - o.pixel.y,
        ]
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<6, 3> {
        let o = &self.bundle.observations[observation];
        let camera = &state.cameras[o.camera];
        let (intrinsics, sensor) = self.bundle.lens(observation);
        let rotated = camera.rotated(&state.points[o.point]);
        let mut p = rotated + camera.translation;
        if let Some(sensor) = sensor {
            p = (sensor.sensor_from_camera * Point3::from(p)).coords;
        }
        let normalized = [p.x / p.z, p.y / p.z];
        let [x, y] = normalized;
        let [focal, k1, k2] = state.shared;
        let radial = radial_terms(normalized, k1, k2);
        let center = intrinsics.principal_point();
        let focals = [intrinsics.fu_px(), intrinsics.fv_px()];
        let seen = [o.pixel.x - center.x, o.pixel.y - center.y];
        let mut terms = ObservationTerms {
            residual: [0.0; 2],
            camera: [[0.0; 6]; 2],
            shared: [[0.0; 3]; 2],
            point: [[0.0; 3]; 2],
        };
        for row in 0..2 {
            let f = focals[row] * focal;
            terms.residual[row] = f * radial.factor * normalized[row] - seen[row];
            // ∂p/∂P = 1/z [1 0 −x; 0 1 −y], with x and y after the division.
            let (a, b) = (f * radial.jacobian[row][0], f * radial.jacobian[row][1]);
            let mut by_p = Vector3::new(a / p.z, b / p.z, -(a * x + b * y) / p.z);
            if let Some(sensor) = sensor {
                by_p = sensor.sensor_from_camera.rotation.inverse() * by_p;
            }
            (terms.camera[row], terms.point[row]) = camera.derivatives(&rotated, &by_p);
            terms.shared[row] = [
                focals[row] * radial.factor * normalized[row],
                f * radial.r_sq * normalized[row],
                f * radial.r_sq * radial.r_sq * normalized[row],
            ];
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<6, 3>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            *new = old.moved(*d);
        }
        for k in 0..3 {
            into.shared[k] = from.shared[k] + step.shared[k];
        }
        move_points(&from.points, &step.points, &mut into.points);
    }

    fn parameter_norm(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for camera in &state.cameras {
            sum += 1.0 + camera.translation.norm_squared();
        }
        (sum + sum_of_squares(&state.points)).sqrt()
    }
}
