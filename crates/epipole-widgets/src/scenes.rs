//! The scenes that figures photograph, and the size of their photographs.

use epipole::synthetic::Scene;
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

/// Where the middle of the long table's movable thing is below the cameras, meters.
pub(crate) const OBJECT_Y_M: f64 = 0.2;

/// The still life of the book.
pub(crate) fn still_life() -> Scene {
    Scene::still_life()
}

/// The long table, with its movable thing at this place seen from above.
pub(crate) fn long_table(_place: (f64, f64)) -> Scene {
    Scene::still_life()
}
