//! Photographs in perspective: each pixel of the figure samples the photograph.

use super::photograph::blend;
use super::{Canvas, Place};
use image::RgbImage;
use nalgebra::{Matrix3, Vector3};
use std::borrow::Cow;

/// Maximum number of photograph pixels per device pixel; the photograph is halved until it is met.
const FINE: f64 = 1.6;

impl Canvas {
    /// Draws a photograph on a plane in space, in perspective.
    ///
    /// * `corners`: positions of the corners of the drawn part, in order; it must be convex
    /// * `photo_from_page`: the homography from CSS pixels to pixels of the photograph, centers at
    ///   integers
    ///
    /// Interpolation is bilinear, in a photograph halved enough to avoid aliasing.
    pub fn warped_photograph(
        &mut self,
        corners: &[Place],
        photo_from_page: &Matrix3<f64>,
        photo: &RgbImage,
    ) {
        let finite = corners.iter().all(|(x, y)| x.is_finite() && y.is_finite());
        let finite = finite && photo_from_page.iter().all(|entry| entry.is_finite());
        let (width, height) = photo.dimensions();
        if !finite || width == 0 || height == 0 {
            return;
        }
        let area = area(corners) * self.scale * self.scale;
        let (mut photo, mut halvings) = (Cow::Borrowed(photo), 0);
        while f64::from(photo.width()) * f64::from(photo.height()) > FINE * FINE * area
            && photo.width() >= 8
            && photo.height() >= 8
        {
            photo = Cow::Owned(halved(&photo));
            halvings += 1;
        }
        let source = Source::new(&photo);
        let shrink = libm::exp2(-f64::from(halvings));
        let shift = 0.5 * shrink - 0.5;
        // From device pixels to the halved photograph, whose origin is its corner.
        let smaller = Matrix3::new(shrink, 0.0, shift, 0.0, shrink, shift, 0.0, 0.0, 1.0);
        let page = Matrix3::new(
            1.0 / self.scale,
            0.0,
            0.5 / self.scale,
            0.0,
            1.0 / self.scale,
            0.5 / self.scale,
            0.0,
            0.0,
            1.0,
        );
        let from_device = smaller * photo_from_page * page;
        let clip = self.clip;
        let stride = self.pixmap.width() as usize * 4;
        let device = |value: f64| value * self.scale;
        let places: Vec<Place> = corners
            .iter()
            .map(|(x, y)| (device(*x), device(*y)))
            .collect();
        let (top, bottom) = bounds(places.iter().map(|place| place.1));
        let within = |value: f64, low: f64, high: f64, most: u32| {
            let value = value.clamp(device(low), device(high).max(device(low)));
            value.clamp(0.0, f64::from(most))
        };
        let rows = [top, bottom]
            .map(|v| within(v, clip.y, clip.bottom(), self.pixmap.height()).round() as usize);
        let columns = [clip.x, clip.right()]
            .map(|u| within(device(u), clip.x, clip.right(), self.pixmap.width()));
        let data = self.pixmap.data_mut();
        for row in rows[0]..rows[1] {
            let Some((left, right)) = span(&places, row as f64 + 0.5) else {
                continue;
            };
            let left = left.clamp(columns[0], columns[1]).round() as usize;
            let right = right.clamp(columns[0], columns[1]).round() as usize;
            if left >= right {
                continue;
            }
            let place = |column: usize| {
                let at = from_device * Vector3::new(column as f64, row as f64, 1.0);
                (at.x / at.z, at.y / at.z)
            };
            let pixels = &mut data[row * stride + 4 * left..row * stride + 4 * right];
            let mut start = place(left);
            for (piece, pixels) in pixels.chunks_mut(4 * PIECE).enumerate() {
                let count = pixels.len() / 4;
                let end = place(left + piece * PIECE + count);
                source.draw(start, end, pixels);
                start = end;
            }
        }
    }
}

/// Length of row pieces with exact positions at both ends and linear interpolation between, since a
/// division per pixel costs more than sampling. The error is at most 1/30 pixel of the photograph,
/// over a thousand device pixels with a depth ratio of two.
const PIECE: usize = 8;

/// Fractional bits of a position.
const BITS: u32 = 16;

/// A photograph that can be sampled at any position.
struct Source {
    /// Red, green and blue, sixteen bits each.
    pixels: Vec<u64>,
    width: usize,
    /// The last column and row, in units of 2⁻¹⁶.
    last: (i64, i64),
}

