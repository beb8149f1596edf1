//! What travels to and from the computation behind `bundle-adjustment`.

use super::run::MAX_STEPS;
use super::scene::{NUM_CAMERAS, SIZE, Scene, WIDTH};
use epipole::camera::{Camera, RigidTransform};
use nalgebra::{Point2, Point3, Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// Everything that the answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    /// Of cameras and points at the start, as a share of the width of the house.
    pub(super) disturbance: f64,
    /// Standard deviation of each coordinate of a feature.
    pub(super) noise_px: f64,
    /// Where the dragged feature is, pixels.
    pub(super) mark: [f64; 2],
    pub(super) huber: bool,
    pub(super) log_damping: f64,
    pub(super) seed: u64,
}

impl Request {
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        postcard::to_allocvec(self).unwrap_or_default()
    }
}

/// Where a camera stands, and how it is turned.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Stand {
    center: [f64; 3],
    rotation: [f64; 4],
}

impl Stand {
    pub(super) fn new(center: &Point3<f64>, rotation: &UnitQuaternion<f64>) -> Self {
        Self {
            center: center.coords.into(),
            rotation: rotation.coords.into(),
        }
    }

    fn cam_from_world(&self) -> RigidTransform {
        let rotation = UnitQuaternion::new_normalize(Quaternion::from_vector(self.rotation.into()));
        let translation = -(rotation * Point3::from(self.center).coords);
        RigidTransform::from_parts(Translation3::from(translation), rotation)
    }

    fn is_sound(&self) -> bool {
        let turn: f64 = self.rotation.iter().map(|x| x * x).sum();
        self.center.iter().all(|x| is_sound(*x)) && (0.5..2.0).contains(&turn)
    }
}

/// Where everything is, in the frame of the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Place {
    /// Root of the mean square of the reprojection errors, pixels.
    pub(super) rms_px: f64,
    pub(super) stands: Vec<Stand>,
    pub(super) points: Vec<[f64; 3]>,
}

/// The start, or a step that was tried, and where everything is after it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Step {
    /// ½ Σ ρ(‖r‖²), square pixels.
    pub(super) cost: f64,
    pub(super) damping: f64,
    /// Whether the step was kept.
    pub(super) accepted: bool,
    pub(super) place: Place,
}

/// What the computation finds, as it travels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Wire {
    /// Places of the features in the photograph that is shown, pixels.
    pub(super) pixels: Vec<(f64, f64)>,
    pub(super) num_observations: usize,
    pub(super) converged: bool,
    /// The first one is the start.
    pub(super) steps: Vec<Step>,
}

/// Cameras and points after a step, and how good they are.
pub(super) struct State {
    pub(super) cameras: Vec<Camera>,
    pub(super) points: Vec<Point3<f64>>,
    /// Root of the mean square of the reprojection errors, pixels.
    pub(super) rms_px: f64,
    pub(super) cost: f64,
    pub(super) damping: f64,
    pub(super) accepted: bool,
    /// Root of the mean square of all distances of points from the truth, as a share of the width.
    pub(super) off: f64,
}

/// What the computation finds.
pub(super) struct Answer {
    pub(super) features: Vec<Point2<f64>>,
    pub(super) num_observations: usize,
    pub(super) converged: bool,
    /// The first one is the start; there is always one.
    pub(super) states: Vec<State>,
}

fn is_sound(value: f64) -> bool {
    value.is_finite() && value.abs() < 1e9
}

impl Answer {
    /// Reads an answer; `None` if it is none.
    pub(super) fn from_bytes(bytes: &[u8], scene: &Scene) -> Option<Self> {
        let wire: Wire = postcard::from_bytes(bytes).ok()?;
        let num_points = scene.points.len();
        let fits = (1..=MAX_STEPS + 1).contains(&wire.steps.len())
            && wire.pixels.len() == num_points
            && (wire.pixels.iter()).all(|(u, v)| is_sound(*u) && is_sound(*v))
            && (1..=NUM_CAMERAS * num_points).contains(&wire.num_observations);
        let states = wire.steps.into_iter().map(|step| State::new(step, scene));
        Some(Self {
            features: wire
                .pixels
                .iter()
                .map(|(u, v)| Point2::new(*u, *v))
                .collect(),
            num_observations: wire.num_observations,
            converged: wire.converged,
            states: fits.then(|| states.collect::<Option<_>>())??,
        })
    }

    /// The number of steps after the start.
    pub(super) fn num_steps(&self) -> usize {
        self.states.len() - 1
    }
}

impl State {
    fn new(step: Step, scene: &Scene) -> Option<Self> {
        let place = &step.place;
        let fits = place.stands.len() == NUM_CAMERAS
            && place.points.len() == scene.points.len()
            && place.stands.iter().all(Stand::is_sound)
            && place.points.iter().flatten().all(|x| is_sound(*x))
            && [step.cost, step.damping, place.rms_px]
                .iter()
                .all(|x| x.is_finite() && *x >= 0.0);
        let cameras = (place.stands.iter().zip(&scene.cameras)).map(|(stand, camera)| Camera {
            cam_from_world: stand.cam_from_world(),
            ..*camera
        });
        let points: Vec<Point3<f64>> = place.points.iter().map(|p| Point3::from(*p)).collect();
        let squares = points
            .iter()
            .zip(&scene.points)
            .map(|(a, b)| (a - b).norm_squared());
        let mean_square = squares.sum::<f64>() / points.len().max(1) as f64;
        fits.then_some(Self {
            cameras: cameras.collect(),
            rms_px: place.rms_px,
            cost: step.cost,
            damping: step.damping,
            accepted: step.accepted,
            off: mean_square.sqrt() / WIDTH,
            points,
        })
    }

    /// Where a camera would show each point; `None` for one that is not in front of it or far
    /// outside the picture.
    pub(super) fn shown(&self, camera: usize) -> Vec<Option<Point2<f64>>> {
        let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
        let near = |pixel: &Point2<f64>| {
            (-width..2.0 * width).contains(&pixel.x) && (-height..2.0 * height).contains(&pixel.y)
        };
        let place = |point| self.cameras[camera].project(point).ok().filter(near);
        self.points.iter().map(place).collect()
    }
}
