//! Consistency of the depth maps of two photos.

use super::depth_map::DepthMap;
use super::options::MvsOptions;
use super::pair::Pair;
use super::views::MvsView;
use crate::camera::{Intrinsics, relative_motion};
use nalgebra::{Matrix3, Point2, Vector3};

/// A photo, one of its neighbors, and the tests of consistency.
pub(super) struct Agreement<'a> {
    /// Index of the neighbor.
    pub(super) neighbor: usize,
    map: &'a DepthMap,
    intrinsics: Intrinsics,
    to: Pair,
    from: Pair,
    /// Rotation of normals from this photo to the neighbor.
    rotation: Matrix3<f64>,
    max_error_sq: f64,
    max_difference: f64,
    min_cosine: f64,
}

/// Returns the tests of consistency with all neighbors of a photo.
pub(super) fn agreements<'a>(
    views: &[MvsView],
    maps: &'a [DepthMap],
    photo: usize,
    options: &MvsOptions,
) -> Vec<Agreement<'a>> {
    let of = |&neighbor: &usize| {
        let (here, there) = (&views[photo].camera, &views[neighbor].camera);
        let motion = relative_motion(&here.cam_from_world, &there.cam_from_world);
        let max_error_px = options.max_reprojection_error_px;
        Agreement {
            neighbor,
            map: &maps[neighbor],
            intrinsics: there.camera.intrinsics,
            to: Pair::new(here, there),
            from: Pair::new(there, here),
            rotation: *motion.rotation.to_rotation_matrix().matrix(),
            max_error_sq: max_error_px * max_error_px,
            max_difference: options.max_depth_difference,
            min_cosine: libm::cos(options.max_normal_angle_deg.to_radians()),
        }
    };
    views[photo].neighbors.iter().map(of).collect()
}

impl Agreement<'_> {
    /// Returns the index of the neighbor's pixel that agrees with a pixel, given its depth and
    /// normal.
    pub(super) fn pixel(
        &self,
        [u, v]: [f64; 2],
        depth: f64,
        normal: &Vector3<f32>,
    ) -> Option<usize> {
        let [x, y, expected] = self.to.transfer(&self.to.of_pixel(u, v), 1.0 / depth)?;
        let (width, height) = self.map.depth.dimensions();
        let (column, row) = (x + 0.5, y + 0.5);
        if !(column >= 0.0 && row >= 0.0 && column < f64::from(width) && row < f64::from(height)) {
            return None;
        }
        let (column, row) = (column as u32, row as u32);
        let pixel = row as usize * width as usize + column as usize;
        let there = f64::from(self.map.depth.as_raw()[pixel]);
        if there.is_nan() {
            return None;
        }
        let other: Vector3<f64> = self.map.normals[pixel].cast();
        // Inverse depth of the neighbor's plane at the exact position, not at the nearest pixel.
        let nearest = Point2::new(f64::from(column), f64::from(row));
        let rays = [Point2::new(x, y), nearest].map(|pixel| self.intrinsics.ray(&pixel));
        let found = other.dot(&rays[0]) / (other.dot(&rays[1]) * there);
        // Comparisons with NaN are false.
        let is_near = (found / expected - 1.0).abs() <= self.max_difference;
        let cosine = (self.rotation * normal.cast::<f64>()).dot(&other);
        let is_parallel = cosine >= self.min_cosine;
        if !(is_near && is_parallel) {
            return None;
        }
        let [u2, v2, _] = self.from.transfer(&self.from.of_pixel(x, y), found)?;
        let error_sq = (u2 - u) * (u2 - u) + (v2 - v) * (v2 - v);
        (error_sq <= self.max_error_sq).then_some(pixel)
    }
}

/// Returns the number of photos that must agree on a depth, for a photo with `num_neighbors`.
pub(super) fn num_needed(options: &MvsOptions, num_neighbors: usize) -> usize {
    options.min_views.min(num_neighbors + 1)
}
