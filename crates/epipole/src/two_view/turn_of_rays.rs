//! Whether a camera with any lens only turned.

use super::TwoViewOptions;
use super::rotation::align_rays;
use crate::camera::SeenRay;
use nalgebra::Vector3;

/// How often the turn is found again from the half of the matches that fits it best.
const ROUNDS: usize = 10;

/// Whether a turn explains nearly all matches, as [`find_explaining_turn`](super::find_explaining_turn) says of
/// pinhole cameras. These are the inliers of a motion, so few of them are wrong.
///
/// Source: Rousseeuw & Van Driessen 2006, "Computing LTS regression for large data sets" (concentration steps).
pub(crate) fn only_turned(inliers: &[[SeenRay; 2]], options: &TwoViewOptions) -> bool {
    // Two matches fit a turn always.
    if inliers.len() < 3 {
        return false;
    }
    let rays: Vec<[Vector3<f64>; 2]> = inliers.iter().map(|pair| pair.map(|s| s.ray())).collect();
    let mut order: Vec<usize> = (0..rays.len()).collect();
    let half = rays.len().div_ceil(2).max(3);
    let mut num_used = rays.len();
    let mut errors_sq = vec![0.0; rays.len()];
    for _ in 0..ROUNDS {
        let Some(rotation) = align_rays(order[..num_used].iter().map(|&i| &rays[i])) else {
            return false;
        };
        for ((error_sq, [_, seen2]), [ray1, _]) in errors_sq.iter_mut().zip(inliers).zip(&rays) {
            *error_sq = seen2.error_sq(&(rotation * ray1));
        }
        order.sort_by(|&a, &b| errors_sq[a].total_cmp(&errors_sq[b]).then(a.cmp(&b)));
        num_used = half;
    }
    // In the second image alone the error has both images' noise.
    let reach_px = core::f64::consts::SQRT_2 * options.reach_in_two_dimensions_px();
    let explained = errors_sq
        .iter()
        .filter(|e| **e < reach_px * reach_px)
        .count();
    explained as f64 >= options.max_homography_share * rays.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::CalibratedCamera;
    use crate::camera::{Fisheye, Intrinsics, Lens, RigidTransform};
    use crate::math::random::Random;
    use nalgebra::{Point3, Vector2};

    #[test]
    fn a_turn_is_told_from_a_step() {
        let camera = CalibratedCamera {
            intrinsics: Intrinsics::centered(250.0, 800, 800).unwrap(),
            lens: Lens::Fisheye(Fisheye::default()),
            width: 800,
            height: 800,
        };
        for (step, expected) in [(0.0, true), (0.3, false)] {
            let mut random = Random::new(8);
            let turn = Vector3::new(0.1, 0.4, 0.2);
            let motion = RigidTransform::new(Vector3::new(step, 0.0, 0.0), turn);
            let mut see = |x: Point3<f64>| {
                let noise = Vector2::from_fn(|_, _| 0.5 * random.normal());
                camera
                    .seen_ray(&(camera.project(&x).unwrap() + noise))
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
                pairs.push([see(x), see(other)]);
            }
            assert_eq!(only_turned(&pairs, &TwoViewOptions::default()), expected);
        }
        assert!(!only_turned(&[], &TwoViewOptions::default()));
    }
}
