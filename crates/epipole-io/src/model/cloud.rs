//! The points of a model.

use super::Model;
use crate::cloud::{ColoredPoint, write_ply};

impl Model {
    /// The points with their colors.
    pub fn cloud(&self) -> Vec<ColoredPoint> {
        let points = self.points.iter().map(|point| ColoredPoint {
            position: point.position,
            color: point.color,
        });
        points.collect()
    }

    /// The points with their colors as a binary little-endian PLY file.
    pub fn to_ply(&self) -> Vec<u8> {
        write_ply(&self.cloud())
    }
}
