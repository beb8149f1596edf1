//! Canvas of a panorama, and the position of each photo on it.

use super::panorama::Panorama;
use super::surface::{Surface, direction};
use crate::{Error, Result};
use core::f64::consts::PI;
use core::ops::Range;
use nalgebra::{Matrix3, Point2, Vector3};

/// Tolerance for rounding lengths to whole pixels.
const ROUNDING_PX: f64 = 1e-6;

/// A photo on the canvas.
pub(super) struct View {
    pub(super) image: usize,
    pub(super) pixel_from_direction: Matrix3<f64>,
    /// Columns and rows of the canvas where the photo may be visible.
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
}

/// Directions of the canvas's columns and rows.
pub(super) struct Canvas {
    columns: Vec<[f64; 2]>,
    rows: Vec<[f64; 2]>,
}

impl Canvas {
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    pub(super) fn height(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn direction(&self, u: usize, v: usize) -> Vector3<f64> {
        direction(self.columns[u], self.rows[v])
    }

    /// Creates the canvas of all photos, with the position of each.
    ///
    /// * `sizes`: width and height of the photos
    /// * `max_pixels`: a larger canvas is downscaled
    ///
    /// # Errors
    /// [`Error::Degenerate`] if the photos extend beyond the surface.
    pub(super) fn new(
        panorama: &Panorama,
        sizes: &[(u32, u32)],
        surface: Surface,
        max_pixels: u64,
    ) -> Result<(Self, Vec<View>)> {
        let mut places = Vec::new();
        for (image, matrix) in panorama.pixel_from_direction.iter().enumerate() {
            if let Some(matrix) = matrix {
                let place = bounds(matrix, sizes[image], surface);
                places.push((image, *matrix, place.ok_or(BEYOND)?));
            }
        }
        let mut whole = [
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ];
        for (_, _, [left, right, top, bottom]) in &places {
            whole = [
                whole[0].min(*left),
                whole[1].max(*right),
                whole[2].min(*top),
                whole[3].max(*bottom),
            ];
        }
        if surface.is_round() {
            // Beyond 180° it continues from the other side.
            if whole[0] < -PI || whole[1] > PI {
                whole = [-PI, PI, whole[2], whole[3]];
            }
        }
        let [left, right, top, bottom] = whole;
        let (wide, high) = (right - left, bottom - top);
        let mut scale = panorama.scale_px;
        let num_pixels = wide * high * scale * scale;
        if !(num_pixels > 0.0 && num_pixels.is_finite()) {
            return Err(BEYOND);
        }
        scale *= (max_pixels as f64 / num_pixels).sqrt().min(1.0);
        let count = |length: f64| (length * scale + ROUNDING_PX).floor() as usize + 1;
        let at = |start: f64| move |n: usize| start + n as f64 / scale;
        let canvas = Self {
            columns: (0..count(wide))
                .map(at(left))
                .map(|x| surface.column(x))
                .collect(),
            rows: (0..count(high))
                .map(at(top))
                .map(|y| surface.row(y))
                .collect(),
        };
        let range = |from: f64, to: f64, start: f64, size: usize| {
            let first = ((from - start) * scale).floor().max(0.0) as usize;
            let end = ((to - start) * scale).ceil().max(0.0) as usize + 1;
            first.min(size)..end.min(size)
        };
        let views = places
            .into_iter()
            .map(|(image, pixel_from_direction, place)| {
                let wraps = place[0] < left || place[1] > right;
                let columns = match wraps {
                    true => 0..canvas.width(),
                    false => range(place[0], place[1], left, canvas.width()),
                };
                View {
                    image,
                    pixel_from_direction,
                    columns,
                    rows: range(place[2], place[3], top, canvas.height()),
                }
            });
        let views = views.collect();
        Ok((canvas, views))
    }
}

const BEYOND: Error = Error::Degenerate {
    what: "a panorama",
    why: "a photo looks beyond what the surface shows: a cylinder shows all around, a sphere everything",
};

/// Returns the minimum and maximum x and y of a photo on a surface; `None` if part of it is beyond.
fn bounds(
    matrix: &Matrix3<f64>,
    (width, height): (u32, u32),
    surface: Surface,
) -> Option<[f64; 4]> {
    let inverse = matrix.try_inverse()?;
    let place = |u: f64, v: f64| surface.place(&(inverse * Vector3::new(u, v, 1.0)));
    let (last_u, last_v) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
    let [middle, _] = place(0.5 * last_u, 0.5 * last_v)?;
    let mut bounds = [
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    let along = |size: u32| (0..size).map(f64::from);
    let mut border: Vec<Point2<f64>> = Vec::new();
    for u in along(width) {
        border.extend([Point2::new(u, 0.0), Point2::new(u, last_v)]);
    }
    for v in along(height) {
        border.extend([Point2::new(0.0, v), Point2::new(last_u, v)]);
    }
    for pixel in border {
        let [mut x, y] = place(pixel.x, pixel.y)?;
        if surface.is_round() {
            // The angle nearest to that of the middle.
            x -= 2.0 * PI * ((x - middle) / (2.0 * PI)).round();
        }
        bounds = [
            bounds[0].min(x),
            bounds[1].max(x),
            bounds[2].min(y),
            bounds[3].max(y),
        ];
    }
    // A photo that looks straight up or down covers all azimuths there.
    let pole = |y: f64| {
        let p = matrix * Vector3::new(0.0, y, 0.0);
        let inside = |x: f64, last: f64| (0.0..=last).contains(&(x / p.z));
        p.z > 0.0 && inside(p.x, last_u) && inside(p.y, last_v)
    };
    if surface == Surface::Sphere {
        for y in [-1.0, 1.0] {
            if pole(y) {
                bounds = [
                    -PI,
                    PI,
                    bounds[2].min(y * 0.5 * PI),
                    bounds[3].max(y * 0.5 * PI),
                ];
            }
        }
    }
    Some(bounds)
}
