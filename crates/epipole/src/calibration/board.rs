//! Boards with marks at known positions, and their images.

use super::markers::MarkerDictionary;
use crate::{Error, Result};
use nalgebra::Point2;

/// Pattern of a board.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Pattern {
    /// Black and white squares; the marks are the inner corners, where four squares meet.
    #[default]
    Chessboard,
    /// Dark disks in rows and columns; the marks are their centers.
    Circles,
    /// Dark disks, every second row shifted by half the distance between neighbors; the marks are
    /// their centers.
    AsymmetricCircles,
    /// A chessboard with markers in its white squares, numbered row by row; the marks are the inner
    /// corners. The upper left square is black, as in OpenCV since 4.6 (no `legacyPattern`).
    Charuco {
        /// Dictionary of the markers.
        dictionary: MarkerDictionary,
        /// Ratio of the sides of marker and square, below 1.
        marker_ratio: f64,
    },
    /// AprilTags 36h11 with a border of two bits and black squares between their corners, as in
    /// Kalibr; the marks are the corners of the tags. The first tag is the lower left one.
    AprilGrid {
        /// Distance between tags, relative to their side.
        spacing: f64,
    },
}

impl Pattern {
    /// Returns whether markers identify its marks, so that a part of a board suffices.
    pub(super) fn has_markers(self) -> bool {
        matches!(self, Self::Charuco { .. } | Self::AprilGrid { .. })
    }

    /// Returns the numbers of columns and rows of marks.
    ///
    /// * `columns`, `rows`: as in [`Board::new`]
    fn marks(self, columns: usize, rows: usize) -> (usize, usize) {
        match self {
            Self::Charuco { .. } => (columns.saturating_sub(1), rows.saturating_sub(1)),
            Self::AprilGrid { .. } => (2 * columns, 2 * rows),
            _ => (columns, rows),
        }
    }

    /// Returns the minimum numbers of columns and rows.
    fn fewest(self) -> (usize, usize) {
        match self {
            Self::AsymmetricCircles => (2, 3),
            Self::AprilGrid { .. } => (1, 1),
            _ => (3, 3),
        }
    }
}

/// A flat board with marks at known positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Board {
    pattern: Pattern,
    columns: usize,
    rows: usize,
    square_m: f64,
}