impl Source {
    fn new(photo: &RgbImage) -> Self {
        let (width, height) = photo.dimensions();
        let pixels = photo.as_raw().as_chunks::<3>().0;
        let spread = |&[r, g, b]: &[u8; 3]| u64::from(r) | u64::from(g) << 16 | u64::from(b) << 32;
        let last = |side: u32| i64::from(side - 1) << BITS;
        Self {
            pixels: pixels.iter().map(spread).collect(),
            width: width as usize,
            last: (last(width), last(height)),
        }
    }

    /// Draws pixels at evenly spaced positions from `start` up to `end`, the position of the next
    /// pixel.
    fn draw(&self, start: (f64, f64), end: (f64, f64), pixels: &mut [u8]) {
        let count = (pixels.len() / 4) as i64;
        // The cast makes NaN 0. Values beyond the clamp have the edge color anyway.
        let fixed = |value: f64| (value.clamp(-1e9, 1e9) * f64::from(1 << BITS) + 0.5) as i64;
        let [u0, v0, u1, v1] = [start.0, start.1, end.0, end.1].map(fixed);
        let (step_u, step_v) = ((u1 - u0) / count, (v1 - v0) / count);
        let (mut u, mut v) = (u0, v0);
        // Positions between two inside ones are also inside.
        let is_inside = |a: i64, b: i64, last: i64| a.min(b) >= 0 && a.max(b) < last;
        let are_inside = is_inside(u0, u1, self.last.0) && is_inside(v0, v1, self.last.1);
        for pixel in pixels.as_chunks_mut::<4>().0 {
            let color = match are_inside {
                true => self.color_inside(u, v),
                false => self.color(u, v),
            };
            *pixel = [color as u8, (color >> 16) as u8, (color >> 32) as u8, 255];
            (u, v) = (u + step_u, v + step_v);
        }
    }

    /// Samples the color; beyond the edge, that of the edge.
    #[inline(always)]
    fn color(&self, u: i64, v: i64) -> u64 {
        let (u, v) = (u.clamp(0, self.last.0), v.clamp(0, self.last.1));
        let (column, row) = ((u >> BITS) as usize, (v >> BITS) as usize);
        let first = row * self.width + column;
        let right = usize::from(u < self.last.0);
        let below = if v < self.last.1 { self.width } else { 0 };
        let (upper, lower) = (&self.pixels[first..], &self.pixels[first + below..]);
        let (a, b) = (upper[0], upper[right]);
        let (c, d) = (lower[0], lower[right]);
        let (across, down) = (weight(u), weight(v));
        blend(blend(a, b, across), blend(c, d, across), down)
    }

    /// Samples the color where there are pixels to the right and below.
    #[inline(always)]
    fn color_inside(&self, u: i64, v: i64) -> u64 {
        let first = (v >> BITS) as usize * self.width + (u >> BITS) as usize;
        let four = &self.pixels[first..first + self.width + 2];
        let [a, b] = [four[0], four[1]];
        let [c, d] = [four[self.width], four[self.width + 1]];
        let (across, down) = (weight(u), weight(v));
        blend(blend(a, b, across), blend(c, d, across), down)
    }
}

/// Returns the weight of the second of two neighbors, 0 to 255 of 256.
#[inline(always)]
fn weight(at: i64) -> u64 {
    ((at >> (BITS - 8)) & 0xff) as u64
}

