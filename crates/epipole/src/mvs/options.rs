//! Options of multi-view stereo.

use crate::{Error, Result};
use derive_setters::Setters;

/// Maximum number of neighbors of a photo.
pub(super) const MAX_NEIGHBORS: usize = 16;

/// Options of multi-view stereo.
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct MvsOptions {
    /// Maximum longer side of photos, pixels; larger ones are downscaled. At least 32. 2048.
    pub max_size_px: u32,
    /// Number of neighbors with which each photo is compared, 1 to 16. 6.
    pub num_neighbors: usize,
    /// Number of neighbors used per pixel, the best ones; at least 1. 3.
    pub num_best_neighbors: usize,
    /// Minimum angle between the rays of two neighboring photos, the median over their common
    /// points, degrees. 1.
    pub min_angle_deg: f64,
    /// Number of rounds of propagation at each resolution after the coarsest, at least 1. 1.
    pub num_rounds: usize,
    /// Minimum weighted correlation of a depth, −1 to 1. 0.3.
    pub min_correlation: f64,
    /// Minimum number of photos that agree on a depth, including the photo itself; if a photo has
    /// fewer neighbors, all of them. At least 2. 3.
    pub min_views: usize,
    /// Maximum error of a pixel transferred to a neighbor by its depth and back by the neighbor's,
    /// pixels, greater than 0. 1.
    pub max_reprojection_error_px: f64,
    /// Maximum relative difference between the depths of two photos that agree. 0.01.
    pub max_depth_difference: f64,
    /// Maximum angle between the normals of two photos that agree, degrees. 30.
    pub max_normal_angle_deg: f64,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
}

impl Default for MvsOptions {
    fn default() -> Self {
        Self {
            max_size_px: 2048,
            num_neighbors: 6,
            num_best_neighbors: 3,
            min_angle_deg: 1.0,
            num_rounds: 1,
            min_correlation: 0.3,
            min_views: 3,
            max_reprojection_error_px: 1.0,
            max_depth_difference: 0.01,
            max_normal_angle_deg: 30.0,
            seed: 0,
        }
    }
}

impl MvsOptions {
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`] for the first option outside its range.
    pub(super) fn check(&self) -> Result<()> {
        for (what, value) in [
            ("the smallest angle between neighbors", self.min_angle_deg),
            ("the smallest correlation", self.min_correlation),
            (
                "the largest reprojection error",
                self.max_reprojection_error_px,
            ),
            (
                "the largest difference of depths",
                self.max_depth_difference,
            ),
            (
                "the largest angle between normals",
                self.max_normal_angle_deg,
            ),
        ] {
            if !value.is_finite() {
                return Err(Error::NotFinite { what });
            }
        }
        let count = |count: usize| count as f64;
        Error::check_rules(&[
            (
                "the longer side of the photos",
                "at least 32 pixels",
                f64::from(self.max_size_px),
                self.max_size_px >= 32,
            ),
            (
                "the number of neighbors",
                "1 to 16",
                count(self.num_neighbors),
                (1..=MAX_NEIGHBORS).contains(&self.num_neighbors),
            ),
            (
                "the number of neighbors that count at a pixel",
                "at least 1",
                count(self.num_best_neighbors),
                self.num_best_neighbors >= 1,
            ),
            (
                "the smallest angle between neighbors",
                "0 to 45°",
                self.min_angle_deg,
                (0.0..=45.0).contains(&self.min_angle_deg),
            ),
            (
                "the number of rounds",
                "1 to 100",
                count(self.num_rounds),
                (1..=100).contains(&self.num_rounds),
            ),
            (
                "the smallest correlation",
                "between −1 and 1",
                self.min_correlation,
                (-1.0..=1.0).contains(&self.min_correlation),
            ),
            (
                "the number of photos that agree",
                "at least 2",
                count(self.min_views),
                self.min_views >= 2,
            ),
            (
                "the largest reprojection error",
                "greater than 0 pixels",
                self.max_reprojection_error_px,
                self.max_reprojection_error_px > 0.0,
            ),
            (
                "the largest difference of depths",
                "greater than 0",
                self.max_depth_difference,
                self.max_depth_difference > 0.0,
            ),
            (
                "the largest angle between normals",
                "greater than 0°, and at most 180°",
                self.max_normal_angle_deg,
                self.max_normal_angle_deg > 0.0 && self.max_normal_angle_deg <= 180.0,
            ),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_outside_their_ranges_are_refused() {
        let of = MvsOptions::default;
        assert_eq!(of().check(), Ok(()));
        for options in [
            of().with_max_size_px(31),
            of().with_num_neighbors(0),
            of().with_num_neighbors(17),
            of().with_num_best_neighbors(0),
            of().with_min_angle_deg(f64::NAN),
            of().with_min_angle_deg(-1.0),
            of().with_num_rounds(0),
            of().with_min_correlation(1.5),
            of().with_min_views(1),
            of().with_max_reprojection_error_px(0.0),
            of().with_max_depth_difference(f64::INFINITY),
            of().with_max_normal_angle_deg(0.0),
        ] {
            assert!(options.check().is_err(), "{options:?}");
        }
    }
}
