//! The scenes that figures photograph, and the size of their photographs.

use crate::contract::Progress;
use epipole::Error;
use epipole::camera::PosedCamera;
use epipole::math::random::Random;
use epipole_scenes::{
    MovableKind, MovableObject, Moved, Photograph, Sampling, Scene, Transfer, still_life_camera,
};
use image::RgbImage;
use nalgebra::{Isometry3, Point2, Point3, Translation3, UnitQuaternion, Vector3};
use std::sync::OnceLock;

/// Width of a photograph, pixels.
pub(crate) const PHOTO_WIDTH: u32 = 640;
/// Height of a photograph, pixels.
pub(crate) const PHOTO_HEIGHT: u32 = 480;
/// Width and height of a photograph, pixels.
pub(crate) const PHOTO_SIZE: (u32, u32) = (PHOTO_WIDTH, PHOTO_HEIGHT);
/// Height over width.
pub(crate) const PHOTO_ASPECT: f64 = PHOTO_HEIGHT as f64 / PHOTO_WIDTH as f64;

/// Returns whether a position of the image plane lies within the photograph.
pub(crate) fn in_picture(pixel: &Point2<f64>) -> bool {
    (-0.5..=f64::from(PHOTO_WIDTH) - 0.5).contains(&pixel.x)
        && (-0.5..=f64::from(PHOTO_HEIGHT) - 0.5).contains(&pixel.y)
}

/// Visibility in photograph 2 of the still-life point at a pixel of photograph 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Seen {
    /// Visible at this pixel.
    Visible(Point2<f64>),
    /// Hidden at this pixel by the named object.
    Hidden(Point2<f64>, &'static str),
    /// Outside of the picture, at this pixel.
    Outside(Point2<f64>),
    /// Behind camera 2.
    Behind,
    /// No surface at the pixel of photograph 1.
    Nothing,
}

impl Seen {
    /// Computes the visibility from the scene's exact depth.
    pub(crate) fn of([first, second]: &[PosedCamera; 2], pixel1: &Point2<f64>) -> Self {
        match still_life().transfer(first, second, pixel1) {
            Transfer::Visible { pixel2, .. } | Transfer::Occluded { pixel2, .. }
                if !in_picture(&pixel2) =>
            {
                Self::Outside(pixel2)
            }
            Transfer::Visible { pixel2, .. } => Self::Visible(pixel2),
            Transfer::Occluded { pixel2, by, .. } => Self::Hidden(pixel2, by),
            Transfer::BehindCamera { .. } => Self::Behind,
            Transfer::Nothing => Self::Nothing,
        }
    }

    /// Returns the pixel of photograph 2, even if hidden or outside.
    pub(crate) fn pixel(self) -> Option<Point2<f64>> {
        match self {
            Self::Visible(pixel) | Self::Hidden(pixel, _) | Self::Outside(pixel) => Some(pixel),
            Self::Behind | Self::Nothing => None,
        }
    }
}

/// Height of the long table's ball center below the cameras, meters.
pub(crate) const BALL_Y_M: f64 = 0.14;

/// Radius of the ball with a small margin, meters; then the radius of its shade.
const BALL_RADIUS_M: f64 = 0.112;
const BALL_SHADE_M: f64 = 0.3;

/// Returns the motion of the long table's ball between two positions of its center, meters.
pub(crate) fn moved_ball(from: [f64; 3], to: [f64; 3]) -> Option<Moved> {
    let (from, to) = (Point3::from(from), Point3::from(to));
    (from != to).then_some(Moved {
        center: from,
        radius_m: BALL_RADIUS_M,
        stale_m: BALL_SHADE_M,
        by: to - from,
    })
}

/// Name of the ball in the scene.
pub(crate) const BALL: &str = "the ball";

/// Returns the still life of the book.
pub(crate) fn still_life() -> Scene {
    Scene::still_life()
}

