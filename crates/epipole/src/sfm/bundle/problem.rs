//! What the solver sees of a bundle: residuals, their derivatives, and steps.

use super::{Bundle, BundleOptions};
use crate::Result;
use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
use crate::camera::{Distortion, Intrinsics};
use crate::optim::{BundleProblem, BundleStep, ObservationTerms, PriorTerms, RobustLoss};
use nalgebra::{Point2, Point3, Vector2, Vector3};

/// What is refined of a lens: a factor of the focal lengths, k1, k2, p1, p2, the principal point's shift. What is
/// refined more often comes first: what is behind it costs nothing.
pub(super) const OF_LENS: usize = 7;

/// A lens, as far as it is refined.
#[derive(Clone)]
pub(super) struct LensState {
    focal: f64,
    shift_px: Vector2<f64>,
    pub(super) distortion: Distortion,
}

impl LensState {
    /// The intrinsics that became of these.
    pub(super) fn refined(&self, k: &Intrinsics) -> Result<Intrinsics> {
        let center = k.principal_point() + self.shift_px;
        Intrinsics::new(
            k.fu_px() * self.focal,
            k.fv_px() * self.focal,
            center.x,
            center.y,
        )
    }

    fn moved(&self, step: &[f64; OF_LENS]) -> Self {
        let [focal, k1, k2, p1, p2, u, v] = *step;
        let mut moved = self.clone();
        moved.focal += focal;
        moved.shift_px += Vector2::new(u, v);
        moved.distortion.k1 += k1;
        moved.distortion.k2 += k2;
        moved.distortion.p1 += p1;
        moved.distortion.p2 += p2;
        moved
    }
}

#[derive(Clone)]
pub(super) struct State {
    pub(super) cameras: Vec<PoseState>,
    pub(super) lenses: Vec<LensState>,
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
        let lens = |index: usize| LensState {
            focal: 1.0,
            shift_px: Vector2::zeros(),
            distortion: bundle.distortions.get(index).copied().unwrap_or_default(),
        };
        Self {
            cameras,
            lenses: (0..bundle.num_lenses()).map(lens).collect(),
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

impl BundleProblem<6, OF_LENS> for Problem<'_> {
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
    fn num_groups(&self) -> usize {
        match self.options.refines_lens() {
            true => self.bundle.num_lenses(),
            false => 0,
        }
    }
    fn group(&self, observation: usize) -> usize {
        self.bundle.eye(observation).lens
    }
    fn held_shared(&self) -> [bool; OF_LENS] {
        let held = |refined: bool| !refined;
        let focal = held(self.options.refine_focal);
        let center = held(self.options.refine_principal_point);
        let radial = held(self.options.refine_distortion);
        let tangential = held(self.options.refine_tangential);
        [
            focal, radial, radial, tangential, tangential, center, center,
        ]
    }
    fn prior(&self, state: &State, camera: usize) -> Option<PriorTerms<6>> {
        let known = (self.options.position_priors.get(camera)?).as_ref()?;
        let (center, by_pose) = state.cameras[camera].center();
        let off = center - known.center_in_world;
        let row = |i: usize| by_pose[i].map(|slope| slope / known.sigma[i]);
        Some(PriorTerms {
            residual: core::array::from_fn(|i| off[i] / known.sigma[i]),
            camera: core::array::from_fn(row),
        })
    }
    fn prior_loss(&self) -> RobustLoss {
        self.options.position_loss
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
        let eye = self.bundle.eye(observation);
        let mut p = camera.rotated(&state.points[o.point]) + camera.translation;
        if let Some(sensor_from_camera) = eye.sensor_from_camera {
            p = (sensor_from_camera * Point3::from(p)).coords;
        }
        let lens = &state.lenses[eye.lens];
        let shown = lens.distortion.distort(&Point2::new(p.x / p.z, p.y / p.z));
        let center = eye.intrinsics.principal_point() + lens.shift_px;
        [
            lens.focal * eye.intrinsics.fu_px() * shown.x + center.x - o.pixel.x,
            lens.focal * eye.intrinsics.fv_px() * shown.y + center.y - o.pixel.y,
        ]
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<6, OF_LENS> {
        let o = &self.bundle.observations[observation];
        let camera = &state.cameras[o.camera];
        let eye = self.bundle.eye(observation);
        let rotated = camera.rotated(&state.points[o.point]);
        let mut p = rotated + camera.translation;
        if let Some(sensor_from_camera) = eye.sensor_from_camera {
            p = (sensor_from_camera * Point3::from(p)).coords;
        }
        let lens = &state.lenses[eye.lens];
        let ray = Point2::new(p.x / p.z, p.y / p.z);
        let shown = lens.distortion.distort(&ray);
        let bend = lens.distortion.jacobian(&ray);
        let (x, y) = (ray.x, ray.y);
        let r_sq = x * x + y * y;
        // What k1, k2, p1 and p2 move, before the focal length.
        let by_distortion = [
            [r_sq * x, r_sq * r_sq * x, 2.0 * x * y, r_sq + 2.0 * x * x],
            [r_sq * y, r_sq * r_sq * y, r_sq + 2.0 * y * y, 2.0 * x * y],
        ];
        let center = eye.intrinsics.principal_point() + lens.shift_px;
        let focals = [eye.intrinsics.fu_px(), eye.intrinsics.fv_px()];
        let mut terms = ObservationTerms {
            residual: [0.0; 2],
            camera: [[0.0; 6]; 2],
            shared: [[0.0; OF_LENS]; 2],
            point: [[0.0; 3]; 2],
        };
        for row in 0..2 {
            let f = focals[row] * lens.focal;
            terms.residual[row] = f * shown[row] + center[row] - o.pixel[row];
            // ∂p/∂P = 1/z [1 0 −x; 0 1 −y], with x and y after the division.
            let (a, b) = (f * bend[(row, 0)], f * bend[(row, 1)]);
            let mut by_p = Vector3::new(a / p.z, b / p.z, -(a * x + b * y) / p.z);
            if let Some(sensor_from_camera) = eye.sensor_from_camera {
                by_p = sensor_from_camera.rotation.inverse() * by_p;
            }
            (terms.camera[row], terms.point[row]) = camera.derivatives(&rotated, &by_p);
            let shared = &mut terms.shared[row];
            shared[0] = focals[row] * shown[row];
            shared[5 + row] = 1.0;
            for (slope, by) in shared[1..5].iter_mut().zip(by_distortion[row]) {
                *slope = f * by;
            }
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<6, OF_LENS>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            *new = old.moved(*d);
        }
        // Empty where no lens is refined.
        for ((old, new), d) in from.lenses.iter().zip(&mut into.lenses).zip(&step.shared) {
            *new = old.moved(d);
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
