//! A board for calibration, placed by its middle.

use epipole::calibration::Board;
use epipole::camera::RigidTransform;
use nalgebra::{Point3, Vector3};

/// Returns the pose of a board.
///
/// * `tilt`: rotation vector, radians; zero for a board square to the camera
/// * `middle`: middle of its marks in the camera's frame, meters
pub(crate) fn pose(board: &Board, tilt: Vector3<f64>, middle: &Point3<f64>) -> RigidTransform {
    let tilted = RigidTransform::rotation(tilt);
    let half = |count: usize| (count as f64 - 1.0) / 2.0 * board.square_m();
    // Marks are measured from the first corner.
    let middle_in_board = Vector3::new(half(board.columns()), half(board.rows()), 0.0);
    RigidTransform::from_parts(
        (middle.coords - tilted.rotation * middle_in_board).into(),
        tilted.rotation,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::calibration::Pattern;

    #[test]
    fn the_middle_of_the_marks_is_at_the_middle() {
        let board = Board::new(Pattern::Chessboard, 7, 5, 0.03).unwrap();
        let middle = Point3::new(0.1, -0.2, 0.6);
        let pose = pose(&board, Vector3::new(0.4, -0.3, 0.1), &middle);
        // The mark in the third of five rows, and in the fourth of seven columns.
        let mark = board.mark(2 * 7 + 3);
        let placed = pose * Point3::new(mark.x, mark.y, 0.0);
        assert!((placed - middle).norm() < 1e-12);
    }
}