/// Returns two cameras in front of the still life: the one it was composed for, and one moved and
/// rotated in the horizontal plane of the first.
///
/// * `size`: width and height of both photographs, pixels
/// * `right_m`, `forward_m`, `left_deg`: position of the second camera in the frame of the first,
///   and its rotation to the left
pub(crate) fn still_life_pair(
    (width, height): (u32, u32),
    right_m: f64,
    forward_m: f64,
    left_deg: f64,
) -> [PosedCamera; 2] {
    let first = still_life_camera(width, height);
    // y points down: rotating the camera to the left rotates the scene to the right in its frame,
    // by +y.
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), left_deg.to_radians());
    let to_center = Translation3::new(-right_m, 0.0, -forward_m);
    let cam2_from_cam1 = Isometry3::from_parts(Translation3::identity(), turn) * to_center;
    let second = PosedCamera {
        cam_from_world: cam2_from_cam1 * first.cam_from_world,
        ..first
    };
    [first, second]
}

/// Renders a sharp photograph of the still life.
///
/// # Errors
/// As [`Scene::render`], and [`Error::Canceled`] if `progress` cancels.
pub(crate) fn photograph(
    camera: &PosedCamera,
    (width, height): (u32, u32),
    progress: Progress<'_>,
) -> Result<RgbImage, Error> {
    let scene = still_life();
    let mut photograph = Photograph::blank(width, height);
    for first in (0..height).step_by(60) {
        let rows = first..first + 60;
        scene.render_rows(camera, width, height, Sampling::Full, rows, &mut photograph)?;
        let done = f64::from((first + 60).min(height)) / f64::from(height);
        if progress(done).is_break() {
            return Err(Error::Canceled);
        }
    }
    Ok(photograph.image)
}

/// Returns the long table with its ball at a position in the top view, meters to the right of the
/// left camera and away from it.
///
/// # Errors
/// As [`Scene::long_table`], if the position is not on the table.
pub(crate) fn long_table((x_m, z_m): (f64, f64)) -> Result<Scene, Error> {
    Scene::long_table(MovableObject {
        kind: MovableKind::Ball,
        x_m,
        z_m,
    })
}

/// Size of [`square_picture`], pixels.
pub(crate) const SQUARE_SIZE: (u32, u32) = (240, 180);

/// Returns a dark square on a light background, rotated by 15°, with edges smoothed over a pixel
/// and noise of this standard deviation in gray levels.
pub(crate) fn square_picture(noise: f64) -> RgbImage {
    static GRAIN: OnceLock<Vec<f64>> = OnceLock::new();
    let (width, height) = SQUARE_SIZE;
    let grain = GRAIN.get_or_init(|| {
        let mut random = Random::new(5);
        (0..width * height).map(|_| random.normal()).collect()
    });
    let angle = 15.0_f64.to_radians();
    let (cos, sin) = (libm::cos(angle), libm::sin(angle));
    let half = 46.0;
    let mut picture = RgbImage::new(width, height);
    let columns = width as usize;
    let rows = picture.as_chunks_mut::<3>().0.chunks_exact_mut(columns);
    for (v, (row, grain)) in rows.zip(grain.chunks_exact(columns)).enumerate() {
        let y = v as f64 - f64::from(height - 1) / 2.0;
        let (along, across) = (y * sin, y * cos);
        for (u, (pixel, grain)) in row.iter_mut().zip(grain).enumerate() {
            let x = u as f64 - f64::from(width - 1) / 2.0;
            let outside = (x * cos + along).abs().max((across - x * sin).abs()) - half;
            let cover = (0.5 - outside).clamp(0.0, 1.0);
            let gray = 215.0 - 150.0 * cover + noise * grain;
            // The cast truncates and saturates negative values at 0.
            *pixel = [(gray + 0.5) as u8; 3];
        }
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::geometry::Geometry;

    #[test]
    fn turned_left_means_that_things_move_right_in_the_picture() {
        let point = Point2::new(300.0, 240.0);
        let pairs = [0.0, 10.0].map(|turn| still_life_pair(PHOTO_SIZE, 0.0, 0.0, turn));
        let [a, b] = pairs.map(|pair| Seen::of(&pair, &point).pixel().unwrap());
        assert!(b.x > a.x + 50.0);
        assert!(Geometry::of(&pairs[1]).is_none());
    }
}
