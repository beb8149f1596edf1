//! Bundle adjustment.

use super::gauge;
use super::lens_state::{self, OF_ANY, OF_BROWN};
use super::observation::observation_pairs;
use super::options::BundleOptions;
use super::problem::{Problem, State};
use super::scene::Bundle;
use crate::camera::{Lens, LensKind, RigidTransform};
use crate::optim::{LmReport, SchurSystem, minimize};
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};
use nalgebra::Translation3;

/// Refines cameras, points and the lens parameters that [`BundleOptions`] selects, in place:
/// minimizes `½ Σ ρ(‖predicted − observed‖²)`, in square pixels, plus the squared differences from
/// known positions, in standard deviations. If known positions are far from the cameras, align the
/// bundle first, by [`align_points`](crate::sfm::align_points).
///
/// * `monitor`: notified before the first step and after each, in the only stage,
///   [`Stage::BundleAdjustment`]
///
/// Cameras and points without observations do not move.
///
/// # Errors
/// [`Error::TooFew`] without observations, [`Error::OutOfRange`] if an observation refers to a
/// missing camera or point, for a lens number beyond the number of cameras and sensors, a standard
/// deviation that is not positive, or a loss that
/// [`RobustLoss::check`](crate::optim::RobustLoss::check) rejects, [`Error::Degenerate`] if cameras
/// with the same lens number have different lenses, [`Error::NotFinite`] if a pixel, a lens
/// coefficient, a known position or the initial cost is not finite, [`Error::Canceled`]; the bundle
/// is then the best found so far.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis"; §9 for the gauge by two
/// cameras.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::sfm::{Bundle, BundleObservation, BundleOptions, PositionPrior, adjust_bundle};
/// use nalgebra::{Point3, Vector3};
/// // Three cameras look along z; each has its own lens.
/// let mut bundle = Bundle { lens_of_camera: vec![0, 1, 2], ..Bundle::default() };
/// for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
///     bundle.cameras.push(PosedCamera {
///         camera: Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480),
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
/// // GPS measures all three half a meter further along x.
/// let known = |camera: &PosedCamera| {
///     let center_in_world = camera.center_in_world() + 0.5 * Vector3::x();
///     Some(PositionPrior { center_in_world, sigma: Vector3::repeat(0.02) })
/// };
/// let options = BundleOptions::default()
///     .with_position_priors(bundle.cameras.iter().map(known).collect());
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
    let num_lenses = bundle.num_lenses();
    if num_lenses > bundle.cameras.len() + bundle.sensors.len() {
        return Err(Error::OutOfRange {
            what: "the number of a lens",
            requirement: "less than the number of cameras and sensors",
            value: (num_lenses - 1) as f64,
        });
    }
    let lenses = bundle.lenses()?;
    // Capacity for more coefficients costs time, so only rational lenses get it.
    match (lenses.iter()).any(|lens| lens.kind() == LensKind::Rational) {
        true => adjust::<OF_ANY>(bundle, pairs, &lenses, options, monitor),
        false => adjust::<OF_BROWN>(bundle, pairs, &lenses, options, monitor),
    }
}

/// * `S`: capacity for the refined parameters of a lens
fn adjust<const S: usize>(
    bundle: &mut Bundle,
    pairs: Vec<(u32, u32)>,
    lenses: &[Lens],
    options: &BundleOptions,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    let mut state = State::new(bundle, lenses);
    let problem = Problem::<S> {
        bundle,
        pairs,
        options,
        held_cameras: gauge::held_freedoms(bundle, options),
        refined: lens_state::refined(lenses, options),
    };
    let mut system = SchurSystem::new(&problem);
    let mut step = Part::new(monitor, 0.0, 1.0).of_stage(Stage::BundleAdjustment);
    let report = minimize(&mut system, &mut state, &options.lm, &mut step);
    if !matches!(report, Ok(_) | Err(Error::Canceled)) {
        return report;
    }
    // A failed adjustment leaves the bundle unchanged.
    let (mut cameras, mut sensors) = (bundle.cameras.clone(), bundle.sensors.clone());
    for (index, (camera, new)) in cameras.iter_mut().zip(&state.cameras).enumerate() {
        camera.cam_from_world =
            RigidTransform::from_parts(Translation3::from(new.translation), new.rotation);
        camera.camera = state.lenses[bundle.lens_of(index)].refined(&camera.camera)?;
    }
    for sensor in &mut sensors {
        sensor.camera = state.lenses[sensor.lens].refined(&sensor.camera)?;
    }
    (bundle.cameras, bundle.sensors) = (cameras, sensors);
    bundle.points = state.points;
    report
}
