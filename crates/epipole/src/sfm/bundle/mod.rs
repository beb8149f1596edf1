//! Bundle adjustment of pinhole cameras.

mod problem;
mod radial;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::look_at;
    use crate::math::random::Random;
    use crate::optim::{BundleProblem, BundleStep, Termination, check_jacobian};
    use nalgebra::{DMatrix, DVector, Vector3};

    /// Cameras on an arc look at a ball of points.
    fn arc(num_cameras: usize, num_points: usize, distortion: RadialDistortion) -> Bundle {
        let mut random = Random::new(21);
        let mut bundle = Bundle {
            distortion,
            ..Bundle::default()
        };
        let up = Vector3::new(0.0, -1.0, 0.0);
        for i in 0..num_cameras {
            let (s, c) = libm::sincos(0.15 * i as f64);
            let center = Point3::new(6.0 * s, 0.2 * i as f64, -6.0 * c);
            bundle.cameras.push(Camera {
                intrinsics: Intrinsics::centered(800.0, 640, 480).unwrap(),
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
                bundle.observations.push(Observation {
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

    fn disturb(bundle: &mut Bundle, amount: f64) {
        let mut random = Random::new(22);
        for camera in bundle.cameras.iter_mut().skip(1) {
            let turn = Vector3::from_fn(|_, _| amount * random.normal());
            let shift = Vector3::from_fn(|_, _| amount * random.normal());
            camera.cam_from_world = RigidTransform::new(shift, turn) * camera.cam_from_world;
        }
        for point in &mut bundle.points {
            *point += Vector3::from_fn(|_, _| amount * random.normal());
        }
    }

    fn go_on(_: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn exact() -> LmOptions {
        LmOptions {
            cost_tolerance: 0.0,
            max_iterations: 100,
            ..LmOptions::default()
        }
    }

    #[test]
    fn jacobians_are_those_of_central_differences() {
        let distortion = RadialDistortion { k1: -0.1, k2: 0.03 };
        let mut bundle = arc(3, 5, distortion);
        disturb(&mut bundle, 0.02);
        let options = BundleOptions {
            refine_focal: true,
            refine_distortion: true,
            ..BundleOptions::default()
        };
        // The second half is seen by a sensor that looks from the side.
        let turn = Vector3::new(0.05, -0.2, 0.1);
        bundle.sensors.push(Sensor {
            sensor_from_camera: RigidTransform::new(Vector3::new(-0.5, 0.1, 0.05), turn),
            intrinsics: Intrinsics::new(700.0, 710.0, 300.0, 200.0).unwrap(),
        });
        bundle.sensor_of_observation = (0..15).map(|o| usize::from(o >= 8)).collect();
        let problem = Problem {
            bundle: &bundle,
            pairs: observation_pairs(&bundle.observations, 3, 5).unwrap(),
            options: &options,
            held_cameras: vec![[false; 6]; 3],
        };
        let state = State::new(&bundle);
        for (index, o) in bundle.observations.iter().enumerate() {
            let terms = problem.linearize(&state, index);
            let mut analytic = DMatrix::zeros(2, 12);
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
                let mut step = BundleStep {
                    cameras: vec![[0.0; 6]; 3],
                    shared: [d[6], d[7], d[8]],
                    points: vec![[0.0; 3]; 5],
                };
                step.cameras[o.camera].copy_from_slice(&d[..6]);
                step.points[o.point].copy_from_slice(&d[9..]);
                let mut moved = state.clone();
                problem.step(&state, &step, &mut moved);
                DVector::from_row_slice(&problem.residual(&moved, index))
            };
            assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
            let residual = bundle.residual_px(index);
            assert!((residual - Vector2::from(terms.residual)).norm() < 1e-9);
        }
    }

    #[test]
    fn a_rig_knows_its_size() {
        let mut bundle = arc(4, 30, RadialDistortion::default());
        let truth = bundle.clone();
        bundle.sensors.push(Sensor {
            sensor_from_camera: RigidTransform::translation(-0.4, 0.0, 0.0),
            intrinsics: Intrinsics::centered(800.0, 640, 480).unwrap(),
        });
        bundle.sensor_of_observation = vec![0; bundle.observations.len()];
        for index in 0..bundle.observations.len() {
            let copy = Observation {
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
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < 1e-15, "{report:?}");
        for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
            let error = (got.center_in_world() - want.center_in_world()).norm();
            assert!(error < 1e-7, "{error}");
        }
        bundle.sensor_of_observation[0] = 2;
        assert!(adjust_bundle(&mut bundle, &options, &mut go_on).is_err());
    }

    #[test]
    fn two_cameras_fix_the_gauge_and_the_truth_is_found() {
        let mut bundle = arc(5, 50, RadialDistortion::default());
        let truth = bundle.clone();
        disturb(&mut bundle, 0.02);
        // Give the far camera back the coordinate that holds the scale.
        bundle.cameras[4] = truth.cameras[4];
        let options = BundleOptions {
            lm: exact(),
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
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
        let distortion = RadialDistortion {
            k1: -0.08,
            k2: 0.02,
        };
        let mut bundle = arc(6, 80, distortion);
        bundle.distortion = RadialDistortion::default();
        for camera in &mut bundle.cameras {
            camera.intrinsics = Intrinsics::centered(830.0, 640, 480).unwrap();
        }
        disturb(&mut bundle, 0.01);
        let options = BundleOptions {
            lm: exact(),
            refine_focal: true,
            refine_distortion: true,
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < 1e-12, "{report:?}");
        assert!((bundle.cameras[3].intrinsics.fu_px() - 800.0).abs() < 1e-4);
        assert!((bundle.distortion.k1 + 0.08).abs() < 1e-6);
        assert!((bundle.distortion.k2 - 0.02).abs() < 1e-5);
    }

    #[test]
    fn held_cameras_and_points_stay() {
        let mut bundle = arc(4, 20, RadialDistortion::default());
        disturb(&mut bundle, 0.01);
        let before = bundle.clone();
        let options = BundleOptions {
            held_cameras: vec![false, true, true],
            held_points: vec![true, true],
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < report.initial_cost);
        assert_eq!(bundle.cameras[1], before.cameras[1]);
        assert_eq!(bundle.cameras[2], before.cameras[2]);
        assert_ne!(bundle.cameras[0], before.cameras[0]);
        assert_eq!(bundle.points[..2], before.points[..2]);
    }

    #[test]
    fn canceling_leaves_the_best_so_far() {
        let mut bundle = arc(4, 20, RadialDistortion::default());
        disturb(&mut bundle, 0.02);
        let mut stop = |i: &Iteration| {
            if i.index == 1 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let report = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut stop).unwrap();
        assert_eq!(report.termination, Termination::Canceled);
        let sum: f64 = (0..bundle.observations.len())
            .map(|o| 0.5 * bundle.residual_px(o).norm_squared())
            .sum();
        assert!((sum - report.final_cost).abs() <= 1e-9 * sum);
        assert!(report.final_cost < report.initial_cost);
    }

    #[test]
    fn bad_observations_are_refused() {
        let good = arc(2, 8, RadialDistortion::default());
        let options = BundleOptions::default();
        let mut none = good.clone();
        none.observations.clear();
        assert!(matches!(
            adjust_bundle(&mut none, &options, &mut go_on),
            Err(Error::TooFew { .. })
        ));
        let mut beyond = good.clone();
        beyond.observations[3].point = 8;
        assert!(matches!(
            adjust_bundle(&mut beyond, &options, &mut go_on),
            Err(Error::OutOfRange { value: 8.0, .. })
        ));
        let mut nan = good.clone();
        nan.observations[3].pixel.x = f64::NAN;
        assert!(matches!(
            adjust_bundle(&mut nan, &options, &mut go_on),
            Err(Error::NotFinite { .. })
        ));
    }
}
