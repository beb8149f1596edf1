//! Calibration as a least-squares problem: one or two cameras, the pose of the board in every view,
//! and the pixels.

use crate::camera::moving_pose::PoseState;
use crate::camera::{Intrinsics, Lens, LensKind, RigidTransform};
use crate::optim::{
    BundleProblem, BundleStep, LmOptions, LmReport, ObservationTerms, RobustLoss, SchurSystem,
    minimize,
};
use crate::progress::Monitor;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

/// Number of parameters of a camera: fu, fv, cu, cv and those of its lens.
pub(super) const OF_CAMERA: usize = 12;
/// Number of parameters of the motion of a rig and two cameras.
pub(super) const SHARED: usize = 6 + 2 * OF_CAMERA;

/// A mark of the board with its pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct DetectedMark {
    pub(super) view: usize,
    pub(super) mark: usize,
    /// 1 for the second camera of a rig, else 0.
    pub(super) eye: usize,
    pub(super) pixel: Point2<f64>,
}

/// All estimated parameters.
#[derive(Clone)]
pub(super) struct State {
    /// `cam1_from_board` of each view.
    pub(super) views: Vec<PoseState>,
    /// `cam2_from_cam1`.
    pub(super) rig: PoseState,
    pub(super) cameras: [[f64; OF_CAMERA]; 2],
}

impl State {
    pub(super) fn pose(pose: &PoseState) -> RigidTransform {
        RigidTransform::from_parts(pose.translation.into(), pose.rotation)
    }
}

pub(super) fn pose_state(pose: &RigidTransform) -> PoseState {
    PoseState::new(pose.rotation, pose.translation.vector)
}

/// Returns the parameters of a camera.
pub(super) fn camera_numbers(k: &Intrinsics, lens: &Lens) -> [f64; OF_CAMERA] {
    let center = k.principal_point();
    let mut numbers = [0.0; OF_CAMERA];
    numbers[..4].copy_from_slice(&[k.fu_px(), k.fv_px(), center.x, center.y]);
    let coefficients = lens.coefficients();
    numbers[4..4 + coefficients.len()].copy_from_slice(&coefficients);
    numbers
}

/// Returns the lens with these parameters.
pub(super) fn lens_of(kind: LensKind, numbers: &[f64; OF_CAMERA]) -> Lens {
    Lens::of(kind, core::array::from_fn(|i| numbers[4 + i]))
}

pub(super) struct Problem {
    /// Marks in the plane of the board, meters.
    pub(super) marks: Vec<Point3<f64>>,
    pub(super) observations: Vec<DetectedMark>,
    pub(super) num_views: usize,
    pub(super) kinds: [LensKind; 2],
    /// Whether each parameter of the rig's motion and of the two cameras is held.
    pub(super) held: [bool; SHARED],
    pairs: Vec<(u32, u32)>,
}

impl Problem {
    pub(super) fn new(
        marks: Vec<Point3<f64>>,
        observations: Vec<DetectedMark>,
        num_views: usize,
        kinds: [LensKind; 2],
        held: [bool; SHARED],
    ) -> Self {
        let pairs = observations
            .iter()
            .map(|o| (o.view as u32, o.mark as u32))
            .collect();
        Self {
            marks,
            observations,
            num_views,
            kinds,
            held,
            pairs,
        }
    }

    /// Moves the state to the nearest minimum of the sum of squares.
    pub(super) fn minimize(
        &self,
        state: &mut State,
        options: &LmOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<LmReport> {
        minimize(&mut SchurSystem::new(self), state, options, monitor)
    }

    /// Returns the mark in the frame of the observing camera, with the intermediate results of both
    /// rotations.
    fn place(&self, state: &State, o: &DetectedMark) -> Place {
        let pose = &state.views[o.view];
        let rotated = pose.rotated(&self.marks[o.mark]);
        let in_first = rotated + pose.translation;
        if o.eye == 0 {
            return Place {
                rotated,
                rotated_by_rig: in_first,
                in_cam: in_first,
            };
        }
        let rotated_by_rig = state.rig.rotated(&Point3::from(in_first));
        Place {
            rotated,
            rotated_by_rig,
            in_cam: rotated_by_rig + state.rig.translation,
        }
    }

    /// Returns the RMS reprojection error of the marks that count.
    pub(super) fn rms_px(&self, state: &State, counts: impl Fn(&DetectedMark) -> bool) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for (index, o) in self.observations.iter().enumerate() {
            if counts(o) {
                let [u, v] = self.residual(state, index);
                sum += u * u + v * v;
                count += 1;
            }
        }
        (sum / f64::from(count.max(1))).sqrt()
    }
}

struct Place {
    rotated: Vector3<f64>,
    rotated_by_rig: Vector3<f64>,
    in_cam: Vector3<f64>,
}

impl BundleProblem<6, SHARED> for Problem {
    type Parameters = State;

