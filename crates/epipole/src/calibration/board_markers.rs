//! The markers of a board.

use super::markers::MarkerDictionary;
use super::{Board, Pattern};
use core::f64::consts::SQRT_2;
use nalgebra::{Point2, Vector2};

/// Width of the black border of an AprilGrid's tags, bits: that of Kalibr.
const BORDER_OF_TAGS: usize = 2;
/// Width of the black border of a ChArUco board's markers, bits.
const BORDER_OF_CHARUCO: usize = 1;

/// Markers of a board.
pub(super) struct BoardMarkers {
    pub(super) dictionary: MarkerDictionary,
    /// Width of the black border.
    pub(super) border_bits: usize,
    /// Corners of each marker in squares, by number, clockwise from its first corner.
    pub(super) corners: Vec<[Point2<f64>; 4]>,
    /// Distance from a mark to the nearest edge other than its own two, squares.
    pub(super) clear: f64,
    /// Markers in the middle of bright squares.
    pub(super) insets: Option<MarkerInsets>,
}

/// Markers as dark squares in the middle of bright ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct MarkerInsets {
    /// Distance from the sides of the bright square, squares.
    pub(super) margin: f64,
    /// Distance from a mark to the nearest bit of a marker, squares.
    pub(super) clear: f64,
}

/// Returns the markers of a board; `None` for patterns without markers.
pub(super) fn board_markers(board: &Board) -> Option<BoardMarkers> {
    match board.pattern() {
        Pattern::Chessboard | Pattern::Circles | Pattern::AsymmetricCircles => None,
        Pattern::Charuco {
            dictionary,
            marker_ratio,
        } => {
            // Squares from one step before the first mark to one step behind the last.
            let squares =
                (0..=board.rows()).flat_map(|j| (0..=board.columns()).map(move |i| [i, j]));
            let white = squares.filter(|[i, j]| (i + j) % 2 == 1);
            let margin = 0.5 * (1.0 - marker_ratio);
            let corners = white.map(|[i, j]| {
                let first = Point2::new(i as f64 - 1.0 + margin, j as f64 - 1.0 + margin);
                square(first, marker_ratio)
            });
            let bit = marker_ratio / (dictionary.num_bits() + 2 * BORDER_OF_CHARUCO) as f64;
            let border = BORDER_OF_CHARUCO as f64 * bit;
            Some(BoardMarkers {
                dictionary,
                border_bits: BORDER_OF_CHARUCO,
                corners: corners.collect(),
                clear: SQRT_2 * margin,
                insets: Some(MarkerInsets {
                    margin,
                    clear: SQRT_2 * (margin + border),
                }),
            })
        }
        Pattern::AprilGrid { spacing } => {
            let (columns, rows) = (board.columns() / 2, board.rows() / 2);
            let tags = (0..rows)
                .rev()
                .flat_map(|j| (0..columns).map(move |i| 4 * j * columns + 2 * i));
            // OpenCV's markers are rotated by 180° from the drawn ones.
            let corners = tags.map(|mark| {
                let [a, b, c, d] = square(board.mark_in_squares(mark), 1.0);
                [c, d, a, b]
            });
            let dictionary = MarkerDictionary::AprilTag36h11;
            let num_cells = dictionary.num_bits() + 2 * BORDER_OF_TAGS;
            let first_bit = SQRT_2 * BORDER_OF_TAGS as f64 / num_cells as f64;
            Some(BoardMarkers {
                dictionary,
                border_bits: BORDER_OF_TAGS,
                corners: corners.collect(),
                clear: spacing.min(first_bit),
                insets: None,
            })
        }
    }
}

/// Returns the corners of a square, clockwise from the first.
fn square(first: Point2<f64>, side: f64) -> [Point2<f64>; 4] {
    [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(x, y)| first + Vector2::new(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The positions of the markers in `cv2.aruco.CharucoBoard((5, 4), 1, 0.5, …)`.
    #[test]
    fn charuco_markers_are_where_opencv_has_them() {
        let pattern = Pattern::Charuco {
            dictionary: MarkerDictionary::Aruco4x4_50,
            marker_ratio: 0.5,
        };
        let board = Board::new(pattern, 5, 4, 1.0).unwrap();
        let markers = board_markers(&board).unwrap();
        assert_eq!(markers.corners.len(), 10);
        // OpenCV's origin is the corner of the first square, a step before the first mark.
        let step = Vector2::new(1.0, 1.0);
        for (id, x, y) in [(0, 1.25, 0.25), (2, 0.25, 1.25), (9, 4.25, 3.25)] {
            assert_eq!(markers.corners[id][0] + step, Point2::new(x, y));
        }
    }

    #[test]
    fn tags_are_where_kalibr_has_them() {
        let board = Board::new(Pattern::AprilGrid { spacing: 0.25 }, 3, 2, 1.0).unwrap();
        let markers = board_markers(&board).unwrap();
        assert_eq!(markers.corners.len(), 6);
        // The first tag is at the bottom, the last one at the upper right.
        assert_eq!(markers.corners[0][2], Point2::new(0.0, 1.25));
        assert_eq!(markers.corners[5][0], Point2::new(3.5, 1.0));
        assert_eq!(markers.clear, 0.25);
    }
}
