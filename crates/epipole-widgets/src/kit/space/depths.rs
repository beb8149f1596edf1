//! Coarse depth map of the surface points in a view, for hiding marks behind them.

use crate::canvas::Place;
use crate::contract::Rect;

/// Side of a cell, CSS pixels.
const CELL: f64 = 3.0;
/// Minimum relative distance behind the surface at which a mark is hidden.
const MARGIN: f64 = 0.012;

/// Minimum depths in cells of a panel.
pub(super) struct Depths {
    rect: Rect,
    columns: usize,
    nearest: Vec<f32>,
    is_empty: bool,
}

impl Depths {
    /// Creates an empty map for a panel.
    pub(super) fn new(rect: Rect) -> Self {
        let num_cells = |size: f64| (size / CELL).ceil().max(1.0) as usize;
        let (columns, rows) = (num_cells(rect.width), num_cells(rect.height));
        Self {
            rect,
            columns,
            nearest: vec![f32::INFINITY; columns * rows],
            is_empty: true,
        }
    }

    /// Returns whether there is no surface at all.
    pub(super) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Adds a point of a surface that covers `radius` CSS pixels around its position.
    pub(super) fn cover(&mut self, (x, y): Place, radius: f64, depth: f64) {
        let rows = self.nearest.len() / self.columns;
        let range = |middle: f64, start: f64, count: usize| {
            let first = ((middle - radius - start) / CELL).floor().max(0.0) as usize;
            let last = ((middle + radius - start) / CELL).floor();
            first..(last + 1.0).clamp(0.0, count as f64) as usize
        };
        let columns = range(x, self.rect.x, self.columns);
        for row in range(y, self.rect.y, rows) {
            for column in columns.clone() {
                let cell = &mut self.nearest[row * self.columns + column];
                *cell = cell.min(depth as f32);
            }
        }
        self.is_empty = false;
    }

    /// Returns whether the surface hides a mark at a position and depth.
    pub(super) fn hides(&self, (x, y): Place, depth: f64) -> bool {
        if !self.rect.contains((x, y)) {
            return false;
        }
        let column = ((x - self.rect.x) / CELL) as usize;
        let row = ((y - self.rect.y) / CELL) as usize;
        let cell = self
            .nearest
            .get(row * self.columns + column.min(self.columns - 1));
        cell.is_some_and(|nearest| f64::from(*nearest) < depth * (1.0 - MARGIN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_hides_what_is_behind_it_and_nothing_beside_it() {
        let mut depths = Depths::new(Rect::new(10.0, 20.0, 300.0, 200.0));
        assert!(depths.is_empty());
        depths.cover((100.0, 100.0), 4.0, 2.0);
        depths.cover((305.0, 215.0), 30.0, 2.0);
        assert!(!depths.is_empty());
        assert!(depths.hides((100.0, 100.0), 2.5) && depths.hides((103.0, 98.0), 2.5));
        assert!(depths.hides((309.9, 219.9), 2.5));
        // In front, in the surface, beside it, and outside the panel.
        assert!(!depths.hides((100.0, 100.0), 1.5));
        assert!(!depths.hides((100.0, 100.0), 2.01));
        assert!(!depths.hides((120.0, 100.0), 2.5));
        assert!(!depths.hides((0.0, 0.0), 2.5));
    }
}
