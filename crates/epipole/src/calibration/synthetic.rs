//! Photographs of boards, with exact truth.

#[cfg(test)]
use super::BoardView;
use super::{Board, Pattern};
use crate::camera::{Camera, RigidTransform};
use crate::imaging::GrayImage32;
use crate::math::random::Random;
use nalgebra::{Point2, Point3, Vector3};

/// Samples along each side of a pixel.
const SAMPLES: usize = 3;
const BLACK: f32 = 0.12;
const WHITE: f32 = 0.85;
const TABLE: f32 = 0.45;

/// The gray of a place on the board, whose margin is 1.2 squares wide.
fn gray(board: &Board, x: f64, y: f64) -> f32 {
    let (x, y) = (x / board.square_m(), y / board.square_m());
    let across = match board.pattern() {
        Pattern::Chessboard => board.columns(),
        Pattern::AsymmetricCircles => 2 * board.columns(),
    } as f64;
    let down = board.rows() as f64;
    if x < -2.2 || y < -2.2 || x > across + 1.2 || y > down + 1.2 {
        return TABLE;
    }
    match board.pattern() {
        Pattern::Chessboard => {
            let on_squares = x > -1.0 && y > -1.0 && x < across && y < down;
            let even = (x.floor() + y.floor()).rem_euclid(2.0) == 0.0;
            if on_squares && even { BLACK } else { WHITE }
        }
        Pattern::AsymmetricCircles => {
            let (i, j) = (x.round(), y.round());
            let is_mark = i >= 0.0
                && j >= 0.0
                && i < across
                && j < down
                && (i + j).rem_euclid(2.0) == 0.0
                && libm::hypot(x - i, y - j) < 0.45;
            if is_mark { BLACK } else { WHITE }
        }
    }
}

/// A photograph of a board on a gray table, each pixel the mean over its area.
///
/// * `cam_from_board`: where the board is, meters
/// * `noise`: one standard deviation of the noise, white being 1 and black 0
/// * `seed`: of the noise
///
/// Where the lens sees nothing, and behind the board, there is table.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{Board, Pattern, find_board, photograph_of_board};
/// use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
/// let board = Board::new(Pattern::Chessboard, 5, 4, 0.02)?;
/// let camera = Camera {
///     intrinsics: Intrinsics::centered(200.0, 160, 120)?,
///     lens: Lens::from_coefficients(LensKind::Brown, &[0.0; 5])?,
///     width: 160,
///     height: 120,
/// };
/// // The corner in row 1 and column 2 is 2 cm to the right and 2 cm below of the first.
/// let pose = RigidTransform::translation(-0.04, -0.03, 0.2);
/// let image = photograph_of_board(&board, &camera, &pose, 0.0, 0);
/// let found = find_board(&image, &board)?.view().expect("a board");
/// let seen = found.pixels[7].expect("a corner");
/// assert!((seen - nalgebra::Point2::new(79.5, 49.5)).norm() < 0.1);
/// # Ok(()) }
/// ```
pub fn photograph_of_board(
    board: &Board,
    camera: &Camera,
    cam_from_board: &RigidTransform,
    noise: f64,
    seed: u64,
) -> GrayImage32 {
    let mut random = Random::new(seed);
    let board_from_cam = cam_from_board.inverse();
    let origin = board_from_cam * Point3::origin();
    GrayImage32::from_fn(camera.width, camera.height, |u, v| {
        let mut sum = 0.0;
        for k in 0..SAMPLES * SAMPLES {
            let offset = |k: usize| (k as f64 + 0.5) / SAMPLES as f64 - 0.5;
            let pixel = Point2::new(
                f64::from(u) + offset(k % SAMPLES),
                f64::from(v) + offset(k / SAMPLES),
            );
            let value = camera.ray(&pixel).ok().and_then(|ray| {
                let ray: Vector3<f64> = board_from_cam.rotation * ray;
                let depth = -origin.z / ray.z;
                (depth > 0.0)
                    .then(|| gray(board, origin.x + depth * ray.x, origin.y + depth * ray.y))
            });
            sum += value.unwrap_or(TABLE);
        }
        let mean = sum / (SAMPLES * SAMPLES) as f32;
        image::Luma([(mean + (noise * random.normal()) as f32).clamp(0.0, 1.0)])
    })
}

/// Where the marks are seen.
#[cfg(test)]
pub(crate) fn true_view(
    board: &Board,
    camera: &Camera,
    cam_from_board: &RigidTransform,
) -> BoardView {
    let pixel = |mark| {
        let p = board.mark(mark);
        camera
            .project(&(cam_from_board * Point3::new(p.x, p.y, 0.0)))
            .ok()
    };
    BoardView {
        pixels: (0..board.num_marks()).map(pixel).collect(),
    }
}

/// Poses that show the board from all sides, at so many squares' distance.
#[cfg(test)]
pub(crate) fn poses(board: &Board, count: usize, distance: f64, seed: u64) -> Vec<RigidTransform> {
    let mut random = Random::new(seed);
    let last = board.mark(board.num_marks() - 1);
    let middle = Vector3::new(last.x / 2.0, last.y / 2.0, 0.0);
    (0..count)
        .map(|_| {
            let turn = Vector3::new(
                random.uniform(-0.55, 0.55),
                random.uniform(-0.55, 0.55),
                random.uniform(-0.4, 0.4),
            );
            let rotation = nalgebra::UnitQuaternion::from_scaled_axis(turn);
            let far = distance * board.square_m();
            let at = Vector3::new(
                random.uniform(-0.12, 0.12) * far,
                random.uniform(-0.08, 0.08) * far,
                far * random.uniform(0.9, 1.3),
            );
            RigidTransform::from_parts((at - rotation * middle).into(), rotation)
        })
        .collect()
}
