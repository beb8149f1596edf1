//! Blocks of voxels near the surfaces of depth maps.

use super::super::depth_map::DepthMap;
use super::super::views::MvsView;
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};
use nalgebra::Point3;
use std::collections::BTreeSet;

/// Number of voxels along an edge of a block.
pub(super) const EDGE: usize = 8;

/// Maximum distance from a surface at which voxels are updated, voxels.
pub(super) const TRUNCATION: f64 = 3.0;

/// Maximum number of blocks: 2 KB each for the distances, and the same for the colors.
const MAX_BLOCKS: usize = 250_000;

/// A block, given by its first voxel divided by [`EDGE`].
pub(super) type Block = [i32; 3];

/// Returns the blocks within the truncation distance of any pixel's point, in ascending order.
///
/// # Errors
/// [`Error::OutOfRange`] for too many blocks, [`Error::Canceled`].
pub(super) fn near_surfaces(
    views: &[MvsView],
    maps: &[DepthMap],
    voxel_size: f64,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Block>> {
    let mut all = BTreeSet::new();
    for (n, (view, map)) in views.iter().zip(maps).enumerate() {
        let [from, to] = [n, n + 1].map(|n| n as f32 / views.len() as f32);
        let rows: Vec<usize> = (0..map.depth.height() as usize).collect();
        let mut part = Part::new(monitor, from, to);
        let found = monitored::map(&rows, Stage::Fusion, &mut part, |&row| {
            of_row(view, map, row, voxel_size)
        })?;
        all.extend(found.into_iter().flatten());
        let is_allowed = all.len() <= MAX_BLOCKS;
        Error::check_rules(&[(
            "the size of a voxel",
            "larger: there are more than 128 million voxels near the surface",
            voxel_size,
            is_allowed,
        )])?;
    }
    Ok(all.into_iter().collect())
}

fn of_row(view: &MvsView, map: &DepthMap, row: usize, voxel_size: f64) -> Vec<Block> {
    let width = map.depth.width() as usize;
    let block_size = EDGE as f64 * voxel_size;
    let mut blocks = Vec::new();
    for pixel in row * width..(row + 1) * width {
        let depth = f64::from(map.depth.as_raw()[pixel]);
        if depth.is_nan() {
            continue;
        }
        let ray = view.ray(pixel);
        let half = TRUNCATION * voxel_size / ray.norm();
        // Steps of 1.5 voxels.
        for step in -2..=2 {
            let in_cam = Point3::from(ray * (depth + 0.5 * f64::from(step) * half));
            let point = view.camera.cam_from_world.inverse_transform_point(&in_cam);
            let block = [0, 1, 2].map(|axis| (point[axis] / block_size).floor() as i32);
            if blocks.last() != Some(&block) {
                blocks.push(block);
            }
        }
    }
    blocks.sort_unstable();
    blocks.dedup();
    blocks
}
