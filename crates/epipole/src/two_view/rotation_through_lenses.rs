//! Rotations of cameras with any lens.

use super::TwoViewOptions;
use super::explaining_rotation::ExplainingRotation;
use super::rotation::align_rays;
use crate::camera::Observation;
use nalgebra::{Matrix3, Vector3};

/// Number of concentration steps on the better-fitting half of the matches.
const ROUNDS: usize = 10;

/// Body of [`find_explaining_rotation`](super::find_explaining_rotation) for cameras with any lens;
/// errors are in image 2.
///
/// * `inliers`: observations of both cameras, with few outliers
///
/// Source: Rousseeuw & Van Driessen 2006, "Computing LTS regression for large data sets"
/// (concentration steps).
pub(super) fn find_rotation_through_lenses(
    inliers: &[[Observation; 2]],
    options: &TwoViewOptions,
) -> Option<ExplainingRotation> {
    // A rotation always fits two matches.
    if inliers.len() < 3 {
        return None;
    }
    let rays: Vec<[Vector3<f64>; 2]> = inliers.iter().map(|pair| pair.map(|s| s.ray())).collect();
    let mut order: Vec<usize> = (0..rays.len()).collect();
    let half = rays.len().div_ceil(2).max(3);
    let mut num_used = rays.len();
    let mut errors_sq = vec![0.0; rays.len()];
    let mut best = Matrix3::identity();
    for _ in 0..ROUNDS {
        let rotation = align_rays(order[..num_used].iter().map(|&i| &rays[i]))?;
        for ((error_sq, [_, observation2]), [ray1, _]) in
            errors_sq.iter_mut().zip(inliers).zip(&rays)
        {
            *error_sq = observation2.error_sq(&(rotation * ray1));
        }
        order.sort_by(|&a, &b| errors_sq[a].total_cmp(&errors_sq[b]).then(a.cmp(&b)));
        num_used = half;
        best = rotation;
    }
    let reach_px = options.in_two_dimensions().max_error_px;
    let num_explained = (errors_sq.iter())
        .filter(|e| **e < reach_px * reach_px)
        .count();
    ExplainingRotation::if_nearly_all(&best, num_explained, rays.len(), options)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
    use crate::math::random::Random;
    use nalgebra::{Point3, Vector2};

    #[test]
    fn a_rotation_is_distinguished_from_a_step() {
        let camera = Camera {
            intrinsics: Intrinsics::centered(250.0, 800, 800).unwrap(),
            lens: Lens::Fisheye(Fisheye::default()),
            width: 800,
            height: 800,
        };
        for (step, expected) in [(0.0, true), (0.3, false)] {
            let mut random = Random::new(8);
            let rotation_vector = Vector3::new(0.1, 0.4, 0.2);
            let motion = RigidTransform::new(Vector3::new(step, 0.0, 0.0), rotation_vector);
            let mut observe = |x: Point3<f64>| {
                let noise = Vector2::from_fn(|_, _| 0.5 * random.normal());
                camera
                    .observe(&(camera.project(&x).unwrap() + noise))
                    .unwrap()
            };
            let mut pairs = Vec::new();
            let mut places = Random::new(9);
            for n in 0..200 {
                let x = 3.0 * Vector3::from_fn(|_, _| places.normal()) + 2.0 * Vector3::z();
                let x = Point3::from(x);
                // Every tenth is wrong.
                let other = match n % 10 {
                    0 => Point3::new(x.y, x.x, x.z),
                    _ => motion * x,
                };
                pairs.push([observe(x), observe(other)]);
            }
            let found = find_rotation_through_lenses(&pairs, &TwoViewOptions::default());
            assert_eq!(found.is_some(), expected);
            if let Some(found) = found {
                let off = found.cam2_from_cam1.rotation.angle_to(&motion.rotation);
                assert!(off < 1e-3, "{off}");
            }
        }
        assert!(find_rotation_through_lenses(&[], &TwoViewOptions::default()).is_none());
    }
}
