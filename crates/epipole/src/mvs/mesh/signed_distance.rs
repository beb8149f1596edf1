//! Mean signed distance of voxels to the surfaces of depth maps, positive in front.

use super::super::depth_map::DepthMap;
use super::super::views::MvsView;
use super::blocks::{Block, EDGE, TRUNCATION};
use crate::Result;
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use nalgebra::{Point3, Vector3};

/// Number of voxels of a block.
const VOLUME: usize = EDGE * EDGE * EDGE;

/// Minimum cosine between ray and normal, 73°: at more grazing angles, a pixel's plane does not
/// represent the surface a few voxels away.
const MIN_COSINE: f64 = 0.3;

/// Distances and colors of the voxels in blocks.
pub(super) struct Field {
    blocks: Vec<Block>,
    cells: Vec<Voxels>,
    pub(super) voxel_size: f64,
}

/// Voxels of a block, x first.
struct Voxels {
    /// Distances in voxels, at most the truncation; NaN if no photo determines them.
    distances: [f32; VOLUME],
    colors: [[u8; 3]; VOLUME],
}

/// A voxel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Voxel {
    /// Signed distance, voxels.
    pub(super) distance: f32,
    pub(super) color: [u8; 3],
}

impl Field {
    /// * `blocks`: in ascending order
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn of(
        views: &[MvsView],
        maps: &[DepthMap],
        blocks: Vec<Block>,
        voxel_size: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let cells = monitored::map(&blocks, Stage::Fusion, monitor, |block| {
            voxels(views, maps, block, voxel_size)
        })?;
        Ok(Self {
            blocks,
            cells,
            voxel_size,
        })
    }

    pub(super) fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Returns the position of a voxel in the world.
    pub(super) fn position(&self, voxel: [i32; 3]) -> Point3<f64> {
        Point3::from(voxel.map(|index| f64::from(index) * self.voxel_size))
    }

    /// Returns a voxel by its integer position; `None` if no photo determines its distance.
    pub(super) fn get(&self, voxel: [i32; 3]) -> Option<Voxel> {
        let edge = EDGE as i32;
        let block = voxel.map(|index| index.div_euclid(edge));
        let [x, y, z] = voxel.map(|index| index.rem_euclid(edge) as usize);
        let cell = &self.cells[self.blocks.binary_search(&block).ok()?];
        let index = (z * EDGE + y) * EDGE + x;
        let distance = cell.distances[index];
        (!distance.is_nan()).then_some(Voxel {
            distance,
            color: cell.colors[index],
        })
    }
}

/// A weighted sum.
#[derive(Clone, Copy, Default)]
struct Sum {
    weight: f64,
    distance: f64,
    color_weight: f64,
    color: [f64; 3],
}

fn voxels(views: &[MvsView], maps: &[DepthMap], block: &Block, voxel_size: f64) -> Voxels {
    let mut sums = [Sum::default(); VOLUME];
    let edge = EDGE as f64;
    let middle = block.map(|index| (f64::from(index) * edge + 0.5 * (edge - 1.0)) * voxel_size);
    let radius = 0.5 * 3f64.sqrt() * (edge - 1.0) * voxel_size;
    for (view, map) in views.iter().zip(maps) {
        if has_in_view(view, &Point3::from(middle), radius) {
            add(&mut sums, view, map, block, voxel_size);
        }
    }
    let mut voxels = Voxels {
        distances: [f32::NAN; VOLUME],
        colors: [[0; 3]; VOLUME],
    };
    for (index, sum) in sums.iter().enumerate() {
        if sum.weight > 0.0 {
            voxels.distances[index] = (sum.distance / sum.weight) as f32;
        }
        if sum.color_weight > 0.0 {
            voxels.colors[index] = sum.color.map(|c| (c / sum.color_weight).round() as u8);
        }
    }
    voxels
}

/// Returns whether a view may see a part of a ball.
fn has_in_view(view: &MvsView, middle: &Point3<f64>, radius: f64) -> bool {
    let in_cam = view.camera.cam_from_world * middle;
    if in_cam.z <= radius {
        return in_cam.z > -radius;
    }
    let intrinsics = &view.camera.camera.intrinsics;
    let Ok(pixel) = intrinsics.project(&in_cam) else {
        return false;
    };
    let margin = 2.0 * radius * intrinsics.fu_px().max(intrinsics.fv_px()) / (in_cam.z - radius);
    let (width, height) = view.image.dimensions();
    let is_within = |at: f64, size: u32| at >= -margin && at <= f64::from(size) + margin;
    is_within(pixel.x, width) && is_within(pixel.y, height)
}

/// Adds the distances to the surface of one map.
fn add(sums: &mut [Sum; VOLUME], view: &MvsView, map: &DepthMap, block: &Block, voxel_size: f64) {
    let (width, height) = view.image.dimensions();
    let intrinsics = &view.camera.camera.intrinsics;
    for (index, sum) in sums.iter_mut().enumerate() {
        let within = [index % EDGE, index / EDGE % EDGE, index / (EDGE * EDGE)];
        let at = |axis: usize| f64::from(block[axis]) * EDGE as f64 + within[axis] as f64;
        let world = Point3::from([0, 1, 2].map(|axis| at(axis) * voxel_size));
        let in_cam = view.camera.cam_from_world * world;
        let Ok(place) = intrinsics.project(&in_cam) else {
            continue;
        };
        let (column, row) = ((place.x + 0.5).floor(), (place.y + 0.5).floor());
        let is_within = |at: f64, size: u32| at >= 0.0 && at < f64::from(size);
        if !(is_within(column, width) && is_within(row, height)) {
            continue;
        }
        let pixel = row as usize * width as usize + column as usize;
        let depth = f64::from(map.depth.as_raw()[pixel]);
        if depth.is_nan() {
            continue;
        }
        let surface = view.ray(pixel) * depth;
        let normal: Vector3<f64> = map.normals[pixel].cast();
        let cosine = -normal.dot(&surface) / surface.norm();
        if cosine < MIN_COSINE {
            continue;
        }
        // Along the ray for visibility, to the plane for accuracy.
        let along = (depth - in_cam.z) * surface.norm() / (depth * voxel_size);
        let to_plane = normal.dot(&(in_cam.coords - surface)) / voxel_size;
        if along < -TRUNCATION / cosine || to_plane < -TRUNCATION {
            continue;
        }
        let weight = f64::from(map.num_views[pixel]) * cosine * cosine;
        sum.weight += weight;
        sum.distance += weight * to_plane.min(TRUNCATION);
        if to_plane < TRUNCATION {
            sum.color_weight += weight;
            let rgb = view.image.get_pixel(column as u32, row as u32).0;
            for (total, value) in sum.color.iter_mut().zip(rgb) {
                *total += weight * f64::from(value);
            }
        }
    }
}
