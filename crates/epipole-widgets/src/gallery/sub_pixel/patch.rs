//! A picture of a corner at a known position, and its gradients.

use epipole::imaging::GrayImage32;
use epipole::math::random::Random;
use image::{Luma, Rgb, RgbImage};
use nalgebra::{Point2, Vector2};

/// Size of the picture, pixels.
pub(super) const SIZE: (u32, u32) = (33, 25);
/// Position of the corner, pixels.
pub(super) const CORNER: Point2<f64> = Point2::new(16.31, 12.22);
/// Gray levels of the wedges and of the background.
const LEVELS: [f64; 2] = [60.0, 210.0];
/// Number of samples per pixel along each side.
const NUM_SAMPLES: u32 = 6;
/// Direction of the middle of one wedge, radians.
const TOWARD_RAD: f64 = 0.55;

/// Returns two dark wedges whose tips meet at [`CORNER`], as on a chessboard, in [0, 1].
///
/// * `opening_deg`: angle between the edges of a wedge
/// * `noise`: standard deviation, gray levels
pub(super) fn picture(opening_deg: f64, noise: f64) -> GrayImage32 {
    let half_rad = opening_deg.to_radians() / 2.0;
    // Outward normals of the edges of that wedge.
    let normals = [-1.0, 1.0].map(|side| {
        let (sin, cos) = libm::sincos(TOWARD_RAD + side * half_rad);
        Vector2::new(-side * sin, side * cos)
    });
    let is_inside = |point: Point2<f64>| {
        let from_corner = point - CORNER;
        let [one, two] = normals.map(|normal| normal.dot(&from_corner) < 0.0);
        one == two
    };
    let sample = |index: u32| (f64::from(index) + 0.5) / f64::from(NUM_SAMPLES) - 0.5;
    let mut random = Random::new(11);
    GrayImage32::from_fn(SIZE.0, SIZE.1, |u, v| {
        let (u, v) = (f64::from(u), f64::from(v));
        let count = (0..NUM_SAMPLES * NUM_SAMPLES)
            .filter(|index| {
                let (i, j) = (index % NUM_SAMPLES, index / NUM_SAMPLES);
                is_inside(Point2::new(u + sample(i), v + sample(j)))
            })
            .count();
        let cover = count as f64 / f64::from(NUM_SAMPLES * NUM_SAMPLES);
        let level = LEVELS[1] + cover * (LEVELS[0] - LEVELS[1]) + noise * random.normal();
        Luma([(level / 255.0).clamp(0.0, 1.0) as f32])
    })
}

/// Returns the gradient at a pixel; zero at the border.
pub(super) fn gradient(image: &GrayImage32, (u, v): (u32, u32)) -> Vector2<f64> {
    let (width, height) = image.dimensions();
    if u == 0 || v == 0 || u + 1 >= width || v + 1 >= height {
        return Vector2::zeros();
    }
    let at = |u: u32, v: u32| f64::from(image.get_pixel(u, v).0[0]);
    let across = at(u + 1, v) - at(u - 1, v);
    let down = at(u, v + 1) - at(u, v - 1);
    Vector2::new(across, down) / 2.0
}

/// Returns the picture enlarged, with its pixels as squares.
pub(super) fn enlarged(image: &GrayImage32, times: u32) -> RgbImage {
    let (width, height) = image.dimensions();
    RgbImage::from_fn(width * times, height * times, |u, v| {
        let level = 255.0 * image.get_pixel(u / times, v / times).0[0];
        Rgb([level.round() as u8; 3])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_wedges_are_dark_and_gradients_point_to_the_light() {
        let image = picture(90.0, 0.0);
        let level = |u, v| (255.0 * image.get_pixel(u, v).0[0]).round();
        assert_eq!([level(30, 20), level(2, 4)], [60.0; 2]);
        assert_eq!([level(4, 22), level(28, 2)], [210.0; 2]);
        assert_eq!(gradient(&image, (2, 4)), Vector2::zeros());
        // Directly below the corner, brightness increases to the left.
        let edge = (0..SIZE.0).map(|u| gradient(&image, (u, 20)));
        assert!(edge.min_by(|a, b| a.x.total_cmp(&b.x)).unwrap().x < -0.1);
    }
}
