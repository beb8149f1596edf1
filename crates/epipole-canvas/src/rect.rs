//! Rectangles on a picture.

use serde::Serialize;

/// An axis-parallel rectangle in CSS pixels, origin at the picture's top left corner, y down.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Top edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// Creates a rectangle from its top left corner and size.
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self {
            x,
            y,
            width,
            height,
        }
    }

    /// Creates a square around its center, `half` to each side.
    pub fn around((x, y): (f64, f64), half: f64) -> Self {
        Self::new(x - half, y - half, 2.0 * half, 2.0 * half)
    }

    /// Returns the corners in order, the upper left one first.
    pub fn corners(&self) -> [(f64, f64); 4] {
        let (left, top, right, bottom) = (self.x, self.y, self.right(), self.bottom());
        [(left, top), (right, top), (right, bottom), (left, bottom)]
    }

    /// Right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Bottom edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Center.
    pub fn center(&self) -> (f64, f64) {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }

    /// Whether a point is inside or on the edge.
    pub fn contains(&self, (x, y): (f64, f64)) -> bool {
        (self.x..=self.right()).contains(&x) && (self.y..=self.bottom()).contains(&y)
    }

    /// Shrinks the rectangle by a margin on every side, never to a negative size.
    pub fn inset(&self, margin: f64) -> Self {
        Self::new(
            self.x + margin,
            self.y + margin,
            (self.width - 2.0 * margin).max(0.0),
            (self.height - 2.0 * margin).max(0.0),
        )
    }
}
