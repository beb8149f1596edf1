//! Bundle adjustment of cameras with their lenses.

mod gauge;
mod lens_state;
#[cfg(test)]
mod lens_tests;
mod options;
mod problem;
#[cfg(test)]
mod tests;

use crate::camera::{Intrinsics, Lens, LensKind, PosedCamera, RigidTransform};
use crate::optim::{LmReport, SchurSystem, minimize};
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};
use lens_state::{OF_ANY, OF_BROWN};
use nalgebra::{Point2, Point3, Translation3, Vector2};
use problem::{Problem, State};

pub(super) use crate::camera::moving_pose::{PoseState, move_points, sum_of_squares};
pub use options::{BundleOptions, Gauge, PositionPrior};

/// A camera saw a point at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BundleObservation {
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
    /// Its lens, as in [`Bundle::lens_of_camera`].
    pub lens: usize,
}

/// Cameras, points and observations.
///
/// Cameras of one lens share what is refined of it: a factor for their focal lengths, a shift of their principal
/// points, and its coefficients. One lens for all is the default; as many lenses as cameras give each its own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bundle {
    /// The cameras.
    pub cameras: Vec<PosedCamera>,
    /// What each lens does to rays; missing entries bend nothing.
    pub lenses: Vec<Lens>,
    /// The lens of each camera; missing entries are 0.
    pub lens_of_camera: Vec<usize>,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// What was seen where.
    pub observations: Vec<BundleObservation>,
    /// Further cameras bolted to each camera.
    pub sensors: Vec<Sensor>,
    /// For each observation, 0 if the camera itself made it, k if sensor k − 1 did; missing
    /// entries are 0.
    pub sensor_of_observation: Vec<usize>,
}

impl Bundle {
    /// How an observation was made: by the camera itself, or by a sensor.
    fn eye(&self, observation: usize) -> Eye<'_> {
        let sensor = match self.sensor_of_observation.get(observation) {
            Some(&k) if k > 0 => self.sensors.get(k - 1),
            _ => None,
        };
        let camera = self.observations[observation].camera;
        match sensor {
            Some(sensor) => Eye {
                intrinsics: &sensor.intrinsics,
                lens: sensor.lens,
                sensor_from_camera: Some(&sensor.sensor_from_camera),
            },
            None => Eye {
                intrinsics: &self.cameras[camera].intrinsics,
                lens: self.lens_of_camera.get(camera).copied().unwrap_or(0),
                sensor_from_camera: None,
            },
        }
    }

    /// The number of lenses, as far as cameras and sensors have them.
    fn num_lenses(&self) -> usize {
        let of_cameras = self.lens_of_camera.iter().take(self.cameras.len());
        let used = of_cameras.chain(self.sensors.iter().map(|sensor| &sensor.lens));
        used.max().map_or(1, |last| last.saturating_add(1))
    }

    /// Predicted minus observed pixel of an observation, given by its index; not finite if the lens does not see the
    /// point, or it is in the camera's center plane. Points behind the camera are mirrored through its
    /// center, as in [`adjust_bundle`], except by a fisheye, which may see them.
    pub fn residual_px(&self, observation: usize) -> Vector2<f64> {
        let o = &self.observations[observation];
        let eye = self.eye(observation);
        let mut p = self.cameras[o.camera].cam_from_world * self.points[o.point];
        if let Some(sensor_from_camera) = eye.sensor_from_camera {
            p = sensor_from_camera * p;
        }
        let lens = self.lenses.get(eye.lens).copied().unwrap_or_default();
        let shown = lens.project_or_mirror(&p.coords);
        let center = eye.intrinsics.principal_point();
        Vector2::new(
            eye.intrinsics.fu_px() * shown.x + center.x - o.pixel.x,
            eye.intrinsics.fv_px() * shown.y + center.y - o.pixel.y,
        )
    }
}

/// What made an observation.
struct Eye<'a> {
    intrinsics: &'a Intrinsics,
    lens: usize,
    /// `None` for the camera itself.
    sensor_from_camera: Option<&'a RigidTransform>,
}

