//! Boards with marks at known places, and their images.

use crate::{Error, Result};
use nalgebra::Point2;

/// Pattern of a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// Black and white squares; the marks are the inner corners, where four squares meet.
    #[default]
    Chessboard,
    /// Dark disks, every second row shifted by half of the distance between neighbors; the marks
    /// are their centers.
    AsymmetricCircles,
}

/// A flat board with marks at known places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Board {
    pattern: Pattern,
    columns: usize,
    rows: usize,
    square_m: f64,
}

impl Board {
    /// A board.
    ///
    /// * `columns`, `rows`: marks, so of a chessboard one less than squares; of a circle grid,
    ///   disks in a row and rows
    /// * `square_m`: the side of a square, or the distance of two rows of a circle grid, meters
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than 3 × 3 marks or more than 1000 along a side, and for a
    /// length that is not above 0; a circle grid needs 2 columns only.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::{Board, Pattern};
    /// let board = Board::new(Pattern::Chessboard, 9, 6, 0.025)?;
    /// assert_eq!(board.num_marks(), 54);
    /// assert_eq!(board.mark(10), nalgebra::Point2::new(0.025, 0.025));
    /// // The disks of the second row stand between those of the first.
    /// let grid = Board::new(Pattern::AsymmetricCircles, 4, 11, 0.02)?;
    /// assert_eq!(grid.mark(4), nalgebra::Point2::new(0.02, 0.02));
    /// # Ok(()) }
    /// ```
    pub fn new(pattern: Pattern, columns: usize, rows: usize, square_m: f64) -> Result<Self> {
        let fewest_columns = match pattern {
            Pattern::Chessboard => 3,
            Pattern::AsymmetricCircles => 2,
        };
        for (what, value, fewest) in [
            ("the number of a board's columns", columns, fewest_columns),
            ("the number of a board's rows", rows, 3),
        ] {
            if !(fewest..=1000).contains(&value) {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "from 3 (a circle grid's columns from 2) to 1000",
                    value: value as f64,
                });
            }
        }
        if !(square_m > 0.0 && square_m.is_finite()) {
            return Err(Error::OutOfRange {
                what: "the side of a board's squares in meters",
                requirement: "greater than 0",
                value: square_m,
            });
        }
        Ok(Self {
            pattern,
            columns,
            rows,
            square_m,
        })
    }

    /// Its pattern.
    pub fn pattern(&self) -> Pattern {
        self.pattern
    }

    /// Marks in a row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Rows of marks.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The side of a square, meters.
    pub fn square_m(&self) -> f64 {
        self.square_m
    }

    /// Number of marks.
    pub fn num_marks(&self) -> usize {
        self.columns * self.rows
    }

    /// The place of a mark on the board, meters. Marks are counted row by row.
    pub fn mark(&self, index: usize) -> Point2<f64> {
        let (row, column) = (index / self.columns, index % self.columns);
        let x = match self.pattern {
            Pattern::Chessboard => column,
            Pattern::AsymmetricCircles => 2 * column + row % 2,
        };
        Point2::new(x as f64, row as f64) * self.square_m
    }
}

/// Marks of a board seen in one photograph.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardView {
    /// For each mark of the board, row by row, its pixel, or `None` where something hides it.
    pub pixels: Vec<Option<Point2<f64>>>,
}

impl BoardView {
    /// The marks that are seen, each with its pixel.
    pub fn seen(&self) -> impl Iterator<Item = (usize, Point2<f64>)> + '_ {
        let marks = self.pixels.iter().enumerate();
        marks.filter_map(|(mark, pixel)| pixel.map(|pixel| (mark, pixel)))
    }

    /// Number of marks seen.
    pub fn num_seen(&self) -> usize {
        self.seen().count()
    }

    /// Whether all marks are seen.
    pub(super) fn is_whole(&self) -> bool {
        self.pixels.iter().all(Option::is_some)
    }

    /// Distance from a mark to its nearest neighbor; `None` if no neighbor is seen.
    pub(super) fn spacing(&self, mark: usize, columns: usize) -> Option<f64> {
        let here = self.pixels[mark]?;
        let (column, row) = (mark % columns, mark / columns);
        self.seen()
            .filter(|(other, _)| {
                (other % columns).abs_diff(column) + (other / columns).abs_diff(row) == 1
            })
            .map(|(_, pixel)| (pixel - here).norm())
            .min_by(f64::total_cmp)
    }

    /// The pixels of the mark's neighbors, previous and next: along its row, then along its column.
    pub(super) fn beside(&self, mark: usize, columns: usize) -> [[Option<Point2<f64>>; 2]; 2] {
        let at = |inside: bool, index: usize| {
            let pixel = || self.pixels.get(index).copied().flatten();
            inside.then(pixel).flatten()
        };
        let (column, row) = (mark % columns, mark / columns);
        [
            [
                at(column > 0, mark.wrapping_sub(1)),
                at(column + 1 < columns, mark + 1),
            ],
            [
                at(row > 0, mark.wrapping_sub(columns)),
                at(true, mark + columns),
            ],
        ]
    }

    /// Refuses views that are not of this board.
    pub(super) fn check(&self, board: &Board) -> Result<()> {
        if self.pixels.len() != board.num_marks() {
            return Err(Error::SizeMismatch {
                what: "the board's marks and a view's pixels",
                first: board.num_marks(),
                second: self.pixels.len(),
            });
        }
        if !self.seen().all(|(_, p)| p.x.is_finite() && p.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the pixel of a board's mark",
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absurd_boards_are_refused() {
        for (columns, rows, square_m) in [
            (2, 6, 1.0),
            (9, 0, 1.0),
            (9, 6, 0.0),
            (9, 6, f64::NAN),
            (9, 1001, 1.0),
        ] {
            assert!(Board::new(Pattern::Chessboard, columns, rows, square_m).is_err());
        }
        assert!(Board::new(Pattern::AsymmetricCircles, 1, 6, 1.0).is_err());
    }
}
