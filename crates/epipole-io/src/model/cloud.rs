//! The points of a model.

use super::Model;
use crate::cloud::write_ply;
use epipole::stereo::PointCloud;

impl Model {
    /// Returns the points with their colors.
    pub fn cloud(&self) -> PointCloud {
        PointCloud {
            points: self.points.iter().map(|point| point.position).collect(),
            colors: self.points.iter().map(|point| point.color).collect(),
            ..PointCloud::default()
        }
    }

    /// Writes the points with their colors as a binary little-endian PLY file.
    pub fn to_ply(&self) -> Vec<u8> {
        write_ply(&self.cloud())
    }
}
