//! Bundle adjustment of pinhole cameras.

mod problem;
mod radial;
#[cfg(test)]
mod tests;

use super::shares::iterations;
use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::optim::{Iteration, LmOptions, LmReport, RobustLoss, SchurSystem, minimize};
use crate::progress::{Progress, Stage};
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Translation3, Vector2};
use problem::{Problem, State};
use std::ops::ControlFlow;

pub(super) use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
pub use radial::RadialDistortion;
pub(super) use radial::radial_terms;

/// A camera saw a point at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// Index of the camera.
    pub camera: usize,
    /// Index of the point.
    pub point: usize,
    /// Where it was seen, pixels.
    pub pixel: Point2<f64>,
}

/// A further camera that is bolted to each camera of a bundle, such as the right one of a stereo
/// rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// From the frame of the camera to that of the sensor; it is not refined.
    pub sensor_from_camera: RigidTransform,
    /// How the sensor's rays become pixels.
    pub intrinsics: Intrinsics,
}

/// Cameras, points and observations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bundle {
    /// The cameras.
    pub cameras: Vec<Camera>,
    /// The lens distortion that all cameras share.
    pub distortion: RadialDistortion,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// What was seen where.
    pub observations: Vec<Observation>,
    /// Further cameras bolted to each camera.
    pub sensors: Vec<Sensor>,
    /// For each observation, 0 if the camera itself made it, k if sensor k − 1 did; missing
    /// entries are 0.
    pub sensor_of_observation: Vec<usize>,
}

impl Bundle {
    /// The intrinsics that an observation was made with, and its sensor if it is not the camera
    /// itself.
    fn lens(&self, observation: usize) -> (&Intrinsics, Option<&Sensor>) {
        let sensor = match self.sensor_of_observation.get(observation) {
            Some(&k) if k > 0 => self.sensors.get(k - 1),
            _ => None,
        };
        let camera = &self.cameras[self.observations[observation].camera];
        (sensor.map_or(&camera.intrinsics, |s| &s.intrinsics), sensor)
    }

    /// Predicted minus observed pixel of an observation, given by its index; not finite if the
    /// point is in the camera's center plane. Points behind the camera are mirrored through its
    /// center, as in [`adjust_bundle`].
    pub fn residual_px(&self, observation: usize) -> Vector2<f64> {
        let o = &self.observations[observation];
        let (intrinsics, sensor) = self.lens(observation);
        let mut p = self.cameras[o.camera].cam_from_world * self.points[o.point];
        if let Some(sensor) = sensor {
            p = sensor.sensor_from_camera * p;
        }
        let shown = self.distortion.distort(&Point2::new(p.x / p.z, p.y / p.z));
        let center = intrinsics.principal_point();
        Vector2::new(
            intrinsics.fu_px() * shown.x + center.x - o.pixel.x,
            intrinsics.fv_px() * shown.y + center.y - o.pixel.y,
        )
    }
}

/// What keeps the reconstruction from drifting: position, orientation and scale of the world are
/// not observable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Gauge {
    /// The first camera and one coordinate of another one's translation are held fixed: exactly
    /// the seven free dimensions.
    #[default]
    TwoCameras,
    /// Nothing is fixed; damping alone keeps the solution in place.
    Free,
}

/// What to refine, and how.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BundleOptions {
    /// When to stop.
    pub lm: LmOptions,
    /// The loss of each reprojection error; its width is in pixels.
    pub loss: RobustLoss,
    /// Used only while fewer than two cameras are held.
    pub gauge: Gauge,
    /// Cameras that stay where they are, by index; missing entries are free.
    pub held_cameras: Vec<bool>,
    /// Points that stay where they are, by index; missing entries are free.
    pub held_points: Vec<bool>,
    /// Refine one factor for all focal lengths.
    pub refine_focal: bool,
    /// Refine the shared radial distortion.
    pub refine_distortion: bool,
}

/// Checks that observations refer to existing cameras and points and are finite.
pub(super) fn observation_pairs(
    observations: &[Observation],
    num_cameras: usize,
    num_points: usize,
) -> Result<Vec<(u32, u32)>> {
    if observations.is_empty() {
        return Err(Error::TooFew {
            what: "a bundle adjustment from observations",
            needed: 1,
            got: 0,
        });
    }
    observations
        .iter()
        .map(|o| {
            if o.camera >= num_cameras || o.point >= num_points {
                return Err(Error::OutOfRange {
                    what: "an observation's camera or point",
                    requirement: "the index of an existing one",
                    value: if o.camera >= num_cameras {
                        o.camera as f64
                    } else {
                        o.point as f64
                    },
                });
            }
            if !(o.pixel.x.is_finite() && o.pixel.y.is_finite()) {
                return Err(Error::NotFinite {
                    what: "an observation's pixel",
                });
            }
            Ok((o.camera as u32, o.point as u32))
        })
        .collect()
}

