//! Sensitivity of the cost of a bundle to its focal lengths.

use super::gauge;
use super::lens_state::{self, OF_ANY, OF_BROWN};
use super::observation::observation_pairs;
use super::options::BundleOptions;
use super::problem::{Problem, State};
use super::scene::Bundle;
use crate::Result;
use crate::camera::{Lens, LensKind};
use crate::optim::{RobustLoss, SchurSystem, System};

/// Relative change of a focal length to judge: at this error a model is visibly bent.
const CHANGE: f64 = 0.2;

/// Returns the relative increase of the cost when each lens changes its focal length by [`CHANGE`]
/// and all cameras and points adapt, by the quadratic model around a refined bundle. 0 where the
/// normal equations are singular.
///
/// # Errors
/// As [`adjust_bundle`](super::adjust_bundle).
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis", §6.1.
pub(in crate::sfm) fn focal_sensitivity(bundle: &Bundle, loss: RobustLoss) -> Result<Vec<f64>> {
    let lenses = bundle.lenses()?;
    match (lenses.iter()).any(|lens| lens.kind() == LensKind::Rational) {
        true => sensitivity::<OF_ANY>(bundle, &lenses, loss),
        false => sensitivity::<OF_BROWN>(bundle, &lenses, loss),
    }
}

/// * `S`: maximum number of refined parameters of a lens
fn sensitivity<const S: usize>(
    bundle: &Bundle,
    lenses: &[Lens],
    loss: RobustLoss,
) -> Result<Vec<f64>> {
    let options = BundleOptions {
        loss,
        refine_focal: true,
        ..BundleOptions::default()
    };
    let problem = Problem::<S> {
        pairs: observation_pairs(
            &bundle.observations,
            bundle.cameras.len(),
            bundle.points.len(),
        )?,
        bundle,
        options: &options,
        held_cameras: gauge::held_freedoms(bundle, &options),
        refined: lens_state::refined(lenses, &options),
    };
    let mut system = SchurSystem::new(&problem);
    let cost = system.linearize(&State::new(bundle, lenses)).cost;
    if system.solve(0.0).is_none() {
        return Ok(vec![0.0; lenses.len()]);
    }
    let variances = system.shared_variances();
    // The focal factor is the first parameter of each lens, and the only one refined here.
    Ok((variances.iter())
        .map(|variance| 0.5 * CHANGE * CHANGE / (variance * cost.max(f64::MIN_POSITIVE)))
        .collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
    use crate::math::random::Random;
    use crate::sfm::bundle::{BundleObservation, adjust_bundle};
    use nalgebra::{Point3, Vector3};

    /// Twelve cameras that move straight ahead, each rotated by `yaw_rad` from the one before,
    /// refined from pixels with 0.3 px noise.
    fn drive(yaw_rad: f64, focal_px: f64) -> Bundle {
        let mut random = Random::new(7);
        let with = |focal_px| {
            let k = Intrinsics::centered(focal_px, 1000, 600).unwrap();
            Camera::pinhole(k, 1000, 600)
        };
        let mut bundle = Bundle::default();
        for _ in 0..400 {
            let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            let place = [side * random.uniform(3.0, 9.0), 0.0, 0.0].map(|x| x + random.normal());
            bundle
                .points
                .push(Point3::new(place[0], place[1], random.uniform(4.0, 30.0)));
        }
        for n in 0..12 {
            let rotation =
                RigidTransform::new(Vector3::zeros(), Vector3::y() * (yaw_rad * f64::from(n)));
            let ahead = RigidTransform::translation(0.0, 0.0, -0.6 * f64::from(n));
            let cam_from_world = rotation * ahead;
            let camera = bundle.cameras.len();
            let posed = PosedCamera {
                camera: with(700.0),
                cam_from_world,
            };
            for (point, place) in bundle.points.iter().enumerate() {
                let depth = (cam_from_world * place).z;
                let Ok(pixel) = posed.project(place) else {
                    continue;
                };
                let noise = Vector3::from_fn(|_, _| 0.3 * random.normal()).xy();
                if depth > 1.0
                    && (0.0..1000.0).contains(&pixel.x)
                    && (0.0..600.0).contains(&pixel.y)
                {
                    bundle.observations.push(BundleObservation {
                        camera,
                        point,
                        pixel: pixel + noise,
                    });
                }
            }
            bundle.cameras.push(PosedCamera {
                camera: with(focal_px),
                cam_from_world,
            });
        }
        adjust_bundle(
            &mut bundle,
            &BundleOptions::default().with_refine_focal(true),
            &mut (),
        )
        .unwrap();
        bundle
    }

    #[test]
    fn a_refined_bundle_with_another_focal_length_costs_as_much_more_as_predicted() {
        let found = drive(0.02, 700.0);
        let cost = |factor: f64| {
            let mut bundle = found.clone();
            for camera in &mut bundle.cameras {
                let k = camera.camera.intrinsics;
                let center = k.principal_point();
                let [fu_px, fv_px] = [k.fu_px() * factor, k.fv_px() * factor];
                camera.camera.intrinsics =
                    Intrinsics::new(fu_px, fv_px, center.x, center.y).unwrap();
            }
            let report = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut ()).unwrap();
            report.final_cost
        };
        // Both directions, so that the cubic term cancels; a small step, since the model is
        // quadratic.
        let rise = (cost(1.02) + cost(0.98)) / (2.0 * cost(1.0)) - 1.0;
        let predicted = focal_sensitivity(&found, RobustLoss::Trivial).unwrap()[0]
            * (0.02 / CHANGE)
            * (0.02 / CHANGE);
        assert!((predicted / rise - 1.0).abs() < 0.05, "{predicted} {rise}");
    }

    #[test]
    fn a_straight_drive_does_not_determine_the_focal_length() {
        let sensitivity =
            |yaw_rad| focal_sensitivity(&drive(yaw_rad, 1200.0), RobustLoss::Trivial).unwrap()[0];
        let (straight, curved) = (sensitivity(0.0), sensitivity(0.05));
        assert!(straight < 1e-3, "{straight}");
        assert!(curved > 0.1, "{curved}");
    }
}
