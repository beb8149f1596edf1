//! Uncertainty of triangulated points.

use crate::camera::PosedCamera;
use crate::math::scaling::power_of_two;
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point3, SMatrix};

/// Returns the angle between the rays from two camera centers to a point, in [0, π/2]; 0 if the
/// point is a center.
///
/// Opposite rays, with the point between the centers, determine it as badly as parallel ones, so
/// angles beyond π/2 count as π minus the angle.
///
/// Source: the law of cosines; as in COLMAP's reconstruction pipeline, Schönberger & Frahm 2016.
///
/// ```
/// use epipole::triangulation::triangulation_angle_rad;
/// use nalgebra::Point3;
/// let angle = triangulation_angle_rad(&Point3::origin(), &Point3::new(0.0, 1.0, 0.0), &Point3::new(0.0, 0.0, 100.0));
/// assert!((angle - 0.009999666687).abs() < 1e-8); // atan(1/100)
/// ```
pub fn triangulation_angle_rad(
    center1_in_world: &Point3<f64>,
    center2_in_world: &Point3<f64>,
    point_in_world: &Point3<f64>,
) -> f64 {
    let (r1, r2) = (
        point_in_world - center1_in_world,
        point_in_world - center2_in_world,
    );
    // The arctangent preserves small angles that a cosine near 1 would lose.
    let angle = libm::atan2(r1.cross(&r2).norm(), r1.dot(&r2).abs());
    if angle.is_finite() { angle } else { 0.0 }
}

/// Computes the covariance of a triangulated point, m², from pixel errors of standard deviation
/// `sigma_px` in each coordinate of each view: `σ² (Σ JᵀJ)⁻¹`, where J is the derivative of a
/// projection by the point.
///
/// Square roots of its eigenvalues are the semiaxes of the error ellipsoid: long along the rays,
/// short across.
///
/// * `cameras`: at least two cameras that see the point
/// * `point_in_world`: the point, or its estimate
///
/// # Errors
/// [`Error::PointBehindCamera`] if a camera does not see the point, [`Error::OutOfRange`] for
/// `sigma_px` ≤ 0 or NaN, [`Error::PointAtInfinity`] if the views leave the depth undetermined,
/// [`Error::NotFinite`] if the covariance overflows.
///
/// Source: Hartley & Zisserman 2004, §5.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::triangulation::point_covariance;
/// use nalgebra::Point3;
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let camera = |x: f64| PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::translation(-x, 0.0, 0.0) };
/// let covariance = point_covariance(&[camera(-0.06), camera(0.06)], &Point3::new(0.0, 0.0, 2.8), 0.5)?;
/// // Across, two views measure v: (Z/f) σ/√2 = 0.0014 m. Along, Z² σ√2/(f B) = 0.066 m.
/// assert!((covariance[(1, 1)].sqrt() - 0.001414).abs() < 1e-6);
/// assert!((covariance[(2, 2)].sqrt() - 0.066).abs() < 1e-5);
/// # Ok(()) }
/// ```
pub fn point_covariance(
    cameras: &[PosedCamera],
    point_in_world: &Point3<f64>,
    sigma_px: f64,
) -> Result<Matrix3<f64>> {
    if !(sigma_px > 0.0 && sigma_px.is_finite()) {
        return Err(Error::OutOfRange {
            what: "the standard deviation of a pixel",
            requirement: "greater than 0 pixels",
            value: sigma_px,
        });
    }
    let mut jacobians = Vec::with_capacity(cameras.len());
    for camera in cameras {
        camera.project(point_in_world)?;
        jacobians.push(projection_jacobian(camera, point_in_world));
    }
    // In pixels per meter squares may overflow or underflow.
    let largest = jacobians
        .iter()
        .fold(0.0, |most: f64, j| most.max(j.amax()));
    let unit = power_of_two(largest);
    let information: Matrix3<f64> = jacobians
        .iter()
        .map(|j| j / unit)
        .map(|j| j.transpose() * j)
        .sum();
    if !information.iter().all(|x| x.is_finite()) {
        return Err(Error::PointAtInfinity);
    }
    let sizes = svd3(&information).singular_values;
    if sizes[2] <= 1e-14 * sizes[0] {
        return Err(Error::PointAtInfinity);
    }
    let inverse = information.try_inverse().ok_or(Error::PointAtInfinity)?;
    let sigma = sigma_px / unit;
    let covariance = inverse * sigma * sigma;
    if covariance.iter().all(|x| x.is_finite()) {
        Ok(covariance)
    } else {
        Err(Error::NotFinite {
            what: "the covariance of the point",
        })
    }
}

