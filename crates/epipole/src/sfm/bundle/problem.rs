//! A bundle as a least-squares problem: residuals, derivatives and steps.

use super::lens_state::LensState;
use super::options::BundleOptions;
use super::scene::{Bundle, Eye};
use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
use crate::camera::{Lens, MAX_COEFFICIENTS};
use crate::optim::{BundleProblem, BundleStep, ObservationTerms, PriorTerms, RobustLoss};
use nalgebra::{Point2, Point3, Vector3};

#[derive(Clone)]
pub(super) struct State {
    pub(super) cameras: Vec<PoseState>,
    pub(super) lenses: Vec<LensState>,
    pub(super) points: Vec<Point3<f64>>,
}

impl State {
    /// * `lenses`: lenses of the bundle, by number
    pub(super) fn new(bundle: &Bundle, lenses: &[Lens]) -> Self {
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
            lenses: lenses.iter().map(|lens| LensState::new(*lens)).collect(),
            points: bundle.points.clone(),
        }
    }
}

pub(super) struct Problem<'a, const S: usize> {
    pub(super) bundle: &'a Bundle,
    pub(super) pairs: Vec<(u32, u32)>,
    pub(super) options: &'a BundleOptions,
    pub(super) held_cameras: Vec<[bool; 6]>,
    /// Refined coefficients of each lens.
    pub(super) refined: Vec<[bool; MAX_COEFFICIENTS]>,
}

/// An observation in a state of cameras and lenses.
struct Sight<'a> {
    camera: &'a PoseState,
    eye: Eye<'a>,
    lens: &'a LensState,
    /// The point rotated by the camera, see [`PoseState::rotated`].
    rotated: Vector3<f64>,
    /// The point in the frame of the eye.
    p: Vector3<f64>,
    pixel: Point2<f64>,
}

impl Sight<'_> {
    /// Returns the initial focal length for a row of the residual.
    fn focal_px(&self, row: usize) -> f64 {
        match row {
            0 => self.eye.camera.intrinsics.fu_px(),
            _ => self.eye.camera.intrinsics.fv_px(),
        }
    }
}

fn nothing<const S: usize>() -> ObservationTerms<6, S> {
    ObservationTerms {
        residual: [0.0; 2],
        camera: [[0.0; 6]; 2],
        shared: [[0.0; S]; 2],
        point: [[0.0; 3]; 2],
    }
}

impl<const S: usize> Problem<'_, S> {
    #[inline]
    fn sight<'a>(&'a self, state: &'a State, observation: usize) -> Sight<'a> {
        let o = &self.bundle.observations[observation];
        let camera = &state.cameras[o.camera];
        let eye = self.bundle.eye(observation);
        let rotated = camera.rotated(&state.points[o.point]);
        let mut p = rotated + camera.translation;
        if let Some(sensor_from_camera) = eye.sensor_from_camera {
            p = (sensor_from_camera * Point3::from(p)).coords;
        }
        Sight {
            lens: &state.lenses[eye.lens],
            camera,
            eye,
            rotated,
            p,
            pixel: o.pixel,
        }
    }

    /// Fills a row of the linearized terms.
    ///
    /// * `shown`: projection by the lens, in units of the focal length
    /// * `by_p`: derivative of the pixel by the point in the frame of the eye
    /// * `by_coefficients`: derivative of `shown` by the lens coefficients
    #[inline]
    fn fill(
        &self,
        terms: &mut ObservationTerms<6, S>,
        row: usize,
        sight: &Sight<'_>,
        shown: f64,
        mut by_p: Vector3<f64>,
        by_coefficients: &[f64],
    ) {
        let focal_px = sight.focal_px(row);
        let f = focal_px * sight.lens.focal;
        let center = sight.eye.camera.intrinsics.principal_point() + sight.lens.shift_px;
        terms.residual[row] = f * shown + center[row] - sight.pixel[row];
        if let Some(sensor_from_camera) = sight.eye.sensor_from_camera {
            by_p = sensor_from_camera.rotation.inverse() * by_p;
        }
        (terms.camera[row], terms.point[row]) = sight.camera.derivatives(&sight.rotated, &by_p);
        let shared = &mut terms.shared[row];
        shared[0] = focal_px * shown;
        shared[S - 2 + row] = 1.0;
        let refined = &self.refined[sight.eye.lens];
        let slots = shared[1..S - 2].iter_mut().zip(by_coefficients);
        for ((slope, by), refined) in slots.zip(refined) {
            *slope = if *refined { f * by } else { 0.0 };
        }
    }

    /// Implements [`linearize`](BundleProblem::linearize) for lenses other than Brown's.
    fn linearize_beyond_brown(&self, sight: &Sight<'_>) -> ObservationTerms<6, S> {
        let (lens, p) = (&sight.lens.lens, &sight.p);
        let shown = lens.project_or_mirror(p);
        let (by_point, by_coefficients) = lens.derivatives(p);
        let mut terms = nothing();
        for row in 0..2 {
            let f = sight.focal_px(row) * sight.lens.focal;
            let by_p = by_point.row(row).transpose() * f;
            self.fill(
                &mut terms,
                row,
                sight,
                shown[row],
                by_p,
                &by_coefficients[row],
            );
        }
        terms
    }
}

impl<const S: usize> BundleProblem<6, S> for Problem<'_, S> {
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
    fn held_shared(&self) -> [bool; S] {
        let mut held = [true; S];
        held[0] = !self.options.refine_focal;
        // Hold a coefficient unless some lens refines it; the other lenses have zero derivatives.
        for (n, held) in held[1..S - 2].iter_mut().enumerate() {
            *held = !self.refined.iter().any(|refined| refined[n]);
        }
        held[S - 2..].fill(!self.options.refine_principal_point);
        held
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
        let sight = self.sight(state, observation);
        let lens = sight.lens;
        let shown = lens.lens.project_or_mirror(&sight.p);
        let center = sight.eye.camera.intrinsics.principal_point() + lens.shift_px;
        [
            lens.focal * sight.eye.camera.intrinsics.fu_px() * shown.x + center.x - sight.pixel.x,
            lens.focal * sight.eye.camera.intrinsics.fv_px() * shown.y + center.y - sight.pixel.y,
        ]
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<6, S> {
        let sight = self.sight(state, observation);
        let (p, lens) = (&sight.p, sight.lens);
        let Lens::Brown(distortion) = &lens.lens else {
            return self.linearize_beyond_brown(&sight);
        };
        let ray = Point2::new(p.x / p.z, p.y / p.z);
        let shown = distortion.distort(&ray);
        let bend = distortion.jacobian(&ray);
        let (x, y) = (ray.x, ray.y);
        let r_sq = x * x + y * y;
        // Derivatives by k1, k2, p1 and p2, without the focal length.
        let by_distortion = [
            [r_sq * x, r_sq * r_sq * x, 2.0 * x * y, r_sq + 2.0 * x * x],
            [r_sq * y, r_sq * r_sq * y, r_sq + 2.0 * y * y, 2.0 * x * y],
        ];
        let mut terms = nothing();
        for row in 0..2 {
            let f = sight.focal_px(row) * lens.focal;
            // ∂p/∂P = 1/z [1 0 −x; 0 1 −y], with x and y after the division.
            let (a, b) = (f * bend[(row, 0)], f * bend[(row, 1)]);
            let by_p = Vector3::new(a / p.z, b / p.z, -(a * x + b * y) / p.z);
            self.fill(
                &mut terms,
                row,
                &sight,
                shown[row],
                by_p,
                &by_distortion[row],
            );
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<6, S>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            *new = old.moved(*d);
        }
        // Empty if no lens is refined.
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
