//! Gauge: degrees of freedom of the cameras that are held fixed.

use super::options::{BundleOptions, Gauge};
use super::scene::Bundle;

/// Returns the held degrees of freedom of each camera.
pub(super) fn held_freedoms(bundle: &Bundle, options: &BundleOptions) -> Vec<[bool; 6]> {
    let is_held = |i: usize| options.held_cameras.get(i).copied().unwrap_or(false);
    let mut held: Vec<[bool; 6]> = (0..bundle.cameras.len()).map(|i| [is_held(i); 6]).collect();
    let num_held = held.iter().filter(|h| h[0]).count();
    let point_held = options.held_points.iter().any(|&h| h);
    // Known positions fix the world; damping handles the rest.
    let known = options.position_priors.iter().any(Option::is_some);
    if options.gauge == Gauge::Free || num_held >= 2 || point_held || known {
        return held;
    }
    let mut has_observation = vec![false; bundle.cameras.len()];
    for o in &bundle.observations {
        has_observation[o.camera] = true;
    }
    let Some(anchor) = (0..held.len())
        .find(|&i| held[i][0])
        .or_else(|| (0..held.len()).find(|&i| has_observation[i]))
    else {
        return held;
    };
    held[anchor] = [true; 6];
    let origin = bundle.cameras[anchor].center_in_world();
    let mut farthest = (0.0, None);
    for (i, camera) in bundle.cameras.iter().enumerate() {
        let distance = (camera.center_in_world() - origin).norm();
        if i != anchor && has_observation[i] && distance > farthest.0 {
            farthest = (distance, Some(i));
        }
    }
    // A rig fixes the scale; a single camera leaves it open.
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
