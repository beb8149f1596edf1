//! Point clouds.

mod ply;

pub use ply::{read_ply, write_ply};

use nalgebra::Point3;

/// A point with a color.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColoredPoint {
    /// Position.
    pub position: Point3<f64>,
    /// Red, green, blue.
    pub color: [u8; 3],
}
