//! Rotations that leave the appearance of a board unchanged.

use super::{Board, BoardView, Pattern};
use crate::camera::RigidTransform;
use core::f64::consts::FRAC_PI_2;
use nalgebra::{Translation3, Vector3};

/// Rotation of a board in its plane that leaves its appearance unchanged.
pub(super) struct BoardSymmetry {
    /// For each mark of the rotated board, the mark previously at this position.
    mark_before: Vec<usize>,
    /// `x_in_board = board_from_rotated * x_in_turned`.
    pub(super) board_from_rotated: RigidTransform,
}

impl BoardSymmetry {
    /// Returns the same view, with marks numbered on the rotated board.
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

/// Returns the rotations of a board, starting with the identity.
///
/// Chessboard colors are invariant under 180° rotation if the numbers of columns and rows of
/// corners are both even or both odd, and under 90° if they are equal and even. Circle grids are
/// invariant under 180°. Boards with markers have no such symmetry.
pub(super) fn board_symmetries(board: &Board) -> Vec<BoardSymmetry> {
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
    let symmetry = |&quarters: &usize| {
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
        BoardSymmetry {
            mark_before: (0..board.num_marks()).map(before).collect(),
            board_from_rotated: RigidTransform::from_parts(Translation3::from(shift), rotation),
        }
    };
    quarters.iter().map(symmetry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn marks_are_where_the_rotation_moves_them() {
        for (columns, rows, num) in [(9, 6, 1), (7, 5, 2), (8, 6, 2), (6, 6, 4), (7, 7, 2)] {
            let board = Board::new(Pattern::Chessboard, columns, rows, 0.03).unwrap();
            let symmetries = board_symmetries(&board);
            assert_eq!(symmetries.len(), num, "{columns} × {rows}");
            for symmetry in symmetries {
                for (mark, &before) in symmetry.mark_before.iter().enumerate() {
                    let [from, to] = [mark, before].map(|mark| {
                        let place = board.mark(mark);
                        Point3::new(place.x, place.y, 0.0)
                    });
                    assert!((symmetry.board_from_rotated * from - to).norm() < 1e-12);
                }
            }
        }
    }
}