/// Returns the derivatives of a projection (u, v) by the point's world coordinates.
pub(super) fn projection_jacobian(
    camera: &PosedCamera,
    point_in_world: &Point3<f64>,
) -> SMatrix<f64, 2, 3> {
    let x = camera.cam_from_world * point_in_world;
    camera.camera.jacobian(&x) * camera.cam_from_world.rotation.to_rotation_matrix().matrix()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, RigidTransform, look_at};
    use crate::math::random::Random;
    use crate::triangulation::triangulate_optimal;
    use nalgebra::{Point2, Vector3};

    /// COLMAP's src/colmap/geometry/triangulation_test.cc.
    #[test]
    fn published_angles() {
        let (o, y) = (Point3::origin(), Point3::new(0.0, 1.0, 0.0));
        for (z, expected) in [(100.0, 0.009_999_666_687), (50.0, 0.019_997_333_973)] {
            let angle = triangulation_angle_rad(&o, &y, &Point3::new(0.0, 0.0, z));
            assert!((angle - expected).abs() < 1e-8);
        }
        for point in [o, Point3::new(50.0, 0.0, 0.0), Point3::new(0.0, 0.0, 50.0)] {
            assert!(triangulation_angle_rad(&o, &o, &point) < 1e-6);
        }
        let far = Point3::new(50.0, 0.0, 50.0);
        for point in [Point3::new(50.0, 0.0, 0.0), Point3::new(0.0, 0.0, 50.0)] {
            let angle = triangulation_angle_rad(&o, &far, &point);
            assert!((angle - core::f64::consts::FRAC_PI_2).abs() < 1e-6);
        }
        // Opposite rays.
        for z in [0.0, 50.0, 25.0, -25.0, 75.0] {
            let angle = triangulation_angle_rad(
                &o,
                &Point3::new(0.0, 0.0, 50.0),
                &Point3::new(0.0, 0.0, z),
            );
            assert!(angle < 1e-6);
        }
    }

    #[test]
    fn depth_is_less_certain_than_width() {
        let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0).unwrap();
        let camera = |x: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: RigidTransform::translation(-x, 0.0, 0.0),
        };
        let point = Point3::new(0.05, 0.0, 2.0);
        let covariance = point_covariance(&[camera(0.0), camera(0.1)], &point, 0.5).unwrap();
        // Both views: depth error ≈ Z² σ_d / (f B), with σ_d = σ √2.
        let expected = 4.0 * 0.5 * core::f64::consts::SQRT_2 / (700.0 * 0.1);
        assert!((covariance[(2, 2)].sqrt() / expected - 1.0).abs() < 0.01);
        assert!(covariance[(2, 2)] > 100.0 * covariance[(0, 0)]);
        assert_eq!(
            point_covariance(&[camera(0.0)], &point, 0.5),
            Err(Error::PointAtInfinity)
        );
        let behind = Point3::new(0.0, 0.0, -1.0);
        assert!(point_covariance(&[camera(0.0)], &behind, 0.5).is_err());
        assert!(point_covariance(&[camera(0.0)], &point, f64::NAN).is_err());
        assert!(point_covariance(&[], &point, 1.0).is_err());
    }

    /// Compares every entry with the spread of points triangulated from noisy pixels.
    #[test]
    fn the_whole_matrix_agrees_with_many_noisy_triangulations() {
        let intrinsics = Intrinsics::new(650.0, 600.0, 320.0, 240.0).unwrap();
        let camera = |center: Point3<f64>| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: look_at(&center, &Point3::origin(), &Vector3::new(0.2, -1.0, 0.1))
                .unwrap(),
        };
        let cameras = [
            camera(Point3::new(-3.5, 0.3, -3.0)),
            camera(Point3::new(-2.2, -0.8, -4.0)),
        ];
        let point = Point3::new(0.2, 0.1, 0.3);
        let sigma_px = 0.5;
        let covariance = point_covariance(&cameras, &point, sigma_px).unwrap();
        let projected = cameras.map(|c| c.project(&point).unwrap());
        let mut random = Random::new(6);
        let count = 20_000;
        let mut spread = Matrix3::zeros();
        for _ in 0..count {
            let [p1, p2] = projected.map(|p| {
                Point2::new(
                    p.x + sigma_px * random.normal(),
                    p.y + sigma_px * random.normal(),
                )
            });
            let off = triangulate_optimal(&cameras[0], &cameras[1], &p1, &p2).unwrap() - point;
            spread += off * off.transpose() / f64::from(count);
        }
        // The relative error of a sample variance of n numbers is √(2/n), 1 %; so is that of a
        // covariance, relative to the product of both deviations.
        for i in 0..3 {
            for j in 0..3 {
                let scale = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
                let off = (spread[(i, j)] - covariance[(i, j)]).abs() / scale;
                assert!(off < 0.03, "{i} {j}: {off}");
            }
        }
        // Correlations are large here, so off-diagonal entries are tested as well.
        let correlation = covariance[(0, 2)] / (covariance[(0, 0)] * covariance[(2, 2)]).sqrt();
        assert!(correlation.abs() > 0.2, "{correlation}");
    }

    #[test]
    fn units_of_any_size() {
        let point = Point3::new(0.05, 0.0, 2.0);
        let covariance = |focal_px: f64, sigma_px: f64| {
            let intrinsics = Intrinsics::new(focal_px, focal_px, 0.0, 0.0).unwrap();
            let camera = |x: f64| PosedCamera {
                camera: Camera::pinhole(intrinsics, 640, 480),
                cam_from_world: RigidTransform::translation(-x, 0.0, 0.0),
            };
            point_covariance(&[camera(0.0), camera(0.1)], &point, sigma_px)
        };
        let expected = covariance(1.0, 0.01).unwrap();
        for size in [1e-200, 1e200] {
            let found = covariance(size, 0.01 * size).unwrap();
            assert!((found - expected).amax() < 1e-12 * expected.amax());
        }
        assert!(matches!(
            covariance(1.0, 1e200),
            Err(Error::NotFinite { .. })
        ));
    }
}
