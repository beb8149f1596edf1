//! Profiles of lathed bodies.

use nalgebra::Vector2;

/// A profile under construction: (radius, height) from the bottom of the axis outward, upward and
/// back to the axis.
#[derive(Debug)]
pub(crate) struct Profile {
    pub(super) vertices: Vec<Vector2<f64>>,
    pub(super) sharp: Vec<bool>,
}

impl Profile {
    /// Starts on the axis, at height 0.
    pub(crate) fn new() -> Self {
        Self::from_height(0.0)
    }

    /// Starts on the axis at a height.
    pub(crate) fn from_height(height_m: f64) -> Self {
        Self {
            vertices: vec![Vector2::new(0.0, height_m)],
            sharp: vec![false],
        }
    }

    /// Adds a straight line to this radius and height.
    pub(crate) fn to(mut self, radius_m: f64, height_m: f64) -> Self {
        self.vertices.push(Vector2::new(radius_m, height_m));
        self.sharp.push(false);
        self
    }

    /// Returns the profile scaled by a factor.
    pub(crate) fn scaled(mut self, factor: f64) -> Self {
        for vertex in &mut self.vertices {
            *vertex *= factor;
        }
        self
    }

    /// Makes the last vertex an edge instead of part of a smooth curve.
    pub(crate) fn sharp(mut self) -> Self {
        if let Some(last) = self.sharp.last_mut() {
            *last = true;
        }
        self
    }
}
