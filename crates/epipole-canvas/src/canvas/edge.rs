//! Sides of polygons.

use super::place::At;

/// A side of a polygon.
pub(super) struct Edge {
    pub(super) upper: At,
    pub(super) lower: At,
    /// Columns to the right per row down.
    pub(super) slope: f32,
    /// 1 if it goes down, −1 if it goes up.
    pub(super) sign: f32,
}

impl Edge {
    pub(super) fn new(from: At, to: At) -> Self {
        let (sign, upper, lower) = match from.1 <= to.1 {
            true => (1.0, from, to),
            false => (-1.0, to, from),
        };
        Self {
            upper,
            lower,
            slope: (lower.0 - upper.0) / (lower.1 - upper.1),
            sign,
        }
    }
}
