//! A camera and its pose.

use super::{Camera, RigidTransform};
use crate::Result;
use nalgebra::{Matrix3x4, Point2, Point3, Vector3};

/// A camera with its pose in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PosedCamera {
    /// Image size, intrinsics and lens.
    pub camera: Camera,
    /// `x_in_cam = cam_from_world * x_in_world`.
    pub cam_from_world: RigidTransform,
}

impl PosedCamera {
    /// Returns the camera's center in the world, `C = −Rᵀ t`.
    pub fn center_in_world(&self) -> Point3<f64> {
        self.cam_from_world
            .inverse_transform_point(&Point3::origin())
    }

    /// Returns the 3×4 matrix `P = K [R t]`, for undistorted pixels such as those of
    /// [`Camera::pinhole_pixel`].
    pub fn projection_matrix(&self) -> Matrix3x4<f64> {
        self.camera.intrinsics.matrix() * self.cam_from_world.to_matrix().fixed_view::<3, 4>(0, 0)
    }

    /// Projects a point of the world.
    ///
    /// # Errors
    /// [`PointBehindCamera`](crate::Error::PointBehindCamera) if the lens does not see the point.
    pub fn project(&self, x_in_world: &Point3<f64>) -> Result<Point2<f64>> {
        self.camera.project(&(self.cam_from_world * x_in_world))
    }

    /// Returns the direction of a pixel's ray in the world, scaled to unit depth (camera z), so it
    /// is not a unit vector.
    ///
    /// * `pinhole_pixel`: undistorted pixel, such as from [`Camera::pinhole_pixel`]
    pub fn ray_in_world(&self, pinhole_pixel: &Point2<f64>) -> Vector3<f64> {
        let ray = self.camera.intrinsics.ray(pinhole_pixel);
        self.cam_from_world.rotation.inverse_transform_vector(&ray)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Intrinsics, look_at};

    #[test]
    fn a_ray_of_known_depth_ends_where_it_began() {
        let camera = PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(600.0, 640, 480).unwrap(), 640, 480),
            cam_from_world: look_at(
                &Point3::new(1.0, 2.0, 3.0),
                &Point3::origin(),
                &Vector3::new(0.0, 0.0, 1.0),
            )
            .unwrap(),
        };
        let pixel = Point2::new(100.25, 400.5);
        let x_in_world = camera.center_in_world() + camera.ray_in_world(&pixel) * 2.5;
        assert!(((camera.cam_from_world * x_in_world).z - 2.5).abs() < 1e-12);
        assert!((camera.project(&x_in_world).unwrap() - pixel).norm() < 1e-9);
        let homogeneous = camera.projection_matrix() * x_in_world.to_homogeneous();
        assert!((homogeneous.x / homogeneous.z - pixel.x).abs() < 1e-9);
    }
}
