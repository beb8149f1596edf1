//! Rendered photographs of a chessboard, through a lens with distortion.

use epipole::calibration::{Board, Pattern, render_board};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use image::{Rgb, RgbImage};
use nalgebra::{UnitQuaternion, Vector3};

/// Poses of the boards: rotation about x, y and z in degrees, and the board's center to the right,
/// down and away, in centimeters. The last board is partly outside of the image.
const POSES: [[f64; 6]; 10] = [
    [6.0, -5.0, 3.0, 0.0, 0.0, 40.0],
    [35.0, 0.0, 5.0, -3.0, -2.0, 38.0],
    [-35.0, 5.0, -5.0, 3.0, 2.0, 38.0],
    [0.0, 38.0, 0.0, -9.0, 1.0, 36.0],
    [5.0, -38.0, 4.0, 9.0, -1.0, 36.0],
    [25.0, 25.0, 8.0, -11.0, -8.5, 42.0],
    [-25.0, 25.0, -8.0, 11.0, -8.5, 42.0],
    [25.0, -25.0, -6.0, -11.0, 8.5, 42.0],
    [-25.0, -25.0, 6.0, 11.0, 8.5, 42.0],
    [10.0, -10.0, 8.0, 22.0, 3.0, 40.0],
];
/// Standard deviation of the noise of gray values in [0, 1].
const NOISE: f64 = 0.008;

/// Number of photographs.
#[cfg(test)]
pub(super) const COUNT: usize = POSES.len();

/// Renders a photograph of the set; `None` beyond its end.
///
/// # Errors
/// As [`Board::new`] and [`Intrinsics::new`], which do not fail for these values.
pub(super) fn photograph(index: u8) -> Result<Option<RgbImage>, epipole::Error> {
    let Some([x, y, z, right, down, away]) = POSES.get(usize::from(index)) else {
        return Ok(None);
    };
    let board = Board::new(Pattern::Chessboard, 9, 6, 0.025)?;
    let camera = Camera {
        intrinsics: Intrinsics::new(520.0, 521.0, 323.0, 236.0)?,
        lens: Lens::from_coefficients(LensKind::Brown, &[-0.26, 0.07, 0.0008, -0.0005, 0.0])?,
        width: 640,
        height: 480,
    };
    let turn = [x, y, z].map(|degrees| degrees.to_radians());
    let rotation = UnitQuaternion::from_euler_angles(turn[0], turn[1], turn[2]);
    let middle = board.mark(board.num_marks() - 1) / 2.0;
    let at = Vector3::new(*right, *down, *away) / 100.0;
    let moved = at - rotation * Vector3::new(middle.x, middle.y, 0.0);
    let pose = RigidTransform::from_parts(moved.into(), rotation);
    let gray = render_board(&board, &camera, &pose, NOISE, u64::from(index), &mut ())?;
    Ok(Some(RgbImage::from_fn(640, 480, |u, v| {
        let value = (255.0 * gray.get_pixel(u, v).0[0]).round() as u8;
        Rgb([value; 3])
    })))
}
