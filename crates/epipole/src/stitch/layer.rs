//! A photo, drawn on the canvas.

use super::canvas::{Canvas, View};
use image::RgbImage;
use nalgebra::Point2;

/// The pixel of a photo at a place of the canvas, also beyond its border; `None` behind it.
fn pixel(canvas: &Canvas, view: &View, u: usize, v: usize) -> Option<Point2<f64>> {
    let p = view.pixel_from_direction * canvas.direction(u, v);
    (p.z > 0.0).then(|| Point2::new(p.x / p.z, p.y / p.z))
}

/// Weight of a photo at a place of the canvas: 1 in its middle, 0 at its border and beyond.
pub(super) fn weight(
    canvas: &Canvas,
    view: &View,
    (width, height): (u32, u32),
    u: usize,
    v: usize,
) -> f32 {
    let Some(p) = pixel(canvas, view, u, v) else {
        return 0.0;
    };
    let part = |x: f64, size: u32| {
        let side = f64::from(size);
        // From −1 to 1 between the outer edges of the pixels; centers at the border count.
        1.0 - ((2.0 * x + 1.0) / side - 1.0).abs()
    };
    let inside = |x: f64, size: u32| x >= 0.0 && x <= f64::from(size) - 1.0;
    match inside(p.x, width) && inside(p.y, height) {
        true => (part(p.x, width) * part(p.y, height)) as f32,
        false => 0.0,
    }
}

/// Red, green and blue of a photo from 0 to 255 at a place of the canvas, by bilinear
/// interpolation; the border repeats beyond it.
pub(super) fn color(
    canvas: &Canvas,
    view: &View,
    photo: &RgbImage,
    u: usize,
    v: usize,
) -> [f32; 3] {
    let Some(p) = pixel(canvas, view, u, v) else {
        return [0.0; 3];
    };
    let clamped = |x: f64, size: u32| x.clamp(0.0, f64::from(size.max(1)) - 1.0);
    let (x, y) = (clamped(p.x, photo.width()), clamped(p.y, photo.height()));
    let (left, top) = (x.floor(), y.floor());
    let (a, b) = ((x - left) as f32, (y - top) as f32);
    let (left, top) = (left as u32, top as u32);
    let (right, bottom) = (
        (left + 1).min(photo.width() - 1),
        (top + 1).min(photo.height() - 1),
    );
    let at = |u, v| photo.get_pixel(u, v).0.map(f32::from);
    let [p00, p10] = [at(left, top), at(right, top)];
    let [p01, p11] = [at(left, bottom), at(right, bottom)];
    core::array::from_fn(|c| {
        let (upper, lower) = (
            p00[c] + a * (p10[c] - p00[c]),
            p01[c] + a * (p11[c] - p01[c]),
        );
        upper + b * (lower - upper)
    })
}