/// Returns the photograph at half its size, averaging four pixels.
fn halved(photo: &RgbImage) -> RgbImage {
    let (width, height) = (photo.width() / 2, photo.height() / 2);
    let stride = photo.width() as usize * 3;
    let mut small = RgbImage::new(width, height);
    let rows = photo.as_raw().chunks_exact(2 * stride);
    for (target, pair) in small.chunks_exact_mut(width as usize * 3).zip(rows) {
        let (upper, lower) = pair.split_at(stride);
        let fours = upper.chunks_exact(6).zip(lower.chunks_exact(6));
        for (pixel, (upper, lower)) in target.chunks_exact_mut(3).zip(fours) {
            for channel in 0..3 {
                let four = [
                    upper[channel],
                    upper[channel + 3],
                    lower[channel],
                    lower[channel + 3],
                ];
                let sum: u16 = four.into_iter().map(u16::from).sum();
                pixel[channel] = ((sum + 2) / 4) as u8;
            }
        }
    }
    small
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// Returns the span of a horizontal line of the page within a convex polygon.
fn span(corners: &[Place], y: f64) -> Option<(f64, f64)> {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossings = sides.filter_map(|(from, to)| {
        let crosses = (from.1 <= y) != (to.1 <= y);
        crosses.then(|| from.0 + (to.0 - from.0) * (y - from.1) / (to.1 - from.1))
    });
    let (low, high) = bounds(crossings);
    (low < high).then_some((low, high))
}

fn area(corners: &[Place]) -> f64 {
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    let twice: f64 = pairs.map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum();
    0.5 * twice.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rect;
    use crate::canvas::Picture;
    use crate::theme::{Role, Theme};
    use image::Rgb;

    fn colorful(width: u32, height: u32) -> RgbImage {
        RgbImage::from_fn(width, height, |u, v| Rgb([u as u8 * 5, v as u8 * 6, 40]))
    }

    fn canvas() -> Canvas {
        Canvas::new(60.0, 40.0, 1.0, Theme::Light, Picture::default()).unwrap()
    }

    #[test]
    fn without_warp_it_is_the_image_itself() {
        let photo = colorful(40, 30);
        let corners = [(10.0, 5.0), (50.0, 5.0), (50.0, 35.0), (10.0, 35.0)];
        let shift = Matrix3::new(1.0, 0.0, -10.5, 0.0, 1.0, -5.5, 0.0, 0.0, 1.0);
        let mut warped = canvas();
        warped.warped_photograph(&corners, &shift, &photo);
        let mut plain = canvas();
        plain.photograph(Rect::new(10.0, 5.0, 40.0, 30.0), &photo);
        assert_eq!(warped.finish().rgba(), plain.finish().rgba());
    }

    #[test]
    fn it_stays_within_its_corners_and_the_clip() {
        let photo = RgbImage::from_pixel(64, 48, Rgb([1, 2, 3]));
        let corners = [(10.0, 5.0), (50.0, 12.0), (50.0, 30.0), (10.0, 35.0)];
        let mut canvas = canvas();
        canvas.clipped(Rect::new(0.0, 0.0, 40.0, 40.0), |canvas| {
            canvas.warped_photograph(&corners, &Matrix3::identity(), &photo);
        });
        let picture = canvas.finish();
        let background = Theme::Light.color(Role::Background);
        let at = |u: usize, v: usize| &picture.rgba()[4 * (60 * v + u)..][..3];
        assert_eq!([at(11, 6), at(39, 20), at(20, 20)], [&[1, 2, 3]; 3]);
        assert_eq!(
            [at(9, 20), at(41, 20), at(45, 5), at(20, 36)],
            [&background; 4]
        );
    }

    #[test]
    fn a_small_one_is_the_mean_and_a_bad_one_is_nothing() {
        let checks = RgbImage::from_fn(64, 64, |u, v| {
            Rgb([if (u + v) % 2 == 0 { 200 } else { 100 }; 3])
        });
        let corners = [(10.0, 5.0), (18.0, 5.0), (18.0, 13.0), (10.0, 13.0)];
        let scale = Matrix3::new(8.0, 0.0, -80.5, 0.0, 8.0, -40.5, 0.0, 0.0, 1.0);
        let mut small = canvas();
        small.warped_photograph(&corners, &scale, &checks);
        let picture = small.finish();
        assert_eq!(picture.rgba()[4 * (60 * 9 + 14)], 150);
        let mut bad = canvas();
        let empty = canvas().finish().hash();
        bad.warped_photograph(&[(f64::NAN, 0.0); 4], &scale, &checks);
        bad.warped_photograph(&corners, &(scale * f64::INFINITY), &checks);
        bad.warped_photograph(&corners, &scale, &RgbImage::new(0, 0));
        assert_eq!(bad.finish().hash(), empty);
        let mut invalid = canvas();
        let far = [(1e30, -1e30), (2e30, 0.0), (1e30, 1e30), (0.0, 0.0)];
        invalid.warped_photograph(&far, &scale, &checks);
        let dot = RgbImage::from_pixel(1, 1, Rgb([255; 3]));
        invalid.warped_photograph(&corners, &Matrix3::zeros(), &dot);
        assert_eq!(invalid.finish().rgba()[4 * (60 * 9 + 14)], 255);
    }
}
