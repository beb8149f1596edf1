//! Meshing of depth maps.

use super::super::depth_map::DepthMap;
use super::super::fusion::check_maps;
use super::super::views::{MvsView, check_views};
use super::options::MeshOptions;
use super::signed_distance::Field;
use super::surface::Mesh;
use super::{blocks, pieces, surface_nets};
use crate::progress::{Monitor, Part};
use crate::{Error, Result};

/// Progress when the blocks are chosen, and when their distances are computed.
const CHOSEN: f32 = 0.2;
const KNOWN: f32 = 0.9;

/// Converts depth maps to a mesh: the zero level of the mean signed distance to their surfaces. The
/// mesh has holes where no photo sees the surface, and is empty if no piece has
/// [`MeshOptions::min_triangles`].
///
/// * `views`, `maps`: input and result of [`estimate_depth_maps`](crate::mvs::estimate_depth_maps)
/// * `monitor`: the only stage is [`Stage::Fusion`](crate::progress::Stage::Fusion)
///
/// # Errors
/// [`Error::SizeMismatch`] if the maps do not match the views, [`Error::OutOfRange`] for an option
/// outside its range, voxels smaller than a quarter of a pixel on the surface or more than 128
/// million of them, [`Error::TooFew`] if no pixel has a depth, [`Error::Canceled`].
///
/// Source: Curless & Levoy 1996, "A volumetric method for building complex models from range
/// images"; Bylow et al. 2013, "Real-time camera tracking and 3D reconstruction using signed
/// distance functions", point to plane; Gibson 1998, "Constrained elastic surface nets", without
/// relaxation.
#[doc(alias = "poisson_mesher")]
#[doc(alias = "delaunay_mesher")]
pub fn mesh_depth_maps(
    views: &[MvsView],
    maps: &[DepthMap],
    options: &MeshOptions,
    monitor: &mut dyn Monitor,
) -> Result<Mesh> {
    options.check()?;
    check_views(views)?;
    check_maps(views, maps)?;
    let footprint = pixel_footprint(views, maps).ok_or(Error::TooFew {
        what: "a mesh from pixels with a depth",
        needed: 1,
        got: 0,
    })?;
    let voxel_size = options
        .voxel_size
        .unwrap_or(options.voxel_size_px * footprint);
    Error::check_rules(&[(
        "the size of a voxel",
        "at least a quarter of a pixel on the surface",
        voxel_size,
        voxel_size >= 0.25 * footprint,
    )])?;
    let part = &mut Part::new(monitor, 0.0, CHOSEN);
    let blocks = blocks::near_surfaces(views, maps, voxel_size, part)?;
    let part = &mut Part::new(monitor, CHOSEN, KNOWN);
    let field = Field::of(views, maps, blocks, voxel_size, part)?;
    let part = &mut Part::new(monitor, KNOWN, 1.0);
    let mesh = surface_nets::extract(&field, part)?;
    Ok(pieces::without_small(&mesh, options.min_triangles))
}

/// Returns the size of a pixel on the surface, the median of the maps' medians; `None` if no pixel
/// has a depth.
fn pixel_footprint(views: &[MvsView], maps: &[DepthMap]) -> Option<f64> {
    let of = |(view, map): (&MvsView, &DepthMap)| {
        let depths = map.depth.as_raw().iter().copied();
        let depth = median(
            depths
                .filter(|depth| !depth.is_nan())
                .map(f64::from)
                .collect(),
        )?;
        Some(depth / view.camera.camera.intrinsics.fu_px())
    };
    median(views.iter().zip(maps).filter_map(of).collect())
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