impl Board {
    /// Creates a board.
    ///
    /// * `columns`, `rows`: inner corners of a chessboard, one less than its squares; squares of a
    ///   ChArUco board; tags of an AprilGrid; disks per row and rows of a circle grid
    /// * `square_m`: side of a square or tag, or distance between two rows of a circle grid, meters
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size below 3 × 3 or above 1000 along a side, for a length that
    /// is not above 0, for more markers than the dictionary has, for a marker ratio that is not
    /// between 0 and 1, and a spacing that is not above 0 and at most 1. A grid with shifted disks
    /// needs only 2 columns, an AprilGrid only one tag.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::{Board, MarkerDictionary, Pattern};
    /// use nalgebra::Point2;
    /// let board = Board::new(Pattern::Chessboard, 9, 6, 0.025)?;
    /// assert_eq!(board.num_marks(), 54);
    /// assert_eq!(board.mark(10), Point2::new(0.025, 0.025));
    /// // The disks of the second row are between those of the first.
    /// let grid = Board::new(Pattern::AsymmetricCircles, 4, 11, 0.02)?;
    /// assert_eq!(grid.mark(4), Point2::new(0.02, 0.02));
    /// // 7 × 5 squares have 6 × 4 inner corners and 17 markers.
    /// let dictionary = MarkerDictionary::Aruco4x4_50;
    /// let charuco = Board::new(Pattern::Charuco { dictionary, marker_ratio: 0.75 }, 7, 5, 0.03)?;
    /// assert_eq!((charuco.columns(), charuco.rows()), (6, 4));
    /// // Tags of 8 cm at distances of 2 cm: the third corner is that of the second tag.
    /// let tags = Board::new(Pattern::AprilGrid { spacing: 0.25 }, 6, 6, 0.08)?;
    /// assert_eq!((tags.num_marks(), tags.mark(2)), (144, Point2::new(0.1, 0.0)));
    /// # Ok(()) }
    /// ```
    pub fn new(pattern: Pattern, columns: usize, rows: usize, square_m: f64) -> Result<Self> {
        let fewest = pattern.fewest();
        for (what, value, fewest) in [
            ("the number of a board's columns", columns, fewest.0),
            ("the number of a board's rows", rows, fewest.1),
        ] {
            if !(fewest..=1000).contains(&value) {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "from 3 (shifted circles: 2 columns, AprilGrid: 1) to 1000",
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
        check_markers(pattern, columns, rows)?;
        let (columns, rows) = pattern.marks(columns, rows);
        Ok(Self {
            pattern,
            columns,
            rows,
            square_m,
        })
    }

    /// Returns the pattern.
    pub fn pattern(&self) -> Pattern {
        self.pattern
    }

    /// Returns the number of marks per row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Returns the number of rows of marks.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the side of a square or tag, or the distance between two rows of disks, meters.
    pub fn square_m(&self) -> f64 {
        self.square_m
    }

    /// Returns the number of marks.
    pub fn num_marks(&self) -> usize {
        self.columns * self.rows
    }

    /// Returns the position of a mark on the board, meters. Marks are numbered row by row.
    pub fn mark(&self, index: usize) -> Point2<f64> {
        self.mark_in_squares(index) * self.square_m
    }

    /// Returns the position of a mark, in squares.
    pub(super) fn mark_in_squares(&self, index: usize) -> Point2<f64> {
        let (row, column) = (index / self.columns, index % self.columns);
        match self.pattern {
            Pattern::Chessboard | Pattern::Circles | Pattern::Charuco { .. } => {
                Point2::new(column as f64, row as f64)
            }
            Pattern::AsymmetricCircles => Point2::new((2 * column + row % 2) as f64, row as f64),
            Pattern::AprilGrid { spacing } => {
                let along = |k: usize| (k / 2) as f64 * (1.0 + spacing) + (k % 2) as f64;
                Point2::new(along(column), along(row))
            }
        }
    }
}

/// Rejects patterns whose markers do not fit or are too many.
fn check_markers(pattern: Pattern, columns: usize, rows: usize) -> Result<()> {
    let (dictionary, num_markers) = match pattern {
        Pattern::Charuco {
            dictionary,
            marker_ratio,
        } => {
            if !(marker_ratio > 0.0 && marker_ratio < 1.0) {
                return Err(Error::OutOfRange {
                    what: "the ratio of a board's marker side to its square side",
                    requirement: "between 0 and 1",
                    value: marker_ratio,
                });
            }
            (dictionary, columns * rows / 2)
        }
        Pattern::AprilGrid { spacing } => {
            if !(spacing > 0.0 && spacing <= 1.0) {
                return Err(Error::OutOfRange {
                    what: "the ratio of the gap between a board's tags to their side",
                    requirement: "greater than 0 and at most 1",
                    value: spacing,
                });
            }
            (MarkerDictionary::AprilTag36h11, columns * rows)
        }
        Pattern::Chessboard | Pattern::Circles | Pattern::AsymmetricCircles => return Ok(()),
    };
    if num_markers > dictionary.num_markers() {
        return Err(Error::OutOfRange {
            what: "the number of a board's markers",
            requirement: "at most that of the dictionary",
            value: num_markers as f64,
        });
    }
    Ok(())
}

/// Marks of a board seen in one image.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardView {
    /// For each mark of the board, row by row, its pixel, or `None` if not visible.
    pub pixels: Vec<Option<Point2<f64>>>,
}

impl BoardView {
    /// Iterates over the visible marks with their pixels.
    pub fn visible(&self) -> impl Iterator<Item = (usize, Point2<f64>)> + '_ {
        let marks = self.pixels.iter().enumerate();
        marks.filter_map(|(mark, pixel)| pixel.map(|pixel| (mark, pixel)))
    }

    /// Returns the number of visible marks.
    pub fn num_visible(&self) -> usize {
        self.visible().count()
    }

    /// Returns whether all marks are visible.
    pub(super) fn is_whole(&self) -> bool {
        self.pixels.iter().all(Option::is_some)
    }

    /// Returns the distance from a mark to its nearest neighbor; `None` if no neighbor is visible.
    pub(super) fn spacing(&self, mark: usize, columns: usize) -> Option<f64> {
        let here = self.pixels[mark]?;
        let (column, row) = (mark % columns, mark / columns);
        self.visible()
            .filter(|(other, _)| {
                (other % columns).abs_diff(column) + (other / columns).abs_diff(row) == 1
            })
            .map(|(_, pixel)| (pixel - here).norm())
            .min_by(f64::total_cmp)
    }

    /// Returns the pixels of the mark's neighbors, previous and next: along its row, then along its
    /// column.
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

    /// Rejects views of another board.
    pub(super) fn check(&self, board: &Board) -> Result<()> {
        if self.pixels.len() != board.num_marks() {
            return Err(Error::SizeMismatch {
                what: "the board's marks and a view's pixels",
                first: board.num_marks(),
                second: self.pixels.len(),
            });
        }
        if !self
            .visible()
            .all(|(_, p)| p.x.is_finite() && p.y.is_finite())
        {
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
        let charuco = |marker_ratio: f64| Pattern::Charuco {
            dictionary: MarkerDictionary::Aruco4x4_50,
            marker_ratio,
        };
        assert!(Board::new(charuco(0.75), 10, 10, 1.0).is_ok());
        // 60 markers.
        assert!(Board::new(charuco(0.75), 12, 10, 1.0).is_err());
        assert!(Board::new(charuco(1.0), 7, 5, 1.0).is_err());
        assert!(Board::new(charuco(f64::NAN), 7, 5, 1.0).is_err());
        for spacing in [0.0, -0.3, 1.1, f64::NAN] {
            assert!(Board::new(Pattern::AprilGrid { spacing }, 6, 6, 1.0).is_err());
        }
        assert!(Board::new(Pattern::AprilGrid { spacing: 0.3 }, 25, 24, 1.0).is_err());
    }
}
