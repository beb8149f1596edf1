//! Points with integer coordinates in a distorted grid.

use nalgebra::Point2;
use std::collections::BTreeMap;

/// Grid coordinates.
pub(super) type Cell = (i32, i32);

/// Maximum distance of a point from its prediction, relative to a step: perspective and lenses bend
/// rows.
const MOST_STRAYED: f64 = 0.3;

/// Positions of points in a grid.
#[derive(Debug, Clone, Default)]
pub(super) struct Lattice {
    pub(super) points: BTreeMap<Cell, Point2<f64>>,
}

/// The extreme coordinates of a lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Extent {
    pub(super) least: Cell,
    pub(super) most: Cell,
}

impl Extent {
    /// Returns the number of cells along both axes.
    pub(super) fn size(&self) -> (usize, usize) {
        (
            (self.most.0 - self.least.0 + 1) as usize,
            (self.most.1 - self.least.1 + 1) as usize,
        )
    }
}

impl Lattice {
    pub(super) fn extent(&self) -> Option<Extent> {
        let mut cells = self.points.keys();
        let first = *cells.next()?;
        let mut extent = Extent {
            least: first,
            most: first,
        };
        for (i, j) in cells {
            extent.least = (extent.least.0.min(*i), extent.least.1.min(*j));
            extent.most = (extent.most.0.max(*i), extent.most.1.max(*j));
        }
        Some(extent)
    }

    /// Predicts the neighbor in a direction by continuing the previous two points or an adjacent
    /// row.
    pub(super) fn predict(&self, (i, j): Cell) -> Option<Point2<f64>> {
        let at = |di: i32, dj: i32| self.points.get(&(i + di, j + dj));
        let mut sum = nalgebra::Vector2::zeros();
        let mut count = 0.0;
        for (di, dj) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            if let (Some(near), Some(far)) = (at(di, dj), at(2 * di, 2 * dj)) {
                // A third point gives the rate at which steps shrink with distance.
                let step = match at(3 * di, 3 * dj) {
                    Some(farther) => (near - far) * 2.0 - (far - farther),
                    None => near - far,
                };
                sum += near.coords + step;
                count += 1.0;
            }
        }
        for (di, dj) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            if let (Some(a), Some(b), Some(corner)) = (at(di, 0), at(0, dj), at(di, dj)) {
                sum += a.coords + b.coords - corner.coords;
                count += 1.0;
            }
        }
        (count > 0.0).then(|| Point2::from(sum / count))
    }

    /// Returns the mean distance from a cell's point to its neighbors.
    pub(super) fn spacing(&self, (i, j): Cell, at: &Point2<f64>) -> Option<f64> {
        let (mut sum, mut count) = (0.0, 0.0);
        for (di, dj) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            if let Some(near) = self.points.get(&(i + di, j + dj)) {
                sum += (near - at).norm();
                count += 1.0;
            }
        }
        (count > 0.0).then(|| sum / count)
    }

    /// Returns the distance of a point from the prediction of its row and column, relative to a
    /// step; the lower median of all predictions.
    fn relative_deviation(&self, (i, j): Cell, place: &Point2<f64>) -> Option<f64> {
        let mut ratios = Vec::new();
        for (di, dj) in [(1, 0), (0, 1)] {
            let at = |s: i32| self.points.get(&(i + s * di, j + s * dj));
            if let (Some(a), Some(b)) = (at(-1), at(1)) {
                let step = 0.5 * (b - a).norm();
                ratios.push((nalgebra::center(a, b) - place).norm() / step);
            }
            for s in [1, -1] {
                if let (Some(near), Some(far)) = (at(s), at(2 * s)) {
                    let step = near - far;
                    ratios.push((near + step - place).norm() / step.norm());
                }
            }
        }
        ratios.sort_by(f64::total_cmp);
        let middle = ratios.len().checked_sub(1)? / 2;
        Some(ratios[middle])
    }

    /// Removes points far from the continuation of their rows and columns, and isolated points.
    pub(super) fn drop_strays(&mut self) {
        let strays: Vec<Cell> = self
            .points
            .iter()
            .filter(|(cell, place)| {
                self.relative_deviation(**cell, place)
                    .is_none_or(|ratio| ratio.is_nan() || ratio >= MOST_STRAYED)
            })
            .map(|(cell, _)| *cell)
            .collect();
        for cell in strays {
            self.points.remove(&cell);
        }
    }

    /// Returns the empty cells adjacent to filled ones, up to one step outside the grid.
    pub(super) fn open_cells(&self) -> Vec<Cell> {
        let mut open: Vec<Cell> = self
            .points
            .keys()
            .flat_map(|(i, j)| [(i + 1, *j), (i - 1, *j), (*i, j + 1), (*i, j - 1)])
            .filter(|cell| !self.points.contains_key(cell))
            .collect();
        open.sort_unstable();
        open.dedup();
        open
    }

    /// Returns the lattice in other axes.
    pub(super) fn mapped(&self, map: impl Fn(Cell) -> Cell) -> Self {
        Self {
            points: self
                .points
                .iter()
                .map(|(cell, place)| (map(*cell), *place))
                .collect(),
        }
    }
}
