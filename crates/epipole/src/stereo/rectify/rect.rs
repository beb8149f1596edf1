//! Rectangles of pixel coordinates.

use nalgebra::Vector2;

/// A rectangle of pixel coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelRect {
    /// Left end.
    pub u_min: f64,
    /// Upper end.
    pub v_min: f64,
    /// Right end.
    pub u_max: f64,
    /// Lower end.
    pub v_max: f64,
}

impl PixelRect {
    pub(super) fn of([u_min, u_max]: [f64; 2], [v_min, v_max]: [f64; 2]) -> Self {
        Self {
            u_min,
            v_min,
            u_max,
            v_max,
        }
    }

    /// Returns the range along x (0) or y (1).
    pub(super) fn range(&self, axis: usize) -> [f64; 2] {
        [[self.u_min, self.u_max], [self.v_min, self.v_max]][axis]
    }

    pub(crate) fn scaled(&self, factor: f64, offset: &Vector2<f64>) -> Self {
        Self {
            u_min: self.u_min * factor + offset.x,
            v_min: self.v_min * factor + offset.y,
            u_max: self.u_max * factor + offset.x,
            v_max: self.v_max * factor + offset.y,
        }
    }
}