/// Which degrees of freedom of each camera are held.
fn held_freedoms(bundle: &Bundle, options: &BundleOptions) -> Vec<[bool; 6]> {
    let is_held = |i: usize| options.held_cameras.get(i).copied().unwrap_or(false);
    let mut held: Vec<[bool; 6]> = (0..bundle.cameras.len()).map(|i| [is_held(i); 6]).collect();
    let num_held = held.iter().filter(|h| h[0]).count();
    let point_held = options.held_points.iter().any(|&h| h);
    if options.gauge == Gauge::Free || num_held >= 2 || point_held {
        return held;
    }
    let mut seen = vec![false; bundle.cameras.len()];
    for o in &bundle.observations {
        seen[o.camera] = true;
    }
    let Some(anchor) = (0..held.len())
        .find(|&i| held[i][0])
        .or_else(|| (0..held.len()).find(|&i| seen[i]))
    else {
        return held;
    };
    held[anchor] = [true; 6];
    let origin = bundle.cameras[anchor].center_in_world();
    let mut farthest = (0.0, None);
    for (i, camera) in bundle.cameras.iter().enumerate() {
        let distance = (camera.center_in_world() - origin).norm();
        if i != anchor && seen[i] && distance > farthest.0 {
            farthest = (distance, Some(i));
        }
    }
    // A rig knows its own size, so only a single camera leaves the scale open.
    if let Some(other) = farthest.1
        && bundle.sensors.is_empty()
    {
        // A change of scale moves this camera's translation along R (C − C₀).
        let camera = &bundle.cameras[other];
        let slide = camera.cam_from_world.rotation * (camera.center_in_world() - origin);
        held[other][3 + slide.iamax()] = true;
    }
    held
}

/// Refines cameras, points and, if wanted, a common focal length and lens distortion, in place:
/// minimizes `½ Σ ρ(‖predicted − observed‖²)`, in square pixels.
///
/// * `observer`: called once before the first step and after every step; answer
///   [`ControlFlow::Break`] to cancel; the bundle is then the best found so far
///
/// Cameras and points without observations stay where they are.
///
/// # Errors
/// [`Error::TooFew`] without observations, [`Error::OutOfRange`] if an observation refers to a
/// camera or point that is not there, or for a loss that [`RobustLoss::check`] refuses,
/// [`Error::NotFinite`] if a pixel or the cost at the start is not finite.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis"; the gauge by two cameras
/// is its §9.
pub fn adjust_bundle(
    bundle: &mut Bundle,
    options: &BundleOptions,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<LmReport> {
    options.loss.check()?;
    let pairs = observation_pairs(
        &bundle.observations,
        bundle.cameras.len(),
        bundle.points.len(),
    )?;
    let mut state = State::new(bundle);
    if let Some(&sensor) = bundle
        .sensor_of_observation
        .iter()
        .find(|&&sensor| sensor > bundle.sensors.len())
    {
        return Err(Error::OutOfRange {
            what: "an observation's sensor",
            requirement: "0 or the number of an existing one",
            value: sensor as f64,
        });
    }
    let problem = Problem {
        bundle,
        pairs,
        options,
        held_cameras: held_freedoms(bundle, options),
    };
    let mut system = SchurSystem::new(&problem);
    let report = minimize(&mut system, &mut state, &options.lm, observer)?;
    let [focal, k1, k2] = state.shared;
    let (mut cameras, mut sensors) = (bundle.cameras.clone(), bundle.sensors.clone());
    let scaled = |k: &Intrinsics| {
        let center = k.principal_point();
        Intrinsics::new(k.fu_px() * focal, k.fv_px() * focal, center.x, center.y)
    };
    for (camera, new) in cameras.iter_mut().zip(&state.cameras) {
        camera.cam_from_world =
            RigidTransform::from_parts(Translation3::from(new.translation), new.rotation);
        if options.refine_focal {
            camera.intrinsics = scaled(&camera.intrinsics)?;
        }
    }
    if options.refine_focal {
        for sensor in &mut sensors {
            sensor.intrinsics = scaled(&sensor.intrinsics)?;
        }
    }
    (bundle.cameras, bundle.sensors) = (cameras, sensors);
    bundle.points = state.points;
    bundle.distortion = RadialDistortion { k1, k2 };
    Ok(report)
}

/// As [`adjust_bundle`], with the same result, telling `progress` what share of the steps that there may be at
/// most is done, in the one stage [`Stage::BundleAdjustment`].
///
/// Whoever breaks gets the best bundle found so far, as [`LmReport::termination`] says.
///
/// # Errors
/// As [`adjust_bundle`].
///
/// Source: as [`adjust_bundle`].
pub fn adjust_bundle_with_progress(
    bundle: &mut Bundle,
    options: &BundleOptions,
    progress: Progress<'_>,
) -> Result<LmReport> {
    let mut tell = iterations(progress, Stage::BundleAdjustment, &options.lm);
    adjust_bundle(bundle, options, &mut tell)
}