/// Checks that observations refer to existing cameras and points and are finite.
pub(super) fn observation_pairs(
    observations: &[BundleObservation],
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

/// Refines cameras, points and, if wanted, what [`BundleOptions`] names of their lenses, in place:
/// minimizes `½ Σ ρ(‖predicted − observed‖²)`, in square pixels, and what is known of positions beside it, each
/// difference in its standard deviations: a pixel weighs as much as one of them. Positions that are far from where the
/// cameras are want [`align_points`](super::align_points) first.
///
/// * `monitor`: hears before the first step and after each one, in the one stage [`Stage::BundleAdjustment`]
///
/// Cameras and points without observations stay where they are.
///
/// # Errors
/// [`Error::TooFew`] without observations, [`Error::OutOfRange`] if an observation refers to a
/// camera or point that is not there, for a lens beyond the number of cameras and sensors, a standard deviation that is not positive, or
/// for a loss that [`RobustLoss::check`](crate::optim::RobustLoss::check) refuses,
/// [`Error::NotFinite`] if a pixel, a coefficient of a lens, a known position or the cost at the start is not finite,
/// [`Error::Canceled`]; the bundle is then the best found so far.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis"; the gauge by two cameras
/// is its §9.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{PosedCamera, Intrinsics, RigidTransform};
/// use epipole::sfm::{Bundle, BundleObservation, BundleOptions, PositionPrior, adjust_bundle};
/// use nalgebra::{Point3, Vector3};
/// // Three cameras look along z; each has a lens of its own.
/// let mut bundle = Bundle { lens_of_camera: vec![0, 1, 2], ..Bundle::default() };
/// for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
///     bundle.cameras.push(PosedCamera {
///         intrinsics: Intrinsics::centered(500.0, 640, 480)?,
///         cam_from_world: RigidTransform::translation(-x, -y, 0.0),
///     });
/// }
/// for n in 0..12 {
///     let [x, y] = [f64::from(n % 4) - 1.5, f64::from(n / 4) - 1.0];
///     bundle.points.push(Point3::new(x, y, 4.0 + 0.7 * f64::from(n % 3)));
/// }
/// for (point, place) in bundle.points.iter().enumerate() {
///     for (camera, model) in bundle.cameras.iter().enumerate() {
///         bundle.observations.push(BundleObservation { camera, point, pixel: model.project(place)? });
///     }
/// }
/// // A receiver says that all three stand half a meter further along x.
/// let known = |camera: &PosedCamera| {
///     let center_in_world = camera.center_in_world() + 0.5 * Vector3::x();
///     Some(PositionPrior { center_in_world, sigma: Vector3::repeat(0.02) })
/// };
/// let options = BundleOptions {
///     position_priors: bundle.cameras.iter().map(known).collect(),
///     ..BundleOptions::default()
/// };
/// adjust_bundle(&mut bundle, &options, &mut ())?;
/// let moved = bundle.cameras[1].center_in_world();
/// assert!((moved - Point3::new(1.5, 0.0, 0.0)).norm() < 1e-3, "{moved}");
/// # Ok(()) }
/// ```
pub fn adjust_bundle(
    bundle: &mut Bundle,
    options: &BundleOptions,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    options.check()?;
    let pairs = observation_pairs(
        &bundle.observations,
        bundle.cameras.len(),
        bundle.points.len(),
    )?;
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
    bundle.lenses.iter().try_for_each(Lens::check)?;
    let num_lenses = bundle.num_lenses();
    if num_lenses > bundle.cameras.len() + bundle.sensors.len() {
        return Err(Error::OutOfRange {
            what: "the number of a lens",
            requirement: "less than the number of cameras and sensors",
            value: (num_lenses - 1) as f64,
        });
    }
    // Room for more coefficients costs time, so it is taken only where some lens has more.
    match (bundle.lenses.iter()).any(|lens| lens.kind() == LensKind::Rational) {
        true => adjust::<OF_ANY>(bundle, pairs, options, monitor),
        false => adjust::<OF_BROWN>(bundle, pairs, options, monitor),
    }
}

/// * `S`: room for what is refined of a lens
fn adjust<const S: usize>(
    bundle: &mut Bundle,
    pairs: Vec<(u32, u32)>,
    options: &BundleOptions,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    let num_lenses = bundle.num_lenses();
    let mut state = State::new(bundle);
    let problem = Problem::<S> {
        bundle,
        pairs,
        options,
        held_cameras: gauge::held_freedoms(bundle, options),
        refined: lens_state::refined(bundle, options),
    };
    let mut system = SchurSystem::new(&problem);
    let mut step = Part::new(monitor, 0.0, 1.0).of_stage(Stage::BundleAdjustment);
    let report = minimize(&mut system, &mut state, &options.lm, &mut step);
    if !matches!(report, Ok(_) | Err(Error::Canceled)) {
        return report;
    }
    // Either all of it is taken over, or nothing.
    let (mut cameras, mut sensors) = (bundle.cameras.clone(), bundle.sensors.clone());
    for (index, (camera, new)) in cameras.iter_mut().zip(&state.cameras).enumerate() {
        camera.cam_from_world =
            RigidTransform::from_parts(Translation3::from(new.translation), new.rotation);
        let lens = bundle.lens_of_camera.get(index).copied().unwrap_or(0);
        camera.intrinsics = state.lenses[lens].refined(&camera.intrinsics)?;
    }
    for sensor in &mut sensors {
        sensor.intrinsics = state.lenses[sensor.lens].refined(&sensor.intrinsics)?;
    }
    (bundle.cameras, bundle.sensors) = (cameras, sensors);
    bundle.points = state.points;
    if options.refines_lens() {
        let num_known = bundle.lenses.len().max(num_lenses);
        bundle.lenses.resize(num_known, Lens::NONE);
        for (lens, refined) in bundle.lenses.iter_mut().zip(&state.lenses) {
            *lens = refined.lens;
        }
    }
    report
}
