//! The second pose of a plane.

use super::refine::refine_absolute_pose;
use crate::Result;
use crate::camera::{Camera, RigidTransform};
use crate::math::svd3;
use crate::optim::RobustLoss;
use nalgebra::{Matrix3, Point2, Point3, Rotation3, UnitQuaternion, Vector3};

/// Angle below which poses are equal, radians.
const SAME_RAD: f64 = 1e-3;

/// Finds the other minimum of the reprojection error of points near a plane, if any.
///
/// A small or distant plane looks nearly the same after its depths are reversed: it tilts the other
/// way. Compare the errors of both poses: if they differ only by noise, the points do not determine
/// the pose.
///
/// * `cam_from_world`: the known pose, as from [`fit_absolute_pose`](super::fit_absolute_pose)
/// * `points_in_world`, `pixels`: points and their projections
/// * `camera`: camera with any lens
///
/// Returns `None` if the reversed pose leads back to the known one, as for points in space and for
/// a plane that faces the camera.
///
/// # Errors
/// As [`refine_absolute_pose`].
///
/// Source: Schweighofer & Pinz 2006, "Robust pose estimation from a planar target"; initialized by
/// reversing depths about the centroid, as under weak perspective.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::{find_flipped_pose, fit_absolute_pose};
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// // A board of 0.2 m at a distance of 4 m, tilted by 0.4.
/// let truth = RigidTransform::new(Vector3::new(0.0, 0.0, 4.0), Vector3::new(0.4, 0.0, 0.0));
/// let points = [(0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1)].map(|(x, y)| Point3::new(x, y, 0.0));
/// let pixels = points.map(|x| camera.project(&(truth * x)).unwrap());
/// let best = fit_absolute_pose(&points, &pixels, &camera)?;
/// let other = find_flipped_pose(&best, &points, &pixels, &camera)?.unwrap();
/// // Tilted the other way, yet every pixel is within half a pixel.
/// assert!((other.rotation.scaled_axis().x + 0.4).abs() < 0.02);
/// for (x, pixel) in points.iter().zip(&pixels) {
///     assert!((camera.project(&(other * x))? - pixel).norm() < 0.5);
/// }
/// # Ok(()) }
/// ```
pub fn find_flipped_pose(
    cam_from_world: &RigidTransform,
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
) -> Result<Option<RigidTransform>> {
    let Some(start) = flipped(cam_from_world, points_in_world) else {
        return Ok(None);
    };
    let loss = RobustLoss::Trivial;
    let other = refine_absolute_pose(&start, points_in_world, pixels, camera, loss)?;
    let is_other = other.rotation.angle_to(&cam_from_world.rotation) > SAME_RAD;
    let shows_all = (points_in_world.iter()).all(|x| camera.project(&(other * x)).is_ok());
    Ok((is_other && shows_all).then_some(other))
}

/// Returns the pose after reversing depths along the ray of the centroid and mirroring the points
/// in their plane.
fn flipped(pose: &RigidTransform, points: &[Point3<f64>]) -> Option<RigidTransform> {
    let sum: Vector3<f64> = points.iter().map(|x| x.coords).sum();
    let center = Point3::from(sum / points.len() as f64);
    let spread: Matrix3<f64> = (points.iter().map(|x| x - center))
        .map(|side| side * side.transpose())
        .sum();
    let mirror = |normal: Vector3<f64>| Matrix3::identity() - 2.0 * normal * normal.transpose();
    let normal = pose.rotation * svd3(&spread).v.column(2).into_owned();
    let in_cam = pose * center;
    let ray = in_cam.coords.try_normalize(0.0)?;
    let flip = mirror(ray) * mirror(normal);
    if !flip.iter().all(|x| x.is_finite()) {
        return None;
    }
    let flip = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(flip));
    let rotation = flip * pose.rotation;
    let translation = in_cam.coords - rotation * center.coords;
    Some(RigidTransform::from_parts(translation.into(), rotation))
}

#[cfg(test)]
mod tests {
    use super::super::fit_absolute_pose;
    use super::*;
    use crate::camera::Intrinsics;
    use crate::math::random::Random;

    fn cost(pose: &RigidTransform, points: &[Point3<f64>], pixels: &[Point2<f64>]) -> f64 {
        let project = |x| camera().project(&(pose * x)).unwrap();
        (points.iter().zip(pixels))
            .map(|(x, pixel)| (project(x) - pixel).norm_squared())
            .sum()
    }

    fn camera() -> Camera {
        Camera::pinhole(
            Intrinsics::new(700.0, 710.0, 320.0, 240.0).unwrap(),
            640,
            480,
        )
    }

    #[test]
    fn either_pose_of_a_plane_leads_to_the_other() {
        let mut random = Random::new(5);
        let mut num_found = 0;
        for _ in 0..100 {
            let rotation_vector = Vector3::from_fn(|_, _| random.uniform(-0.8, 0.8));
            let truth = RigidTransform::new(Vector3::new(0.3, -0.2, 6.0), rotation_vector);
            let points: Vec<_> = (0..8)
                .map(|_| Point3::new(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.0))
                .collect();
            let pixels: Vec<_> = (points
                .iter()
                .map(|x| camera().project(&(truth * x)).unwrap()))
            .map(|p| Point2::new(p.x + 0.1 * random.normal(), p.y + 0.1 * random.normal()))
            .collect();
            let best = fit_absolute_pose(&points, &pixels, &camera()).unwrap();
            let Some(other) = find_flipped_pose(&best, &points, &pixels, &camera()).unwrap() else {
                continue;
            };
            num_found += 1;
            assert!(cost(&other, &points, &pixels) >= cost(&best, &points, &pixels) - 1e-9);
            let back = find_flipped_pose(&other, &points, &pixels, &camera())
                .unwrap()
                .unwrap();
            assert!(back.rotation.angle_to(&best.rotation) < 1e-4);
        }
        assert!(num_found > 80, "{num_found}");
    }

    #[test]
    fn points_in_space_have_one_pose() {
        let mut random = Random::new(6);
        let truth = RigidTransform::new(Vector3::new(0.3, -0.2, 6.0), Vector3::new(0.2, 0.3, 0.1));
        let points: Vec<_> = (0..30)
            .map(|_| Point3::from(Vector3::from_fn(|_, _| random.uniform(-2.0, 2.0))))
            .collect();
        let pixels: Vec<_> = points
            .iter()
            .map(|x| camera().project(&(truth * x)).unwrap())
            .collect();
        match find_flipped_pose(&truth, &points, &pixels, &camera()).unwrap() {
            None => {}
            Some(other) => assert!(cost(&other, &points, &pixels) > 100.0),
        }
    }
}
