//! How well a point is determined.

use crate::camera::Camera;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point3, SMatrix};

/// The angle at which the rays from two camera centers meet at a point, in [0, π/2]; 0 if the point is a
/// center.
///
/// Rays that meet head on, the point being between the centers, determine it as badly as
/// parallel ones, so angles beyond π/2 count as π minus the angle.
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
    // The arctangent keeps small angles that a cosine near 1 would lose.
    let angle = libm::atan2(r1.cross(&r2).norm(), r1.dot(&r2).abs());
    if angle.is_finite() { angle } else { 0.0 }
}

/// The covariance of a triangulated point, m², from pixel errors of standard deviation `sigma_px` in each
/// coordinate of each view: `σ² (Σ JᵀJ)⁻¹`, J being the derivatives of a projection by the point.
///
/// Square roots of its eigenvalues are the semiaxes of the error ellipsoid: long along the rays,
/// short across.
///
/// # Errors
/// [`Error::PointBehindCamera`] if a camera does not see the point, [`Error::OutOfRange`] for
/// `sigma_px` ≤ 0 or NaN, [`Error::PointAtInfinity`] if the views leave the point free to move
/// along a ray.
///
/// Source: Hartley & Zisserman 2004, §5.2.
pub fn point_covariance(
    cameras: &[Camera],
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
    let mut information = Matrix3::zeros();
    for camera in cameras {
        camera.project(point_in_world)?;
        let jacobian = projection_jacobian(camera, point_in_world);
        information += jacobian.transpose() * jacobian;
    }
    let eigen = information.symmetric_eigenvalues();
    if eigen.max().is_nan() || eigen.min() <= 1e-14 * eigen.max() {
        return Err(Error::PointAtInfinity);
    }
    let inverse = information.try_inverse().ok_or(Error::PointAtInfinity)?;
    Ok(inverse * (sigma_px * sigma_px))
}

/// The derivatives of a projection (u, v) by the point's world coordinates.
pub(super) fn projection_jacobian(
    camera: &Camera,
    point_in_world: &Point3<f64>,
) -> SMatrix<f64, 2, 3> {
    let x = camera.cam_from_world * point_in_world;
    let (fu, fv) = (camera.intrinsics.fu_px(), camera.intrinsics.fv_px());
    let per_z = 1.0 / x.z;
    let by_cam = SMatrix::<f64, 2, 3>::new(
        fu * per_z,
        0.0,
        -fu * x.x * per_z * per_z,
        0.0,
        fv * per_z,
        -fv * x.y * per_z * per_z,
    );
    by_cam * camera.cam_from_world.rotation.to_rotation_matrix().matrix()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Intrinsics, RigidTransform};

    /// COLMAP's triangulation_test.
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
        // Head on.
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
        let camera = |x: f64| Camera {
            intrinsics,
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
}
