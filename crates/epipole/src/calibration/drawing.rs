//! Drawings of boards as black shapes on white.

use super::board_markers::{BoardMarkers, board_markers};
use super::{Board, Pattern};
use nalgebra::{Point2, Vector2};

/// Radius of a disk in a grid with shifted rows, squares.
const SHIFTED_DISK: f64 = 0.45;
/// Radius of a disk in a grid with aligned rows, squares.
const DISK: f64 = 0.3;

/// Black shapes of a board, without overlaps. The unit is a square of the board: multiply by
/// [`Board::square_m`] for meters. The first mark is at the origin, y points down.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BoardDrawing {
    /// Upper left and lower right corner of each rectangle.
    pub rectangles: Vec<[Point2<f64>; 2]>,
    /// Centers of disks.
    pub disks: Vec<Point2<f64>>,
    /// Radius of the disks.
    pub disk_radius: f64,
}

impl Board {
    /// Returns the black shapes of the board.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::{Board, Pattern};
    /// // 4 × 4 squares, half of them black, including the first.
    /// let drawing = Board::new(Pattern::Chessboard, 3, 3, 0.02)?.drawing();
    /// assert_eq!(drawing.rectangles.len(), 8);
    /// assert_eq!(drawing.rectangles[0][1], nalgebra::Point2::origin());
    /// # Ok(()) }
    /// ```
    pub fn drawing(&self) -> BoardDrawing {
        let mut drawing = BoardDrawing::default();
        match self.pattern() {
            Pattern::Chessboard | Pattern::Charuco { .. } => {
                // The first square ends at the first corner.
                for j in -1..self.rows() as i32 {
                    let black = (-1..self.columns() as i32).filter(|i| (i + j) % 2 == 0);
                    let first = black.map(|i| Point2::new(f64::from(i), f64::from(j)));
                    let squares = first.map(|p| [p, p + Vector2::new(1.0, 1.0)]);
                    drawing.rectangles.extend(squares);
                }
            }
            Pattern::AprilGrid { spacing } => {
                drawing.rectangles = squares_between_tags(self, spacing);
            }
            Pattern::Circles | Pattern::AsymmetricCircles => {
                drawing.disks = (0..self.num_marks())
                    .map(|mark| self.mark_in_squares(mark))
                    .collect();
                drawing.disk_radius = match self.pattern() {
                    Pattern::Circles => DISK,
                    _ => SHIFTED_DISK,
                };
            }
        }
        if let Some(markers) = board_markers(self) {
            for id in 0..markers.corners.len() {
                drawing.rectangles.extend(black_of_marker(&markers, id));
            }
        }
        drawing
    }
}

/// Returns the black squares at the corners of the tags.
fn squares_between_tags(board: &Board, spacing: f64) -> Vec<[Point2<f64>; 2]> {
    let (columns, rows) = (board.columns() / 2, board.rows() / 2);
    let first = |k: usize| k as f64 * (1.0 + spacing) - spacing;
    let all = (0..=rows).flat_map(|j| (0..=columns).map(move |i| Point2::new(first(i), first(j))));
    all.map(|p| [p, p + Vector2::new(spacing, spacing)])
        .collect()
}

/// Returns the black rectangles of a marker.
fn black_of_marker(markers: &BoardMarkers, id: usize) -> Vec<[Point2<f64>; 2]> {
    let border = markers.border_bits;
    let side = markers.dictionary.num_bits() + 2 * border;
    let [a, b, _, d] = markers.corners[id];
    let (right, down) = ((b - a) / side as f64, (d - a) / side as f64);
    let corner = |[i, j]: [usize; 2]| a + right * i as f64 + down * j as f64;
    let cells = markers.dictionary.black_cells(id, border);
    let corners = cells.into_iter().flatten().map(|ends| ends.map(corner));
    corners.map(|[p, q]| [p.inf(&q), p.sup(&q)]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::MarkerDictionary;
    use super::*;

    fn black_area(drawing: &BoardDrawing) -> f64 {
        let area = |[a, b]: &[Point2<f64>; 2]| (b.x - a.x) * (b.y - a.y);
        drawing.rectangles.iter().map(area).sum()
    }

    #[test]
    fn markers_have_their_black_cells() {
        let pattern = Pattern::Charuco {
            dictionary: MarkerDictionary::Aruco4x4_50,
            marker_ratio: 0.75,
        };
        let board = Board::new(pattern, 3, 3, 1.0).unwrap();
        let white_bits: usize = (0..4)
            .flat_map(|id| (0..16).map(move |k| (id, k / 4, k % 4)))
            .filter(|&(id, row, column)| {
                MarkerDictionary::Aruco4x4_50.is_white(id, row, column) == Some(true)
            })
            .count();
        let cell = (0.75 / 6.0) * (0.75 / 6.0);
        let expected = 5.0 + 4.0 * 0.75 * 0.75 - white_bits as f64 * cell;
        assert!((black_area(&board.drawing()) - expected).abs() < 1e-12);
    }

    #[test]
    fn a_tag_touches_four_squares() {
        let board = Board::new(Pattern::AprilGrid { spacing: 0.3 }, 1, 1, 0.1).unwrap();
        let drawing = board.drawing();
        let at = |p: Point2<f64>| {
            let ends = drawing.rectangles.iter();
            ends.filter(|[a, b]| (a - p).norm() < 1e-12 || (b - p).norm() < 1e-12)
                .count()
        };
        assert_eq!(at(Point2::new(0.0, 0.0)), 2);
        assert_eq!(at(Point2::new(1.0, 1.0)), 2);
        assert_eq!(drawing.rectangles[0][0], Point2::new(-0.3, -0.3));
    }
}
