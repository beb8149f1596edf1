//! Result of a search for a board.

use super::{Board, BoardView};

/// Minimum fraction of visible marks of a grid that is not accidental.
const WHOLE: f64 = 0.8;
/// Ratio of marks above which a grid is a different one, not the same with a stray corner.
const MORE: f64 = 1.25;

/// Result of a search for a board.
#[derive(Debug, Clone, PartialEq)]
pub enum BoardSearch {
    /// The marks of the board.
    Found(BoardView),
    /// An incomplete grid: part of the board is outside the image or hidden, or the grid has
    /// another size.
    Partial {
        /// Number of marks along the longer side.
        columns: usize,
        /// Number of marks along the shorter side.
        rows: usize,
        /// Number of visible marks.
        num_visible: usize,
    },
    /// Markers, but too few marks of the board, or not in the arrangement of the board.
    Markers {
        /// Number of markers in the arrangement of the board.
        num_of_board: usize,
        /// Number of other markers of the dictionary.
        num_others: usize,
    },
    /// Nothing similar.
    Nothing,
}

impl BoardSearch {
    /// Returns the view, if the board was found.
    pub fn view(self) -> Option<BoardView> {
        match self {
            Self::Found(view) => Some(view),
            _ => None,
        }
    }

    /// Returns the reason why there is no view, as a sentence; `None` if there is one.
    pub fn problem(&self, board: &Board) -> Option<String> {
        let (columns, rows) = (board.columns(), board.rows());
        match self {
            Self::Found(_) => None,
            Self::Nothing if board.pattern().has_markers() => Some(
                "no marker was found: is the dictionary another, or the picture blurred? Each marker needs a white margin"
                    .to_owned(),
            ),
            &Self::Markers {
                num_of_board,
                num_others,
            } => Some(markers_problem(num_of_board, num_others)),
            Self::Nothing => Some(format!(
                "no board of {columns} × {rows} marks was found: it must be whole in the picture, sharp, and with a \
                 margin around it"
            )),
            Self::Partial {
                columns: found_columns,
                rows: found_rows,
                num_visible,
            } => {
                let larger = *found_columns > columns.max(rows) || *found_rows > columns.min(rows);
                let why = if larger {
                    "the board is of another size, or something beside it looks alike: count its marks once more, or cover \
                     what is beside it"
                } else {
                    "a part is outside of the picture or hidden, or the board is of another size: show more of it, or count its \
                     marks once more"
                };
                Some(format!(
                    "a grid of {found_columns} × {found_rows} with {num_visible} marks was found, not {columns} × {rows}: {why}"
                ))
            }
        }
    }

    /// Discards accidental grids: corners of other objects also form rows, but a real grid has at
    /// least two rows and columns, and half of it is visible.
    pub(super) fn unless_accidental(self) -> Self {
        match self {
            Self::Partial {
                columns,
                rows,
                num_visible,
            } if columns.min(rows) < 2 || 2 * num_visible < columns * rows => Self::Nothing,
            search => search,
        }
    }

    /// Returns whether this is a complete grid larger than the board, so that a partial view of the
    /// board is a false match in texture: the board then has another size.
    pub(super) fn outdoes(&self, view: &BoardView, board: &Board) -> bool {
        let &Self::Partial {
            columns,
            rows,
            num_visible,
        } = self
        else {
            return false;
        };
        let (longer, shorter) = (board.columns(), board.rows());
        let is_larger = columns > longer.max(shorter) || rows > longer.min(shorter);
        let is_whole = num_visible as f64 >= WHOLE * (columns * rows) as f64;
        is_larger
            && is_whole
            && num_visible as f64 >= MORE * view.num_visible() as f64
            && !view.is_whole()
    }

    /// Returns the result with more marks.
    pub(super) fn or_more(self, other: Self) -> Self {
        let num_visible = |search: &Self| match search {
            Self::Found(view) => usize::MAX - view.pixels.len() + view.num_visible(),
            Self::Partial { num_visible, .. } => *num_visible,
            Self::Markers { num_of_board, .. } => *num_of_board,
            Self::Nothing => 0,
        };
        if num_visible(&other) > num_visible(&self) {
            other
        } else {
            self
        }
    }
}

fn markers_problem(num_of_board: usize, num_others: usize) -> String {
    if num_others > num_of_board {
        format!(
            "{} markers were found, but only {num_of_board} of them stand as on this board: count its squares or tags once more, \
             and compare its upper left square with one that `epipole board` draws",
            num_of_board + num_others
        )
    } else {
        format!(
            "{num_of_board} of the board's markers were found, but too few of its corners: show more of it, larger or sharper"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::Pattern;
    use super::*;
    use nalgebra::Point2;

    #[test]
    fn a_few_corners_in_a_row_are_no_board_of_another_size() {
        let search = |columns, rows, num_visible| {
            BoardSearch::Partial {
                columns,
                rows,
                num_visible,
            }
            .unless_accidental()
        };
        // As in images of other objects.
        for (columns, rows, num_visible) in [(15, 11, 9), (3, 1, 3)] {
            assert_eq!(search(columns, rows, num_visible), BoardSearch::Nothing);
        }
        // A board whose last column is outside the image.
        assert_ne!(search(8, 6, 41), BoardSearch::Nothing);
    }

    #[test]
    fn a_whole_larger_grid_outdoes_part_of_a_board() {
        let board = Board::new(Pattern::Chessboard, 7, 6, 0.025).unwrap();
        let view = |num_visible: usize| BoardView {
            pixels: (0..42)
                .map(|n| (n < num_visible).then(|| Point2::new(n as f64, 0.0)))
                .collect(),
        };
        let grid = |columns, rows, num_visible| BoardSearch::Partial {
            columns,
            rows,
            num_visible,
        };
        assert!(grid(9, 6, 54).outdoes(&view(38), &board));
        assert!(grid(9, 7, 55).outdoes(&view(38), &board));
        // The board is complete; the other grid has gaps, so it is no board, or has hardly more
        // marks, or fewer.
        assert!(!grid(9, 6, 54).outdoes(&view(42), &board));
        assert!(!grid(9, 7, 49).outdoes(&view(38), &board));
        assert!(!grid(8, 6, 48).outdoes(&view(41), &board));
        assert!(!grid(8, 4, 32).outdoes(&view(38), &board));
        assert!(!grid(7, 5, 35).outdoes(&view(30), &board));
        assert!(!BoardSearch::Nothing.outdoes(&view(38), &board));
    }
}
