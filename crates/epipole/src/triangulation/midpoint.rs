//! The point nearest to two rays.

use crate::camera::RigidTransform;
use crate::epipolar::signed_depths;
use crate::{Error, Result};
use nalgebra::{Point3, Vector3};

/// The point halfway between two rays where they pass each other nearest, in the frame of camera 1.
///
/// It minimizes distances in space, not in the images: for a point near one camera and far from
/// the other, [`triangulate_optimal`](super::triangulate_optimal) is much better.
///
/// * `cam2_from_cam1`: the motion between the cameras
/// * `ray1`, `ray2`: directions in the frames of cameras 1 and 2; their lengths do not matter
///
/// # Errors
/// [`Error::PointAtInfinity`] for parallel rays, [`Error::PointBehindCamera`] if the rays diverge,
/// [`Error::NotFinite`] for NaN, infinities and zero rays.
///
/// Source: Hartley & Sturm 1997, "Triangulation", §5.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::triangulation::triangulate_midpoint;
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::translation(-2.0, 0.0, 0.0);
/// let point = triangulate_midpoint(&cam2_from_cam1, &Vector3::new(1.0, 0.0, 5.0), &Vector3::new(-1.0, 0.0, 5.0))?;
/// assert!((point - Point3::new(1.0, 0.0, 5.0)).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn triangulate_midpoint(
    cam2_from_cam1: &RigidTransform,
    ray1: &Vector3<f64>,
    ray2: &Vector3<f64>,
) -> Result<Point3<f64>> {
    let (Some(ray1), Some(ray2)) = (
        ray1.try_normalize(f64::MIN_POSITIVE),
        ray2.try_normalize(f64::MIN_POSITIVE),
    ) else {
        return Err(Error::NotFinite {
            what: "a ray's direction",
        });
    };
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
    let t = cam2_from_cam1.translation.vector;
    let turned = rotation * ray1;
    // sin² of the angle between the rays.
    let determinant = turned.cross(&ray2).norm_squared();
    if !determinant.is_finite() || !t.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a ray or the motion between the cameras",
        });
    }
    if determinant <= 1e-24 {
        return Err(Error::PointAtInfinity);
    }
    let (depth1, depth2) = signed_depths(&rotation, &t, &ray1, &ray2);
    let (depth1, depth2) = (depth1 / determinant, depth2 / determinant);
    if !(depth1 > 0.0 && depth2 > 0.0) {
        return Err(Error::PointBehindCamera);
    }
    let on_ray1 = ray1 * depth1;
    let on_ray2 = rotation.transpose() * (ray2 * depth2 - t);
    Ok(Point3::from((on_ray1 + on_ray2) * 0.5))
}

/// A point between two rays that lies nearer to the ray on which it is nearer to its camera, in the
/// frame of camera 1.
///
/// On each ray the point is taken at the depth where it would be if the rays met,
/// `d1 = |x2 × t|/|R x1 × x2|`, `d2 = |R x1 × t|/|R x1 × x2|`; the two points are weighted by
/// the inverse of their depths. Nearly as good as minimizing the reprojection error, at the price of
/// [`triangulate_midpoint`].
///
/// * `cam2_from_cam1`, `ray1`, `ray2`: as for [`triangulate_midpoint`]
///
/// # Errors
/// As [`triangulate_midpoint`].
///
/// Source: Lee & Civera 2019, "Triangulation: why optimize?", §4.
pub fn triangulate_weighted_midpoint(
    cam2_from_cam1: &RigidTransform,
    ray1: &Vector3<f64>,
    ray2: &Vector3<f64>,
) -> Result<Point3<f64>> {
    // Refuses what cannot be triangulated.
    triangulate_midpoint(cam2_from_cam1, ray1, ray2)?;
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
    let t = cam2_from_cam1.translation.vector;
    let (ray1, ray2) = (ray1.normalize(), ray2.normalize());
    let turned = rotation * ray1;
    let across = turned.cross(&ray2).norm();
    let (depth1, depth2) = (
        ray2.cross(&t).norm() / across,
        turned.cross(&t).norm() / across,
    );
    let on_ray1 = ray1 * depth1;
    let on_ray2 = rotation.transpose() * (ray2 * depth2 - t);
    let share1 = depth2 / (depth1 + depth2);
    Ok(Point3::from(on_ray1 * share1 + on_ray2 * (1.0 - share1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// The situations of COLMAP's triangulation_test.
    #[test]
    fn rays_that_miss_or_never_meet() {
        let shift = RigidTransform::translation;
        let relative = shift(1.0, 0.0, 0.0) * shift(-1.0, 0.0, 0.0).inverse();
        let expected = Point3::new(-1.0, 0.0, 5.0);
        let (ray1, ray2) = (Vector3::new(-1.0, 0.1, 5.0), Vector3::new(1.0, -0.1, 5.0));
        // |x2 × t| = √(100 + 0.04), |x1 × x2| = √101, and by symmetry the weights are equal.
        let point = triangulate_weighted_midpoint(&relative, &ray1, &ray2).unwrap();
        assert!((point.z - 5.0 * (100.04_f64 / 101.0).sqrt()).abs() < 1e-12);
        assert!((point - expected).norm() < 0.03 && point.y.abs() < 1e-12);
        // The rays pass each other nearest a little before: minimize (2 − 2s)² + (0.2 s)².
        let plain = triangulate_midpoint(&relative, &ray1, &ray2).unwrap();
        assert!((plain - Point3::new(-1.0, 0.0, 5.0 * 4.0 / 4.04)).norm() < 0.02);
        assert!((plain.z - 5.0 * 4.0 / 4.04).abs() < 1e-12);
        let right = shift(1.0, 0.0, 0.0);
        assert_eq!(
            triangulate_midpoint(&right, &Vector3::z(), &Vector3::z()),
            Err(Error::PointAtInfinity)
        );
        assert_eq!(
            triangulate_midpoint(
                &right,
                &Vector3::new(0.1, 0.0, 1.0),
                &Vector3::new(-0.1, 0.0, 1.0)
            ),
            Err(Error::PointBehindCamera)
        );
        assert!(triangulate_midpoint(&right, &Vector3::zeros(), &Vector3::z()).is_err());
        assert!(
            triangulate_midpoint(&right, &Vector3::from_element(f64::NAN), &Vector3::z()).is_err()
        );
    }

    #[test]
    fn exact_rays_meet() {
        let mut random = Random::new(1);
        for _ in 0..100 {
            let mut vector = || Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
            let motion = RigidTransform::new(vector(), vector());
            let point = Point3::from(vector());
            let found =
                triangulate_midpoint(&motion, &point.coords, &(motion * point).coords).unwrap();
            assert!((found - point).norm() < 1e-10);
            let (r1, r2) = (point.coords, (motion * point).coords);
            let weighted = triangulate_weighted_midpoint(&motion, &r1, &r2).unwrap();
            assert!((weighted - point).norm() < 1e-10);
        }
    }
}
