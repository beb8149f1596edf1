//! Cost of a plane at a pixel: photo-consistency and geometric consistency with the neighbors.

use super::field::Surface;
use super::level::Level;
use super::options::MAX_NEIGHBORS;
use super::pair::Pair;
use super::patch::{GrayWeights, Patch, dissimilarity};
use super::plane::{MIN_COSINE, Plane};
use nalgebra::Point2;

/// Cost in a neighbor that does not see the point; slightly more than for no correlation.
const UNSEEN: f32 = 1.2;
/// Cost of a pixel of reprojection error.
const PER_PX: f32 = 0.2;
/// Maximum reprojection error in the cost, pixels.
const MAX_ERROR_PX: f32 = 3.0;

/// A neighbor at one resolution.
pub(super) struct Neighbor<'a> {
    pub(super) level: &'a Level,
    pub(super) to: Pair,
    pub(super) from: Pair,
    /// Surface of the previous pass, for geometric consistency, and its relative resolution.
    pub(super) surface: Option<(&'a Surface, [f32; 2])>,
}

/// A photo at one resolution, to be matched with its neighbors.
pub(super) struct Matching<'a> {
    pub(super) level: &'a Level,
    pub(super) neighbors: Vec<Neighbor<'a>>,
    /// Number of neighbors used per pixel.
    pub(super) num_best: usize,
    /// Minimum and maximum inverse depth.
    pub(super) range: [f32; 2],
    pub(super) gray_weights: GrayWeights,
}

/// Parts of the cost common to all planes at a pixel.
pub(super) struct PixelCost {
    patch: Patch,
    pub(super) ray: [f64; 3],
    ray_sq: f64,
    pub(super) u: f64,
    pub(super) v: f64,
    of_pixel: [[f64; 3]; MAX_NEIGHBORS],
}

impl Matching<'_> {
    pub(super) fn pixel(&self, u: usize, v: usize) -> PixelCost {
        let (x, y) = (u as f64, v as f64);
        let mut of_pixel = [[0.0; 3]; MAX_NEIGHBORS];
        for (place, neighbor) in of_pixel.iter_mut().zip(&self.neighbors) {
            *place = neighbor.to.of_pixel(x, y);
        }
        let ray = self.level.camera.camera.intrinsics.ray(&Point2::new(x, y));
        PixelCost {
            patch: Patch::new(self.level, &self.gray_weights, u, v),
            ray: ray.into(),
            ray_sq: ray.norm_squared(),
            u: x,
            v: y,
            of_pixel,
        }
    }

    /// Returns whether a plane is within the depth range and not at too grazing an angle.
    pub(super) fn is_possible(&self, pixel: &PixelCost, plane: Plane) -> bool {
        let w = plane.inverse_depth;
        if !(w >= self.range[0] && w <= self.range[1]) {
            return false;
        }
        let k = &self.level.camera.camera.intrinsics;
        let x = f64::from(plane.du) * k.fu_px();
        let y = f64::from(plane.dv) * k.fv_px();
        let z = f64::from(w) - x * pixel.ray[0] - y * pixel.ray[1];
        let cosine_sq = f64::from(w * w) / ((x * x + y * y + z * z) * pixel.ray_sq);
        cosine_sq >= MIN_COSINE * MIN_COSINE
    }

    /// Returns the mean cost in the best neighbors, and these as a bit mask.
    pub(super) fn of_best(&self, pixel: &PixelCost, plane: Plane) -> (f32, u32) {
        let mut costs = [(UNSEEN, 0); MAX_NEIGHBORS];
        let count = self.neighbors.len();
        for (place, cost) in costs[..count].iter_mut().enumerate() {
            *cost = (self.of_neighbor(pixel, plane, place), place);
        }
        costs[..count].sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let best = &costs[..self.num_best.min(count)];
        let views = best.iter().fold(0, |bits, (_, place)| bits | 1 << place);
        let total: f32 = best.iter().map(|(cost, _)| cost).sum();
        (total / best.len() as f32, views)
    }

    /// Returns the mean cost in the given neighbors; infinite above `limit`.
    pub(super) fn of_views(&self, pixel: &PixelCost, plane: Plane, views: u32, limit: f32) -> f32 {
        let count = views.count_ones() as f32;
        let (mut total, mut left) = (0.0, views);
        while left != 0 {
            total += self.of_neighbor(pixel, plane, left.trailing_zeros() as usize);
            left &= left - 1;
            if total > limit * count {
                return f32::INFINITY;
            }
        }
        total / count
    }

    fn of_neighbor(&self, pixel: &PixelCost, plane: Plane, place: usize) -> f32 {
        let neighbor = &self.neighbors[place];
        let Some(affine) = neighbor.to.affine(&pixel.of_pixel[place], plane) else {
            return UNSEEN + self.penalty(MAX_ERROR_PX, neighbor);
        };
        let [x, y] = affine.center;
        if !neighbor.level.contains(x, y) {
            return UNSEEN + self.penalty(MAX_ERROR_PX, neighbor);
        }
        let photometric = dissimilarity(&pixel.patch, neighbor.level, &affine).min(UNSEEN);
        photometric + self.penalty(self.error_px(pixel, neighbor, x, y), neighbor)
    }

    fn penalty(&self, error_px: f32, neighbor: &Neighbor<'_>) -> f32 {
        match neighbor.surface {
            Some(_) => PER_PX * error_px.min(MAX_ERROR_PX),
            None => 0.0,
        }
    }

    /// Returns the error of a pixel transferred to (x, y) of a neighbor and back by the neighbor's
    /// surface.
    fn error_px(&self, pixel: &PixelCost, neighbor: &Neighbor<'_>, x: f32, y: f32) -> f32 {
        let Some((surface, scale)) = neighbor.surface else {
            return 0.0;
        };
        let there = surface.plane_at(x, y, scale).inverse_depth;
        let of_pixel = neighbor.from.of_pixel(f64::from(x), f64::from(y));
        let Some([u, v, _]) = neighbor.from.transfer(&of_pixel, f64::from(there)) else {
            return MAX_ERROR_PX;
        };
        let (du, dv) = ((u - pixel.u) as f32, (v - pixel.v) as f32);
        (du * du + dv * dv).sqrt()
    }
}
