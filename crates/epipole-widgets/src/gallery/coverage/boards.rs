//! The true camera, and the boards that it sees.

use crate::kit::board;
use epipole::Error;
use epipole::calibration::{Board, BoardView, Pattern};
use epipole::camera::{Camera, Distortion, Intrinsics, Lens};
use epipole::math::random::Random;
use nalgebra::{Point2, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// Size of the images, pixels.
pub(super) const SIZE: (u32, u32) = (640, 480);
/// True focal length, pixels.
pub(super) const FOCAL_PX: f64 = 600.0;
/// True principal point, pixels.
pub(super) const MIDDLE_PX: [f64; 2] = [326.0, 236.0];
pub(super) const LENS: Distortion = Distortion {
    k1: -0.25,
    k2: 0.08,
    ..Distortion::NONE
};
/// Standard deviation of the marks' noise, pixels.
const NOISE_PX: f64 = 0.1;
/// Side of a square and distance of the board's middle along the optical axis, meters.
const SQUARE_M: f64 = 0.03;
const DISTANCE_M: f64 = 0.62;
/// Angle between successive directions of spread and tilt: the golden angle, radians.
const GOLDEN_RAD: f64 = 2.399_963_229_728_653;
/// Steps in which a board is moved inward until all of its marks are in the image.
const NUM_INWARD: u32 = 40;

/// Poses of the boards.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Arrangement {
    /// Middle of all boards, pixels.
    pub(super) place: [f64; 2],
    /// Reach of the boards around it, as a fraction of the half image.
    pub(super) spread: f64,
    pub(super) tilt_deg: f64,
    /// Whether all boards are tilted in the same direction.
    pub(super) one_way: bool,
    pub(super) num_views: usize,
}

/// Returns the camera that sees the boards.
pub(super) fn camera() -> Result<Camera, Error> {
    let (width, height) = SIZE;
    let [cu, cv] = MIDDLE_PX;
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::new(FOCAL_PX, FOCAL_PX, cu, cv)?,
        lens: Lens::Brown(LENS),
    })
}

pub(super) fn board() -> Result<Board, Error> {
    Board::new(Pattern::Chessboard, 7, 5, SQUARE_M)
}

impl Arrangement {
    /// Returns the exact marks of each board, pixels, row by row.
    pub(super) fn marks(&self) -> Result<Vec<Vec<Point2<f64>>>, Error> {
        let (board, camera) = (board()?, camera()?);
        (0..self.num_views)
            .map(|index| self.marks_of(index, &board, &camera))
            .collect()
    }

    fn marks_of(
        &self,
        index: usize,
        board: &Board,
        camera: &Camera,
    ) -> Result<Vec<Point2<f64>>, Error> {
        let middle = Point2::new(f64::from(SIZE.0) / 2.0, f64::from(SIZE.1) / 2.0);
        // A sunflower's arrangement covers an ellipse evenly for any number of boards.
        let angle = GOLDEN_RAD * index as f64;
        let reach = self.spread * ((index as f64 + 0.5) / self.num_views as f64).sqrt();
        let wanted = Point2::from(self.place)
            + reach
                * Vector3::new(
                    libm::cos(angle) * middle.x,
                    libm::sin(angle) * middle.y,
                    0.0,
                )
                .xy();
        // A tilt away from the direction of spread, so that nothing is tilted by its place alone.
        let direction = if self.one_way { 0.6 } else { 1.5 * angle };
        let tilt = self.tilt_deg.to_radians()
            * Vector3::new(libm::cos(direction), libm::sin(direction), 0.0);
        let mut marks = Vec::new();
        for step in 0..=NUM_INWARD {
            let share = f64::from(step) / f64::from(NUM_INWARD);
            let ray = camera.unproject(&(wanted + (middle - wanted) * share))?;
            let at = Point3::from(ray * (DISTANCE_M / ray.z));
            let pose = board::pose(board, tilt, &at);
            let pixel = |mark| {
                let on_board = board.mark(mark);
                camera.project(&(pose * Point3::new(on_board.x, on_board.y, 0.0)))
            };
            marks = (0..board.num_marks())
                .map(pixel)
                .collect::<Result<_, _>>()?;
            if marks.iter().all(is_inside) {
                break;
            }
        }
        Ok(marks)
    }
}

/// Adds noise to exact marks.
pub(super) fn noisy(marks: &[Vec<Point2<f64>>], seed: u64) -> Vec<Option<BoardView>> {
    let mut random = Random::new(seed);
    let mut off = || NOISE_PX * random.normal();
    marks
        .iter()
        .map(|marks| {
            let pixels = marks.iter().map(|mark| {
                let (u, v) = (off(), off());
                Some(Point2::new(mark.x + u, mark.y + v))
            });
            Some(BoardView {
                pixels: pixels.collect(),
            })
        })
        .collect()
}

fn is_inside(pixel: &Point2<f64>) -> bool {
    let within = |value: f64, size: u32| (4.0..=f64::from(size) - 5.0).contains(&value);
    within(pixel.x, SIZE.0) && within(pixel.y, SIZE.1)
}

/// Returns the distance of the farthest mark from the true principal point, pixels.
pub(super) fn covered_px(marks: &[Vec<Point2<f64>>]) -> f64 {
    let away = |mark: &Point2<f64>| (mark - Point2::from(MIDDLE_PX)).norm();
    marks.iter().flatten().map(away).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mark_is_in_the_image() {
        for place in [[320.0, 240.0], [0.0, 0.0], [639.0, 300.0]] {
            for (spread, tilt_deg, num_views) in [(0.0, 0.0, 2), (1.0, 45.0, 12)] {
                let arrangement = Arrangement {
                    place,
                    spread,
                    tilt_deg,
                    one_way: false,
                    num_views,
                };
                let marks = arrangement.marks().unwrap();
                assert_eq!(marks.len(), num_views);
                assert!(marks.iter().flatten().all(is_inside), "{arrangement:?}");
                let farthest_px = libm::hypot(326.0, 244.0);
                assert!(covered_px(&marks) < farthest_px);
            }
        }
    }
}
