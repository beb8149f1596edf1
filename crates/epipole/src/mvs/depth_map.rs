//! Depth and normal of each pixel.

use image::{ImageBuffer, Luma};
use nalgebra::Vector3;

/// Depths and normals of the pixels of an [`MvsView`](super::MvsView).
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMap {
    /// Depth along the optical axis, in the unit of the reconstruction; NaN if unknown.
    pub depth: ImageBuffer<Luma<f32>, Vec<f32>>,
    /// Unit normals in the camera's frame, towards the camera, row by row; zero without depth.
    pub normals: Vec<Vector3<f32>>,
    /// Number of photos that agree on the depth, including this one, row by row; 0 without depth.
    pub num_views: Vec<u8>,
}

impl DepthMap {
    /// Returns the fraction of pixels with a depth.
    pub fn density(&self) -> f64 {
        let known = self.num_views.iter().filter(|count| **count > 0).count();
        known as f64 / self.num_views.len().max(1) as f64
    }

    /// Returns the minimum and maximum depth; `None` if no pixel has one.
    pub fn range(&self) -> Option<(f32, f32)> {
        let known = || self.depth.as_raw().iter().copied().filter(|z| !z.is_nan());
        let (near, far) = (known().reduce(f32::min)?, known().reduce(f32::max)?);
        Some((near, far))
    }

    /// Clears a pixel.
    pub(super) fn clear(&mut self, pixel: usize) {
        self.depth.as_mut()[pixel] = f32::NAN;
        self.normals[pixel] = Vector3::zeros();
        self.num_views[pixel] = 0;
    }
}
