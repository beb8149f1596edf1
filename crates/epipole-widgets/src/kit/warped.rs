//! A photograph warped by a homography, up to its horizon.

use crate::canvas::{Canvas, Place};
use crate::contract::Panel;
use epipole::homography::transfer;
use image::RgbImage;
use nalgebra::{Matrix3, Point2, Vector3};

/// Minimum third coordinate that is drawn, relative to the largest; below it, a pixel of the
/// photograph would cover the whole panel.
const NEAR_HORIZON: f64 = 0.02;

/// Draws a photograph through a homography to the panel's coordinates, whose scale is the same in
/// both directions. The part with a negative third coordinate, beyond the horizon, is omitted.
pub(crate) fn draw(
    canvas: &mut Canvas,
    panel: &Panel,
    shown_from_photo: &Matrix3<f64>,
    photograph: &RgbImage,
) {
    let Some(photo_from_shown) = shown_from_photo.try_inverse() else {
        return;
    };
    let outline = outline(shown_from_photo, photograph.dimensions());
    let places: Vec<Place> = outline.iter().map(|point| panel.place_of(point)).collect();
    let (step, rect) = (1.0 / panel.scale_x(), panel.rect);
    #[rustfmt::skip]
    let shown_from_page = Matrix3::new(
        step, 0.0,  panel.x_axis.start - rect.x * step,
        0.0,  step, panel.y_axis.start - rect.y * step,
        0.0,  0.0,  1.0,
    );
    let photo_from_page = photo_from_shown * shown_from_page;
    canvas.warped_photograph(&places, &photo_from_page, photograph);
}

/// Returns the outline of the part of a photograph in front of the horizon, in the coordinates of
/// the homography's image.
fn outline(shown_from_photo: &Matrix3<f64>, (width, height): (u32, u32)) -> Vec<Point2<f64>> {
    let (right, bottom) = (f64::from(width) - 0.5, f64::from(height) - 0.5);
    let corners = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)];
    let depth = |(u, v): (f64, f64)| (shown_from_photo * Vector3::new(u, v, 1.0)).z;
    let largest = corners.map(depth).into_iter().fold(0.0, f64::max);
    let above = |corner| depth(corner) - NEAR_HORIZON * largest;
    let mut kept = Vec::new();
    for index in 0..4 {
        let (from, to) = (corners[index], corners[(index + 1) % 4]);
        let (start, end) = (above(from), above(to));
        if start >= 0.0 {
            kept.push(from);
        }
        if (start >= 0.0) != (end >= 0.0) {
            let share = start / (start - end);
            let along = |from: f64, to: f64| from + share * (to - from);
            kept.push((along(from.0, to.0), along(from.1, to.1)));
        }
    }
    let shown = |(u, v)| transfer(shown_from_photo, &Point2::new(u, v));
    kept.into_iter().filter_map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_of_a_whole_photograph_is_its_corners() {
        let shift = Matrix3::new(1.0, 0.0, 5.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
        let found = outline(&shift, (4, 3));
        assert_eq!(found[0], Point2::new(4.5, -0.5));
        assert_eq!(found[2], Point2::new(8.5, 2.5));
        assert_eq!(found.len(), 4);
    }

    #[test]
    fn beyond_the_horizon_nothing_is_left() {
        // The third coordinate is 0 at row 100: rows below it are in front.
        let floor = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.01, -1.0);
        let found = outline(&floor, (200, 300));
        assert_eq!(found.len(), 4);
        // The second coordinate of the image is 1 / w, with its maximum at the cut.
        let largest_w = 0.01 * 299.5 - 1.0;
        let far = found.iter().map(|point| point.y).fold(0.0, f64::max);
        assert!(
            (far - 1.0 / (NEAR_HORIZON * largest_w)).abs() < 1e-9,
            "{far}"
        );
        assert!(outline(&-floor, (200, 90)).len() == 4 && outline(&floor, (200, 90)).is_empty());
    }
}
