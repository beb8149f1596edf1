//! Options of meshing.

use crate::{Error, Result};
use derive_setters::Setters;

/// Options of [`mesh_depth_maps`](crate::mvs::mesh_depth_maps).
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct MeshOptions {
    /// Edge of a voxel in the unit of the reconstruction, greater than 0; if not set,
    /// `voxel_size_px` applies. None.
    pub voxel_size: Option<f64>,
    /// Edge of a voxel relative to a pixel's size on the surface, greater than 0. 1.5.
    pub voxel_size_px: f64,
    /// Minimum number of triangles of a connected piece. 100.
    pub min_triangles: usize,
}

impl Default for MeshOptions {
    fn default() -> Self {
        Self {
            voxel_size: None,
            voxel_size_px: 1.5,
            min_triangles: 100,
        }
    }
}

impl MeshOptions {
    /// # Errors
    /// [`Error::OutOfRange`] for the first option outside its range.
    pub(super) fn check(&self) -> Result<()> {
        let is_size = |size: f64| size.is_finite() && size > 0.0;
        let size = self.voxel_size.unwrap_or(1.0);
        let size_px = self.voxel_size_px;
        Error::check_rules(&[
            (
                "the size of a voxel",
                "finite and greater than 0",
                size,
                is_size(size),
            ),
            (
                "the size of a voxel in pixels",
                "finite and greater than 0",
                size_px,
                is_size(size_px),
            ),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_outside_their_ranges_are_refused() {
        let of = MeshOptions::default;
        assert_eq!(of().check(), Ok(()));
        for options in [
            of().with_voxel_size(Some(0.0)),
            of().with_voxel_size(Some(f64::NAN)),
            of().with_voxel_size_px(-1.0),
            of().with_voxel_size_px(f64::INFINITY),
        ] {
            assert!(options.check().is_err(), "{options:?}");
        }
    }
}