    fn num_cameras(&self) -> usize {
        self.num_views
    }
    fn num_points(&self) -> usize {
        self.marks.len()
    }
    fn observations(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn loss(&self) -> RobustLoss {
        RobustLoss::Trivial
    }
    fn held_shared(&self) -> [bool; SHARED] {
        self.held
    }
    // The board is known.
    fn held_point(&self, _: usize) -> bool {
        true
    }

    fn residual(&self, state: &State, observation: usize) -> [f64; 2] {
        let o = &self.observations[observation];
        let numbers = &state.cameras[o.eye];
        let lens = lens_of(self.kinds[o.eye], numbers);
        // Points outside the lens's domain have no residual, and the solver does not step there.
        let Some(projected) = lens.project(&self.place(state, o).in_cam) else {
            return [f64::NAN; 2];
        };
        [
            numbers[0] * projected.x + numbers[2] - o.pixel.x,
            numbers[1] * projected.y + numbers[3] - o.pixel.y,
        ]
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<6, SHARED> {
        let o = &self.observations[observation];
        let place = self.place(state, o);
        let numbers = &state.cameras[o.eye];
        let lens = lens_of(self.kinds[o.eye], numbers);
        let mut terms = ObservationTerms {
            residual: self.residual(state, observation),
            camera: [[0.0; 6]; 2],
            shared: [[0.0; SHARED]; 2],
            point: [[0.0; 3]; 2],
        };
        let (by_point, by_lens) = lens.derivatives(&place.in_cam);
        let projected = lens.project(&place.in_cam).unwrap_or_default();
        let first = 6 + o.eye * OF_CAMERA;
        for row in 0..2 {
            let focal = numbers[row];
            let shared = &mut terms.shared[row];
            shared[first + row] = projected[row];
            shared[first + 2 + row] = 1.0;
            for (k, slope) in by_lens[row].iter().enumerate() {
                shared[first + 4 + k] = focal * slope;
            }
            let mut by_p: Vector3<f64> = by_point.row(row).transpose() * focal;
            if o.eye == 1 {
                let (by_rig, by_first) = state.rig.derivatives(&place.rotated_by_rig, &by_p);
                shared[..6].copy_from_slice(&by_rig);
                by_p = Vector3::from(by_first);
            }
            terms.camera[row] = state.views[o.view].derivatives(&place.rotated, &by_p).0;
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<6, SHARED>, into: &mut State) {
        for ((old, new), d) in from.views.iter().zip(&mut into.views).zip(&step.cameras) {
            *new = old.moved(*d);
        }
        let shared = &step.shared[0];
        into.rig = from.rig.moved(core::array::from_fn(|i| shared[i]));
        for (eye, camera) in into.cameras.iter_mut().enumerate() {
            for (i, number) in camera.iter_mut().enumerate() {
                *number = from.cameras[eye][i] + shared[6 + eye * OF_CAMERA + i];
            }
        }
    }

    fn parameter_norm(&self, state: &State) -> f64 {
        let views: f64 = state
            .views
            .iter()
            .map(|v| 1.0 + v.translation.norm_squared())
            .sum();
        let numbers: f64 = state.cameras.iter().flatten().map(|x| x * x).sum();
        (views + numbers).sqrt()
    }
}

/// Returns solver options strict enough for the last digits of uncertain parameters.
pub(super) fn strict(max_iterations: usize) -> LmOptions {
    LmOptions {
        max_iterations,
        cost_tolerance: 1e-12,
        ..LmOptions::default()
    }
}

/// Returns the intrinsics; an error if the solver diverged to a focal length that is NaN or not
/// positive.
pub(super) fn intrinsics_of(numbers: &[f64; OF_CAMERA]) -> Result<Intrinsics> {
    Intrinsics::new(numbers[0], numbers[1], numbers[2], numbers[3]).map_err(|_| Error::Degenerate {
        what: "a calibration",
        why: "the views of the board fit no camera; they are too few, too much alike, or not of this board",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Compares all derivatives with central differences, for both cameras and all lenses.
    #[test]
    fn derivatives_are_differences() {
        let mut random = Random::new(5);
        for kind in [
            LensKind::Brown,
            LensKind::Rational,
            LensKind::Fisheye,
            LensKind::Division,
        ] {
            let marks: Vec<_> = (0..6)
                .map(|i| Point3::new(f64::from(i % 3) * 0.1, f64::from(i / 3) * 0.1, 0.0))
                .collect();
            let observations = (0..12)
                .map(|i| DetectedMark {
                    view: 0,
                    mark: i / 2,
                    eye: i % 2,
                    pixel: Point2::new(300.0, 200.0),
                })
                .collect();
            let problem = Problem::new(marks, observations, 1, [kind; 2], [false; SHARED]);
            let pose = |random: &mut Random| {
                pose_state(&RigidTransform::new(
                    Vector3::new(0.1, -0.1, 1.0),
                    Vector3::from_fn(|_, _| random.uniform(-0.3, 0.3)),
                ))
            };
            let mut numbers = [0.01; OF_CAMERA];
            numbers[..4].copy_from_slice(&[500.0, 510.0, 320.0, 240.0]);
            let state = State {
                views: vec![pose(&mut random)],
                rig: pose(&mut random),
                cameras: [numbers; 2],
            };
            for index in 0..12 {
                let terms = problem.linearize(&state, index);
                let h = 1e-6;
                for p in 0..6 + SHARED {
                    let [up, down] = [h, -h].map(|d| {
                        let mut step = BundleStep {
                            cameras: vec![[0.0; 6]],
                            shared: vec![[0.0; SHARED]],
                            points: vec![],
                        };
                        if p < 6 {
                            step.cameras[0][p] = d;
                        } else {
                            step.shared[0][p - 6] = d;
                        }
                        let mut moved = state.clone();
                        problem.step(&state, &step, &mut moved);
                        problem.residual(&moved, index)
                    });
                    for row in 0..2 {
                        let analytic = if p < 6 {
                            terms.camera[row][p]
                        } else {
                            terms.shared[row][p - 6]
                        };
                        let difference = (up[row] - down[row]) / (2.0 * h);
                        assert!(
                            (analytic - difference).abs() < 1e-4,
                            "{kind:?} {index} {p}: {analytic} {difference}"
                        );
                    }
                }
            }
        }
    }
}
