//! Photographs, scaled to their rectangle in the picture.

use super::Canvas;
use super::scaled::Target;
use crate::Rect;
use image::RgbImage;
use std::ops::Range;

impl Canvas {
    /// Draws a photograph, scaled to fill `rect`.
    ///
    /// Interpolation is bilinear in fixed-point arithmetic: fast, and identical on all platforms.
    pub fn photograph(&mut self, rect: Rect, photo: &RgbImage) {
        let device = |value: f64| (value * self.scale).round() as i64;
        let (left, top) = (device(rect.x), device(rect.y));
        let (right, bottom) = (device(rect.right()), device(rect.bottom()));
        let (pixmap_width, pixmap_height) = (
            i64::from(self.pixmap.width()),
            i64::from(self.pixmap.height()),
        );
        let (photo_width, photo_height) = photo.dimensions();
        if right <= left || bottom <= top || photo_width == 0 || photo_height == 0 {
            return;
        }
        let columns = Taps::new(left, right, photo_width, 0..pixmap_width);
        let rows = Taps::new(top, bottom, photo_height, 0..pixmap_height);
        if columns.taps.is_empty() || rows.taps.is_empty() {
            return;
        }
        let target = Target {
            requested: [left, top, right, bottom],
            columns: columns.visible(),
            rows: rows.visible(),
        };
        let stride = self.pixmap.width() as usize * 4;
        let picture = (self.pixmap.data_mut(), stride);
        self.scaled.draw(photo, target, picture, |picture| {
            scale(photo, &columns, &rows, (picture, stride));
        });
    }
}

/// Draws the photograph into RGBA bytes, with the stride in bytes.
fn scale(
    photo: &RgbImage,
    columns: &Taps,
    rows: &Taps,
    (target, target_stride): (&mut [u8], usize),
) {
    let stride = photo.width() as usize * 3;
    let photo_width = photo.width();
    let mut source = vec![0u64; photo_width as usize];
    let mut across = |row: usize, stretched: &mut [u16]| {
        let bytes = &photo.as_raw()[row * stride..][..stride];
        for (pixel, rgb) in source.iter_mut().zip(bytes.chunks_exact(3)) {
            let [r, g, b] = [rgb[0], rgb[1], rgb[2]].map(u64::from);
            *pixel = r | g << 16 | b << 32 | 255 << 48;
        }
        for (pixel, column) in stretched.chunks_exact_mut(4).zip(&columns.taps) {
            let (a, b) = (source[column.first], source[column.second]);
            let mixed = blend(a, b, column.weight_256.into());
            pixel.copy_from_slice(&[0, 16, 32, 48].map(|bits| (mixed >> bits) as u16));
        }
    };
    // Stretches two neighboring rows of the photograph to the target's width, keeps them while
    // needed, and blends them, so that the inner loop accesses memory in order.
    let length = columns.taps.len() * 4;
    let mut stretched = [(); 2].map(|()| (usize::MAX, vec![0u16; length]));
    for (y, tap) in rows.taps.iter().enumerate() {
        if stretched[1].0 == tap.first {
            stretched.swap(0, 1);
        }
        for ((known, row), wanted) in stretched.iter_mut().zip([tap.first, tap.second]) {
            if *known != wanted {
                across(wanted, row);
                *known = wanted;
            }
        }
        let start = (rows.begin as usize + y) * target_stride + columns.begin as usize * 4;
        let weight = tap.weight_256;
        let (upper, lower) = (&stretched[0].1[..length], &stretched[1].1[..length]);
        let bytes = &mut target[start..][..length];
        for ((byte, &a), &b) in bytes.iter_mut().zip(upper).zip(lower) {
            // As in `blend`.
            let sum = (a << 8).wrapping_add(b.wrapping_sub(a).wrapping_mul(weight));
            *byte = (sum.wrapping_add(128) >> 8) as u8;
        }
    }
}

/// Returns `(a (256 − weight) + b weight) / 256`, rounded, of four packed 16-bit numbers, which
/// hold up to 255 · 256.
#[inline]
pub(super) fn blend(a: u64, b: u64, weight_256: u64) -> u64 {
    const LOW: u64 = 0x00ff_00ff_00ff_00ff;
    const HALF: u64 = 0x0080_0080_0080_0080;
    // Equals 256 a + (b − a) weight, with one multiplication less. The difference may wrap; the sum
    // wraps back.
    let sum = (a << 8).wrapping_add(b.wrapping_sub(a).wrapping_mul(weight_256));
    (sum.wrapping_add(HALF) >> 8) & LOW
}

/// Interpolation taps of each device pixel along one side.
struct Taps {
    begin: i64,
    taps: Vec<Tap>,
}

struct Tap {
    first: usize,
    second: usize,
    /// Weight of `second`, 0 to 256.
    weight_256: u16,
}

impl Taps {
    fn new(start: i64, end: i64, source_len: u32, visible: Range<i64>) -> Self {
        let step = f64::from(source_len) / (end - start) as f64;
        let last = f64::from(source_len) - 1.0;
        let begin = start.max(visible.start);
        let taps = (begin..end.min(visible.end))
            .map(|pixel| {
                let at = (((pixel - start) as f64 + 0.5) * step - 0.5).clamp(0.0, last);
                let first = at.floor();
                Tap {
                    first: first as usize,
                    second: (first as usize + 1).min(source_len as usize - 1),
                    weight_256: ((at - first) * 256.0).round() as u16,
                }
            })
            .collect();
        Self { begin, taps }
    }

    /// Returns the range of device pixels.
    fn visible(&self) -> Range<usize> {
        let begin = self.begin as usize;
        begin..begin + self.taps.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Picture;
    use crate::theme::Theme;

    #[test]
    fn an_image_at_its_own_size_keeps_its_pixels() {
        let photo = RgbImage::from_fn(7, 5, |x, y| image::Rgb([x as u8 * 30, y as u8 * 40, 9]));
        let mut canvas = Canvas::new(9.0, 7.0, 1.0, Theme::Light, Picture::default()).unwrap();
        canvas.photograph(Rect::new(1.0, 1.0, 7.0, 5.0), &photo);
        let pixmap = canvas.finish().pixmap.unwrap();
        for (x, y, pixel) in photo.enumerate_pixels() {
            let drawn = pixmap.pixel(x + 1, y + 1).unwrap();
            assert_eq!([drawn.red(), drawn.green(), drawn.blue()], pixel.0);
        }
    }

    #[test]
    fn an_image_over_the_edge_is_clipped() {
        let photo = RgbImage::from_pixel(8, 8, image::Rgb([10, 20, 30]));
        let mut canvas = Canvas::new(6.0, 6.0, 2.0, Theme::Light, Picture::default()).unwrap();
        canvas.photograph(Rect::new(-3.0, -3.0, 20.0, 6.0), &photo);
        let pixmap = canvas.finish().pixmap.unwrap();
        let drawn = pixmap.pixel(0, 0).unwrap();
        assert_eq!([drawn.red(), drawn.green(), drawn.blue()], [10, 20, 30]);
    }
}
