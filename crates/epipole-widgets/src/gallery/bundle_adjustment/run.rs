//! The computation behind `bundle-adjustment`: the core's own loop, and where it was after each of
//! its steps.

use super::answer::{Place, Request, Stand, Step, Wire};
use super::scene::{MARK, SHOWN, Scene, WIDTH};
use crate::contract::{Problem, Progress};
use epipole::Error;
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use epipole::optim::{Iteration, LmOptions, LmReport, RobustLoss};
use epipole::sfm::{
    AlignmentKind, Bundle, BundleOptions, Observation, adjust_bundle, align_points,
};
use nalgebra::{Point2, Point3, Translation3, UnitQuaternion, Vector2, Vector3};
use std::ops::ControlFlow;

/// More steps than this show nothing new.
pub(super) const MAX_STEPS: usize = 24;
/// Converged when a step lowers the cost by less than this share.
const COST_TOLERANCE: f64 = 1e-5;
/// Of Huber's loss, pixels.
const HUBER_PX: f64 = 2.0;
/// How far a disturbance of 1, the width of the house, turns a camera, radians.
const TURN_RAD: f64 = 0.5;

/// Carries out the computation.
///
/// # Errors
/// A sentence, or that the work was ended.
pub(super) fn compute(bytes: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, Problem> {
    let unreadable = |_| Error::Degenerate {
        what: "a bundle adjustment",
        why: "the request cannot be read",
    };
    let request: Request = postcard::from_bytes(bytes).map_err(unreadable)?;
    let wire = follow(&request, progress)?;
    Ok(postcard::to_allocvec(&wire).unwrap_or_default())
}

fn follow(request: &Request, progress: Progress<'_>) -> Result<Wire, Error> {
    let scene = Scene::new()?;
    let start = disturbed(&scene, request);
    let mut iterations = Vec::new();
    let mut bundle = start.clone();
    let report = adjust(&mut bundle, request, &mut |iteration| {
        iterations.push(*iteration);
        ControlFlow::Continue(())
    })?;
    let mut steps: Vec<Step> = Vec::new();
    for iteration in &iterations {
        let place = match steps.last() {
            // A step that was refused leaves everything where it was.
            Some(before) if !iteration.accepted => before.place.clone(),
            _ => {
                let mut bundle = start.clone();
                adjust(&mut bundle, request, &mut |now| {
                    if now.index == iteration.index {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                })?;
                aligned(&bundle, &scene)?
            }
        };
        steps.push(Step {
            cost: iteration.cost,
            damping: iteration.damping,
            accepted: iteration.accepted,
            place,
        });
        if progress(steps.len() as f64 / iterations.len() as f64).is_break() {
            return Err(Error::Canceled);
        }
    }
    let pixels = (start.observations.iter())
        .filter(|observation| observation.camera == SHOWN)
        .map(|observation| (observation.pixel.x, observation.pixel.y))
        .collect();
    Ok(Wire {
        pixels,
        num_observations: start.observations.len(),
        converged: report.termination.is_converged(),
        steps,
    })
}

fn adjust(
    bundle: &mut Bundle,
    request: &Request,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<LmReport, Error> {
    let options = BundleOptions {
        lm: LmOptions {
            max_iterations: MAX_STEPS,
            cost_tolerance: COST_TOLERANCE,
            initial_damping: libm::exp10(request.log_damping),
            ..LmOptions::default()
        },
        loss: match request.huber {
            true => RobustLoss::Huber { width: HUBER_PX },
            false => RobustLoss::Trivial,
        },
        ..BundleOptions::default()
    };
    adjust_bundle(bundle, &options, observer)
}

/// What the photographs show, with noise, beside cameras and points that are off.
fn disturbed(scene: &Scene, request: &Request) -> Bundle {
    // The features' noise must not change when the disturbance does.
    let mut noise = Random::new(1000 + request.seed);
    let mut random = Random::new(request.seed);
    let mut bundle = Bundle::default();
    for (camera, true_camera) in scene.cameras.iter().enumerate() {
        for (point, place) in scene.points.iter().enumerate() {
            let off = Vector2::new(noise.normal(), noise.normal()) * request.noise_px;
            let pixel = match true_camera.project(place) {
                _ if camera == SHOWN && point == MARK => Point2::from(request.mark),
                Ok(pixel) => pixel + off,
                // The house is in front of every camera.
                Err(_) => continue,
            };
            bundle.observations.push(Observation {
                camera,
                point,
                pixel,
            });
        }
    }
    let mut vector = || Vector3::new(random.normal(), random.normal(), random.normal());
    let length = request.disturbance * WIDTH;
    for camera in &scene.cameras {
        let turn = UnitQuaternion::from_scaled_axis(vector() * request.disturbance * TURN_RAD);
        let rotation = turn * camera.cam_from_world.rotation;
        let center = camera.center_in_world() + vector() * length;
        let translation = Translation3::from(-(rotation * center.coords));
        let mut camera = *camera;
        camera.cam_from_world = RigidTransform::from_parts(translation, rotation);
        bundle.cameras.push(camera);
    }
    for point in &scene.points {
        bundle.points.push(point + vector() * (0.7 * length));
    }
    bundle
}

/// Cameras and points in the frame of the truth: no photograph knows where the world is, how it
/// is turned and how large it is, so the similarity that fits best takes these seven away.
fn aligned(bundle: &Bundle, scene: &Scene) -> Result<Place, Error> {
    let true_from_found = align_points(&bundle.points, &scene.points, AlignmentKind::Similarity)?;
    let stand = |camera: &epipole::camera::Camera| {
        let center = true_from_found * camera.center_in_world();
        let rotation = camera.cam_from_world.rotation * true_from_found.isometry.rotation.inverse();
        Stand::new(&center, &rotation)
    };
    let point = |point: &Point3<f64>| (true_from_found * point).coords.into();
    let num_observations = bundle.observations.len();
    let squares: f64 = (0..num_observations)
        .map(|observation| bundle.residual_px(observation).norm_squared())
        .sum();
    Ok(Place {
        rms_px: (squares / num_observations.max(1) as f64).sqrt(),
        stands: bundle.cameras.iter().map(stand).collect(),
        points: bundle.points.iter().map(point).collect(),
    })
}
