//! The job of `bundle-adjustment`: all steps of the core's own loop.

use crate::contract::{Problem, Progress};
use crate::kit::house::{House, MARK, NUM_CAMERAS, SHOWN, SIZE, WIDTH};
use crate::kit::question::{self, tell};
use epipole::Error;
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use epipole::optim::{LmOptions, LmReport, RobustLoss};
use epipole::sfm::{
    AlignmentKind, Bundle, BundleObservation, BundleOptions, adjust_bundle, align_points,
};
use nalgebra::{Point2, Point3, Translation3, UnitQuaternion, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// Maximum number of steps; more show nothing new.
pub(super) const MAX_STEPS: usize = 24;
/// Relative decrease of the cost below which the loop has converged.
const COST_TOLERANCE: f64 = 1e-5;
/// Width of Huber's loss, pixels.
const HUBER_PX: f64 = 2.0;
/// Rotation of a camera for a perturbation of 1, radians (standard deviation per axis).
const ROTATION_RAD: f64 = 0.5;

/// All inputs of the job.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    /// Perturbation of cameras and points at the start, relative to the width of the house.
    pub(super) disturbance: f64,
    /// Standard deviation of each coordinate of a feature, pixels.
    pub(super) noise_px: f64,
    /// Outlier ratio of the features.
    pub(super) wrong: f64,
    /// Position of the dragged feature, pixels.
    pub(super) mark: (f64, f64),
    pub(super) is_robust: bool,
    pub(super) log_damping: f64,
    pub(super) seed: u64,
}

/// The start or a trial step, with the cameras and points after it in the ground-truth frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    /// ½ Σ ρ(‖r‖²), square pixels.
    pub(super) cost: f64,
    pub(super) damping: f64,
    /// Whether the step was kept.
    pub(super) accepted: bool,
    /// RMS reprojection error, pixels.
    pub(super) rms_px: f64,
    /// RMS distance of the points from the truth, relative to the width of the house.
    pub(super) off: f64,
    /// `cam_from_world` of each camera.
    pub(super) poses: Vec<RigidTransform>,
    pub(super) points: Vec<Point3<f64>>,
}

/// A feature in the photograph shown.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Feature {
    pub(super) pixel: Point2<f64>,
    /// Whether it is an outlier.
    pub(super) is_wrong: bool,
}

/// Steps of the adjustment, and the features shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    /// Features, one for each point of the house.
    pub(super) features: Vec<Feature>,
    pub(super) num_observations: usize,
    pub(super) converged: bool,
    /// The start, then one state per step; never empty.
    pub(super) states: Vec<State>,
}

