//! Point clouds, and pictures of models in space.

mod gltf;
mod ply;

pub use ply::{read_ply, write_ply};

use crate::model::Model;
use nalgebra::Point3;

/// A point with a color.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColoredPoint {
    /// Position.
    pub position: Point3<f64>,
    /// Red, green, blue.
    pub color: [u8; 3],
}

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
