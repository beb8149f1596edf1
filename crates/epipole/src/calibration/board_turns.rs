//! Turns after which a board looks the same.

use super::{Board, BoardView, Pattern};
use crate::camera::RigidTransform;
use core::f64::consts::FRAC_PI_2;
use nalgebra::{Translation3, Vector3};

/// A turn of a board in its plane that no photograph shows.
pub(super) struct BoardTurn {
    /// For each mark of the turned board, the mark that is there before.
    mark_before: Vec<usize>,
    /// `x_in_board = board_from_turned * x_in_turned`.
    pub(super) board_from_turned: RigidTransform,
}

impl BoardTurn {
    /// The same view, its marks counted on the turned board.
    pub(super) fn view(&self, view: &BoardView) -> BoardView {
        BoardView {
            pixels: self
                .mark_before
                .iter()
                .map(|&mark| view.pixels[mark])
                .collect(),
        }
    }
}

/// The turns of a board; the first one is none.
///
/// Colors of squares are kept by half a turn if columns and rows of corners are both even or both
/// odd, and by a quarter if they are equal and even. Circles in rows and columns are kept by half a
/// turn. Markers tell every turn.
pub(super) fn board_turns(board: &Board) -> Vec<BoardTurn> {
    let (columns, rows) = (board.columns(), board.rows());
    let quarters: &[usize] = match board.pattern() {
        Pattern::AsymmetricCircles | Pattern::Charuco { .. } | Pattern::AprilGrid { .. } => &[0],
        Pattern::Circles if columns == rows => &[0, 1, 2, 3],
        Pattern::Circles => &[0, 2],
        Pattern::Chessboard if columns % 2 != rows % 2 => &[0],
        Pattern::Chessboard if columns == rows && columns % 2 == 0 => &[0, 1, 2, 3],
        Pattern::Chessboard => &[0, 2],
    };
    let (last_column, last_row) = (columns - 1, rows - 1);
    let middle = Vector3::new(last_column as f64, last_row as f64, 0.0) * (0.5 * board.square_m());
    let turn = |&quarters: &usize| {
        let before = |mark: usize| {
            let (row, column) = (mark / columns, mark % columns);
            let (row, column) = match quarters {
                0 => (row, column),
                1 => (column, last_column - row),
                2 => (last_row - row, last_column - column),
                _ => (last_row - column, row),
            };
            row * columns + column
        };
        let angle = Vector3::z() * (quarters as f64 * FRAC_PI_2);
        let rotation = RigidTransform::new(Vector3::zeros(), angle).rotation;
        let shift = middle - rotation * middle;
        BoardTurn {
            mark_before: (0..board.num_marks()).map(before).collect(),
            board_from_turned: RigidTransform::from_parts(Translation3::from(shift), rotation),
        }
    };
    quarters.iter().map(turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn marks_are_where_the_turn_brings_them() {
        for (columns, rows, num) in [(9, 6, 1), (7, 5, 2), (8, 6, 2), (6, 6, 4), (7, 7, 2)] {
            let board = Board::new(Pattern::Chessboard, columns, rows, 0.03).unwrap();
            let turns = board_turns(&board);
            assert_eq!(turns.len(), num, "{columns} × {rows}");
            for turn in turns {
                for (mark, &before) in turn.mark_before.iter().enumerate() {
                    let [from, to] = [mark, before].map(|mark| {
                        let place = board.mark(mark);
                        Point3::new(place.x, place.y, 0.0)
                    });
                    assert!((turn.board_from_turned * from - to).norm() < 1e-12);
                }
            }
        }
    }
}
