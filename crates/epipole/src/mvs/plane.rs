//! Planes as linear functions of the pixel that give the inverse depth.

use crate::camera::Intrinsics;
use nalgebra::{Point2, Vector3};

/// A plane through the surface at a pixel: the inverse depth there and its change per pixel. For an
/// undistorted camera the inverse depth of any plane is linear in the pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Plane {
    /// Inverse depth at the pixel, > 0.
    pub(super) inverse_depth: f32,
    /// Its change per column.
    pub(super) du: f32,
    /// Its change per row.
    pub(super) dv: f32,
}

/// Minimum cosine between normal and ray: at more grazing angles surfaces fit anything.
pub(super) const MIN_COSINE: f64 = 0.15;

impl Plane {
    /// Returns the same plane at another pixel, by its offset.
    #[inline(always)]
    pub(super) fn moved(self, du: f32, dv: f32) -> Self {
        Self {
            inverse_depth: self.inverse_depth + self.du * du + self.dv * dv,
            ..self
        }
    }

    /// * `normal`: towards the camera, in its frame, of any length: `n · ray < 0`
    pub(super) fn from_normal(
        intrinsics: &Intrinsics,
        ray: &Vector3<f64>,
        inverse_depth: f64,
        normal: &Vector3<f64>,
    ) -> Self {
        // Points X of the plane have g · X = 1, so 1/z = g · ray.
        let g = normal * (inverse_depth / normal.dot(ray));
        Self {
            inverse_depth: inverse_depth as f32,
            du: (g.x / intrinsics.fu_px()) as f32,
            dv: (g.y / intrinsics.fv_px()) as f32,
        }
    }

    /// Returns the unit normal towards the camera, in its frame.
    ///
    /// * `pixel`: pixel of the plane
    pub(super) fn normal(&self, intrinsics: &Intrinsics, pixel: &Point2<f64>) -> Vector3<f64> {
        let ray = intrinsics.ray(pixel);
        let x = f64::from(self.du) * intrinsics.fu_px();
        let y = f64::from(self.dv) * intrinsics.fv_px();
        let z = f64::from(self.inverse_depth) - x * ray.x - y * ray.y;
        -Vector3::new(x, y, z).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_depth_of_a_plane_is_linear_and_keeps_its_normal() {
        let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
        let normal = Vector3::new(0.3, -0.2, -0.9).normalize();
        let on_plane = k.ray(&Point2::new(100.0, 50.0)) * 4.0;
        let depth = |pixel: &Point2<f64>| normal.dot(&on_plane) / normal.dot(&k.ray(pixel));
        let (a, b) = (Point2::new(100.0, 50.0), Point2::new(130.0, 20.0));
        let plane = Plane::from_normal(&k, &k.ray(&a), 1.0 / depth(&a), &normal);
        let there = plane.moved(30.0, -30.0);
        assert!((f64::from(there.inverse_depth) - 1.0 / depth(&b)).abs() < 1e-6);
        for (plane, pixel) in [(plane, a), (there, b)] {
            assert!((plane.normal(&k, &pixel) - normal).norm() < 1e-4);
        }
    }
}
