//! The scenes that figures photograph, and the size of their photographs.

use epipole::Error;
use epipole::synthetic::{MovableKind, MovableObject, Scene};
use nalgebra::Point2;

/// Size of a photograph, pixels.
pub(crate) const PHOTO_WIDTH: u32 = 640;
/// Size of a photograph, pixels.
pub(crate) const PHOTO_HEIGHT: u32 = 480;
/// Width and height of a photograph, pixels.
pub(crate) const PHOTO_SIZE: (u32, u32) = (PHOTO_WIDTH, PHOTO_HEIGHT);

/// Whether a place of the image plane lies within the photograph.
pub(crate) fn in_picture(pixel: &Point2<f64>) -> bool {
    (-0.5..=f64::from(PHOTO_WIDTH) - 0.5).contains(&pixel.x)
        && (-0.5..=f64::from(PHOTO_HEIGHT) - 0.5).contains(&pixel.y)
}

/// Where the middle of the long table's ball is below the cameras, meters.
pub(crate) const BALL_Y_M: f64 = 0.14;

/// What the scene calls it.
pub(crate) const BALL: &str = "the ball";

/// The still life of the book.
pub(crate) fn still_life() -> Scene {
    Scene::still_life()
}

/// The long table, with its ball at this place seen from above, meters to the right of the left
/// camera and away from it.
///
/// # Errors
/// As [`Scene::long_table`]: the place is not on the table.
pub(crate) fn long_table((x_m, z_m): (f64, f64)) -> Result<Scene, Error> {
    Scene::long_table(MovableObject {
        kind: MovableKind::Ball,
        x_m,
        z_m,
    })
}
