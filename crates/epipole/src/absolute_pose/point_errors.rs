//! Reprojection errors of points, pixels, for pinholes and other lenses.

use crate::camera::{Intrinsics, Observation};
use nalgebra::{Matrix2x3, Point2, Point3, Vector2, Vector3};

/// Rotation and translation of `cam_from_world`.
pub(super) type Pose = (nalgebra::Matrix3<f64>, Vector3<f64>);

/// Errors of points given in the camera frame.
pub(super) trait PointErrors {
    /// Returns the depth along the optical axis or along the ray of the pixel.
    fn depth(&self, x_in_cam: &Vector3<f64>, index: usize) -> f64;

    /// Returns the error; `None` if the camera does not see the point.
    fn residual(&self, x_in_cam: &Vector3<f64>, index: usize) -> Option<Vector2<f64>>;

    /// Returns the error and its derivative by the point in the camera frame.
    fn linearized(
        &self,
        x_in_cam: &Vector3<f64>,
        index: usize,
    ) -> Option<(Vector2<f64>, Matrix2x3<f64>)>;
}

/// Points and their pixels of a pinhole camera.
#[derive(Debug, Clone, Copy)]
pub(super) struct PinholePoints<'a> {
    pub(super) pixels: &'a [Point2<f64>],
    pub(super) intrinsics: &'a Intrinsics,
}

impl PinholePoints<'_> {
    /// Returns the squared error; infinite behind the camera.
    pub(super) fn error_sq(&self, x: &Vector3<f64>, index: usize) -> f64 {
        let k = self.intrinsics;
        let center = k.principal_point();
        let du = k.fu_px() * x.x / x.z + center.x - self.pixels[index].x;
        let dv = k.fv_px() * x.y / x.z + center.y - self.pixels[index].y;
        match x.z > 0.0 {
            true => du * du + dv * dv,
            false => f64::INFINITY,
        }
    }
}

impl PointErrors for PinholePoints<'_> {
    fn depth(&self, x_in_cam: &Vector3<f64>, _: usize) -> f64 {
        x_in_cam.z
    }

    fn residual(&self, x_in_cam: &Vector3<f64>, index: usize) -> Option<Vector2<f64>> {
        let projected = self.intrinsics.project(&Point3::from(*x_in_cam)).ok()?;
        Some(projected - self.pixels[index])
    }

    fn linearized(&self, x: &Vector3<f64>, index: usize) -> Option<(Vector2<f64>, Matrix2x3<f64>)> {
        let residual = self.residual(x, index)?;
        let (fu, fv) = (self.intrinsics.fu_px(), self.intrinsics.fv_px());
        let per_z = 1.0 / x.z;
        let by_point = Matrix2x3::new(
            fu * per_z,
            0.0,
            -fu * x.x * per_z * per_z,
            0.0,
            fv * per_z,
            -fv * x.y * per_z * per_z,
        );
        Some((residual, by_point))
    }
}

/// Points and their observations of a camera with any lens.
#[derive(Debug, Clone, Copy)]
pub(super) struct LensPoints<'a> {
    pub(super) observations: &'a [Observation],
}

impl PointErrors for LensPoints<'_> {
    fn depth(&self, x_in_cam: &Vector3<f64>, index: usize) -> f64 {
        self.observations[index].ray().dot(x_in_cam)
    }

    fn residual(&self, x_in_cam: &Vector3<f64>, index: usize) -> Option<Vector2<f64>> {
        self.observations[index].offset_px(x_in_cam)
    }

    fn linearized(
        &self,
        x_in_cam: &Vector3<f64>,
        index: usize,
    ) -> Option<(Vector2<f64>, Matrix2x3<f64>)> {
        self.observations[index].offset_with_derivative(x_in_cam)
    }
}