impl Answer {
    /// The number of steps after the start.
    pub(super) fn num_steps(&self) -> usize {
        self.states.len() - 1
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Adjusting cameras and points";
    const FAILED: &'static str = "There is no adjustment";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let house = House::new()?;
        let (features, start) = self.disturbed(&house);
        let report = self.adjust(&mut start.clone(), MAX_STEPS)?;
        let mut states: Vec<State> = Vec::new();
        for iteration in &report.history {
            let state = match states.last() {
                // A rejected step leaves everything unchanged.
                Some(before) if !iteration.accepted => before.clone(),
                _ => {
                    let mut bundle = start.clone();
                    self.adjust(&mut bundle, iteration.index)?;
                    aligned(&bundle, &house)?
                }
            };
            states.push(State {
                cost: iteration.cost,
                damping: iteration.damping,
                accepted: iteration.accepted,
                ..state
            });
            tell(progress, states.len() as f64 / report.history.len() as f64)?;
        }
        Ok(Answer {
            features,
            num_observations: start.observations.len(),
            converged: report.termination.is_converged(),
            states,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let Some(num_points) = answer.states.first().map(|state| state.points.len()) else {
            return false;
        };
        // NaN fails the comparison.
        let is_sound = |x: &f64| x.abs() < 1e9;
        let is_state = |state: &State| {
            state.poses.len() == NUM_CAMERAS
                && state.points.len() == num_points
                && [state.cost, state.damping, state.rms_px, state.off]
                    .iter()
                    .all(|x| x.is_finite() && *x >= 0.0)
                && state.points.iter().flat_map(|p| p.iter()).all(is_sound)
                && state.poses.iter().all(|pose| {
                    pose.translation.vector.iter().all(is_sound)
                        && (pose.rotation.coords.norm() - 1.0).abs() < 1e-6
                })
        };
        House::new().is_ok_and(|house| house.points.len() == num_points)
            && answer.states.len() <= MAX_STEPS + 1
            && answer.states.iter().all(is_state)
            && answer.features.len() == num_points
            && (answer.features.iter())
                .flat_map(|feature| feature.pixel.iter())
                .all(is_sound)
            && (1..=NUM_CAMERAS * num_points).contains(&answer.num_observations)
    }
}

impl Question {
    /// Runs the adjustment for at most `max_iterations` steps.
    fn adjust(&self, bundle: &mut Bundle, max_iterations: usize) -> Result<LmReport, Error> {
        let options = BundleOptions::default()
            .with_lm(
                LmOptions::default()
                    .with_max_iterations(max_iterations)
                    .with_cost_tolerance(COST_TOLERANCE)
                    .with_initial_damping(libm::exp10(self.log_damping)),
            )
            .with_loss(match self.is_robust {
                true => RobustLoss::Huber { width: HUBER_PX },
                false => RobustLoss::Trivial,
            });
        adjust_bundle(bundle, &options, &mut ())
    }

    /// Returns the features of the photograph shown, and a bundle of noisy observations with
    /// perturbed cameras and points.
    fn disturbed(&self, house: &House) -> (Vec<Feature>, Bundle) {
        // Noise and outliers must not depend on the perturbation.
        let mut noise = Random::new(1000 + self.seed);
        let mut chance = Random::new(2000 + self.seed);
        let mut features = Vec::new();
        let mut random = Random::new(self.seed);
        let mut bundle = Bundle::default();
        for (camera, true_camera) in house.cameras.iter().enumerate() {
            for (point, place) in house.points.iter().enumerate() {
                let off = Vector2::new(noise.normal(), noise.normal()) * self.noise_px;
                let is_mark = camera == SHOWN && point == MARK;
                let is_wrong = chance.uniform(0.0, 1.0) < self.wrong && !is_mark;
                let elsewhere = Point2::new(
                    chance.uniform(0.0, f64::from(SIZE.0)),
                    chance.uniform(0.0, f64::from(SIZE.1)),
                );
                let pixel = match true_camera.project(place) {
                    _ if is_wrong => elsewhere,
                    _ if is_mark => Point2::new(self.mark.0, self.mark.1),
                    Ok(pixel) => pixel + off,
                    // The house is in front of all cameras.
                    Err(_) => continue,
                };
                bundle.observations.push(BundleObservation {
                    camera,
                    point,
                    pixel,
                });
                if camera == SHOWN {
                    features.push(Feature { pixel, is_wrong });
                }
            }
        }
        let mut vector = || Vector3::new(random.normal(), random.normal(), random.normal());
        let length = self.disturbance * WIDTH;
        for camera in &house.cameras {
            let turn = UnitQuaternion::from_scaled_axis(vector() * self.disturbance * ROTATION_RAD);
            let rotation = turn * camera.cam_from_world.rotation;
            let center = camera.center_in_world() + vector() * length;
            let translation = Translation3::from(-(rotation * center.coords));
            let mut camera = *camera;
            camera.cam_from_world = RigidTransform::from_parts(translation, rotation);
            bundle.cameras.push(camera);
        }
        for point in &house.points {
            bundle.points.push(point + vector() * (0.7 * length));
        }
        (features, bundle)
    }
}

/// Returns the state after the best similarity alignment to the truth, since photographs determine
/// neither position, rotation nor scale of the world (seven freedoms).
fn aligned(bundle: &Bundle, house: &House) -> Result<State, Error> {
    let true_from_found = align_points(&bundle.points, &house.points, AlignmentKind::Similarity)?;
    let pose = |camera: &epipole::camera::PosedCamera| {
        let center = true_from_found * camera.center_in_world();
        let rotation = camera.cam_from_world.rotation * true_from_found.isometry.rotation.inverse();
        RigidTransform::from_parts(Translation3::from(-(rotation * center.coords)), rotation)
    };
    let points: Vec<_> = (bundle.points.iter())
        .map(|point| true_from_found * point)
        .collect();
    let root_mean = |sum: f64, count: usize| (sum / count.max(1) as f64).sqrt();
    let num_observations = bundle.observations.len();
    let squares_px = (0..num_observations).map(|n| bundle.residual_px(n).norm_squared());
    let squares = points
        .iter()
        .zip(&house.points)
        .map(|(a, b)| (a - b).norm_squared());
    Ok(State {
        cost: 0.0,
        damping: 0.0,
        accepted: true,
        rms_px: root_mean(squares_px.sum(), num_observations),
        off: root_mean(squares.sum(), points.len()) / WIDTH,
        poses: bundle.cameras.iter().map(pose).collect(),
        points,
    })
}
