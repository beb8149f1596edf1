//! Sampling of a photo on the canvas.

use super::canvas::{Canvas, View};
use crate::imaging::{Border, bilinear};
use image::RgbImage;
use nalgebra::Point2;

/// Returns the pixel of a photo at a canvas position, also beyond its border; `None` behind it.
fn pixel(canvas: &Canvas, view: &View, u: usize, v: usize) -> Option<Point2<f64>> {
    let p = view.pixel_from_direction * canvas.direction(u, v);
    (p.z > 0.0).then(|| Point2::new(p.x / p.z, p.y / p.z))
}

/// Returns the weight of a photo at a canvas position: 1 in its middle, 0 at its border and beyond.
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
        // From −1 to 1 between the outer edges of the pixels, so that centers of border pixels
        // count.
        1.0 - ((2.0 * x + 1.0) / side - 1.0).abs()
    };
    let inside = |x: f64, size: u32| x >= 0.0 && x <= f64::from(size) - 1.0;
    match inside(p.x, width) && inside(p.y, height) {
        true => (part(p.x, width) * part(p.y, height)) as f32,
        false => 0.0,
    }
}

/// Returns red, green and blue of a photo from 0 to 255 at a canvas position, by bilinear
/// interpolation; border pixels are repeated outside.
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
    let raw = photo.as_raw();
    core::array::from_fn(|channel| {
        let read = |pixel: usize| raw[3 * pixel + channel].into();
        bilinear(photo.dimensions(), p.x, p.y, Border::Replicate, read)
    })
}
