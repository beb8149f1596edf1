use super::super::tree::largest_tree;
use super::*;
use crate::math::random::Random;
use nalgebra::Rotation3;

const SIZE: (f64, f64) = (640.0, 480.0);

/// Rotations of cameras in two rows around the horizon, and matches of all that overlap.
fn world(focal_px: f64, noise_px: f64) -> (Vec<Matrix3<f64>>, Vec<Overlap>) {
    let mut random = Random::new(7);
    let k = Intrinsics::centered(focal_px, 640, 480).unwrap();
    let rotations: Vec<Matrix3<f64>> = (0..6)
        .map(|n| {
            let yaw = 0.35 * f64::from(n % 3);
            let pitch = 0.3 * f64::from(n / 3);
            let roll = 0.02 * f64::from(n);
            let rotate = |axis: Vector3<f64>| Rotation3::from_scaled_axis(axis);
            let rotate = rotate(Vector3::z() * roll)
                * rotate(Vector3::x() * pitch)
                * rotate(Vector3::y() * -yaw);
            rotate.into_inner()
        })
        .collect();
    let project = |rotation: &Matrix3<f64>, x: &Vector3<f64>| -> Option<Point2<f64>> {
        let p = k.project(&(rotation * x).into()).ok()?;
        let inside = p.x > 0.0 && p.y > 0.0 && p.x < SIZE.0 && p.y < SIZE.1;
        inside.then_some(p)
    };
    let mut overlaps = Vec::new();
    for a in 0..6 {
        for b in 0..a {
            let mut pixels = [Vec::new(), Vec::new()];
            for _ in 0..4000 {
                let x = Vector3::from_fn(|_, _| random.normal());
                if let (Some(p), Some(q)) = (project(&rotations[a], &x), project(&rotations[b], &x))
                {
                    for (list, p) in pixels.iter_mut().zip([p, q]) {
                        let noise = [random.normal(), random.normal()].map(|x| noise_px * x);
                        list.push(Point2::new(p.x + noise[0], p.y + noise[1]));
                    }
                }
            }
            if pixels[0].len() >= 12 {
                overlaps.push(Overlap {
                    images: [a, b],
                    num_matches: pixels[0].len(),
                    pixels,
                    homography: Matrix3::identity(),
                    has_parallax: false,
                });
            }
        }
    }
    (rotations, overlaps)
}

/// Largest angle between a rotation and the truth, relative to the root, radians.
fn off(found: &[Option<Matrix3<f64>>], truth: &[Matrix3<f64>], root: usize) -> f64 {
    let of_root = truth[root].transpose();
    (found.iter().zip(truth))
        .map(|(found, truth)| {
            let rest = found.unwrap().transpose() * truth * of_root;
            Rotation3::from_matrix_unchecked(rest).angle()
        })
        .fold(0.0, f64::max)
}

#[test]
fn rotations_and_focal_length_are_found_from_a_wrong_guess() {
    for (noise_px, angle, focal) in [(0.0, 1e-7, 1e-5), (0.5, 2e-3, 2.0)] {
        let (truth, overlaps) = world(560.0, noise_px);
        assert!(overlaps.len() > 6);
        let tree = largest_tree(6, &overlaps).unwrap();
        let guess = vec![Intrinsics::centered(768.0, 640, 480).unwrap(); 6];
        let (found, factor) = estimate_rotations(&guess, &overlaps, &tree, true, &mut ()).unwrap();
        let off = off(&found, &truth, tree.root);
        assert!(off < angle, "{noise_px}: {off}");
        assert!(
            (factor.unwrap() * 768.0 - 560.0).abs() < focal,
            "{factor:?}"
        );
    }
}

#[test]
fn a_known_focal_length_is_unchanged() {
    let (truth, overlaps) = world(560.0, 0.0);
    let tree = largest_tree(6, &overlaps).unwrap();
    let known = vec![Intrinsics::centered(560.0, 640, 480).unwrap(); 6];
    let (found, factor) = estimate_rotations(&known, &overlaps, &tree, false, &mut ()).unwrap();
    assert!(factor.is_none());
    assert!(off(&found, &truth, tree.root) < 1e-7);
}
