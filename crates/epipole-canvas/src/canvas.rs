//! Drawing of all marks of figures. The only module that uses tiny-skia.
//!
//! Positions and sizes are in CSS pixels, converted by the canvas to device pixels. Lines are
//! clipped analytically, and a marker is drawn whole or not at all, which avoids costly pixel
//! masks.

mod clip;
mod coverage;
mod edge;
mod glyphs;
mod lines;
mod markers;
mod marks;
mod photograph;
mod picture;
mod place;
mod polygons;
mod scaled;
mod stamp;
mod strokes;
mod style;
mod text;
mod warped;

pub use picture::Picture;
pub use place::Place;
pub use style::{Align, Dash, Shape, Stroke, TextStyle};
pub use text::{paragraph_height, text_width};

use crate::Rect;
use crate::theme::{Rgb, Role, Theme};
use clip::clip_polygon;
use coverage::Coverage;
use place::At;
use scaled::Scaled;
use tiny_skia::{Color, Pixmap};

/// Error for a size at which no picture can be drawn.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("a picture of {width} by {height} pixels cannot be drawn; both sides must be 1 to 8192")]
pub struct BadSize {
    /// Width in device pixels.
    pub width: f64,
    /// Height in device pixels.
    pub height: f64,
}

/// A picture being drawn.
pub struct Canvas {
    pixmap: Pixmap,
    coverage: Coverage,
    scaled: Scaled,
    scale: f64,
    theme: Theme,
    clip: Rect,
}

impl Canvas {
    /// Maximum side of a picture, device pixels.
    pub const MAX_SIDE: f64 = 8192.0;

    /// Creates an empty picture of `width × height` CSS pixels with `scale` device pixels each,
    /// filled with the background. `buffer` is reused if it fits.
    ///
    /// # Errors
    /// [`BadSize`] if a side has no pixels, too many, or is not finite.
    pub fn new(
        width: f64,
        height: f64,
        scale: f64,
        theme: Theme,
        buffer: Picture,
    ) -> Result<Self, BadSize> {
        let (device_width, device_height) = ((width * scale).round(), (height * scale).round());
        let bad = BadSize {
            width: device_width,
            height: device_height,
        };
        let fits = |side: f64| (1.0..=Self::MAX_SIDE).contains(&side);
        if !fits(device_width) || !fits(device_height) || !scale.is_finite() {
            return Err(bad);
        }
        let size = (device_width as u32, device_height as u32);
        let reused = buffer
            .pixmap
            .filter(|pixmap| (pixmap.width(), pixmap.height()) == size);
        let mut pixmap = match reused {
            Some(pixmap) => pixmap,
            None => Pixmap::new(size.0, size.1).ok_or(bad)?,
        };
        let [r, g, b] = theme.color(Role::Background);
        pixmap.fill(Color::from_rgba8(r, g, b, 255));
        Ok(Self {
            pixmap,
            coverage: buffer.coverage.sized(size.0 as usize, size.1 as usize),
            scaled: buffer.scaled,
            scale,
            theme,
            clip: Rect::new(0.0, 0.0, width, height),
        })
    }

    /// Returns the finished picture.
    pub fn finish(self) -> Picture {
        Picture {
            pixmap: Some(self.pixmap),
            coverage: self.coverage,
            scaled: self.scaled.after_frame(),
        }
    }

    /// Returns the reader's theme.
    pub fn theme(&self) -> Theme {
        self.theme
    }

    /// Draws with everything outside `rect` clipped.
    pub fn clipped(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let outer = self.clip;
        let (left, top) = (rect.x.max(outer.x), rect.y.max(outer.y));
        let (right, bottom) = (
            rect.right().min(outer.right()),
            rect.bottom().min(outer.bottom()),
        );
        self.clip = Rect::new(left, top, (right - left).max(0.0), (bottom - top).max(0.0));
        draw(self);
        self.clip = outer;
    }

    /// Fills a rectangle, with its sides rounded to device pixels.
    pub fn fill_rect(&mut self, rect: Rect, role: Role, opacity: f64) {
        self.fill(rect, self.theme.color(role), opacity);
    }

    /// Fills a rectangle with a color of a scale or of the world.
    pub fn fill_color(&mut self, rect: Rect, color: Rgb) {
        self.fill(rect, color, 1.0);
    }

    fn fill(&mut self, rect: Rect, color: Rgb, opacity: f64) {
        // Whole pixels need no coverage, which makes a large rectangle cheap.
        let device = |low: f64, high: f64, clip: (f64, f64), most: u32| {
            let is_number = !low.is_nan() && !high.is_nan();
            let (low, high) = (low.max(clip.0), high.min(clip.1));
            if !is_number || low >= high {
                return 0..0;
            }
            let start = (low * self.scale).round();
            let end = (high * self.scale).round().max(start + 1.0);
            let most = f64::from(most);
            start.clamp(0.0, most) as usize..end.clamp(0.0, most) as usize
        };
        let (clip, width) = (self.clip, self.pixmap.width() as usize);
        let columns = device(
            rect.x,
            rect.right(),
            (clip.x, clip.right()),
            self.pixmap.width(),
        );
        let rows = device(
            rect.y,
            rect.bottom(),
            (clip.y, clip.bottom()),
            self.pixmap.height(),
        );
        let [r, g, b] = color;
        let alpha = (opacity.clamp(0.0, 1.0) * 255.0).round() as u16;
        let color = [r, g, b, 255].repeat(columns.len());
        let added: Vec<u16> = color
            .iter()
            .map(|&channel| u16::from(channel) * alpha + 128)
            .collect();
        let data = self.pixmap.data_mut();
        for row in rows {
            let start = (row * width + columns.start) * 4;
            let bytes = &mut data[start..start + color.len()];
            if alpha == 255 {
                bytes.copy_from_slice(&color);
                continue;
            }
            for (byte, &added) in bytes.iter_mut().zip(&added) {
                let sum = added + u16::from(*byte) * (255 - alpha);
                // The nearest integer to sum / 255.
                *byte = ((sum + (sum >> 8)) >> 8) as u8;
            }
        }
    }

    /// Draws a panel: surface and border.
    pub fn panel(&mut self, rect: Rect) {
        self.fill_rect(rect, Role::Surface, 1.0);
        self.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
    }

    /// Fills a polygon, convex or not, clipped to the clip rectangle.
    pub fn polygon(&mut self, places: &[Place], role: Role, opacity: f64) {
        self.fill_polygon(places, self.theme.color(role), opacity);
    }

    /// Fills a polygon with a color of a scale or of the world.
    pub fn polygon_color(&mut self, places: &[Place], color: Rgb) {
        self.fill_polygon(places, color, 1.0);
    }

    fn fill_polygon(&mut self, places: &[Place], color: Rgb, opacity: f64) {
        let inside = clip_polygon(places, self.clip);
        let corners: Vec<At> = inside.into_iter().map(|place| self.device(place)).collect();
        self.coverage.add_polygon(&corners);
        self.coverage.blend(self.pixmap.data_mut(), color, opacity);
    }

    /// Fills a disk, drawn whole if its center is inside the clip rectangle.
    pub fn disk(&mut self, center: Place, radius: f64, role: Role, opacity: f64) {
        if self.clip.contains(center) {
            let (at, radius) = (self.device(center), (radius * self.scale) as f32);
            self.cover(role, opacity, |coverage| coverage.add_disk(at, radius));
        }
    }

    fn device(&self, place: Place) -> At {
        ((place.0 * self.scale) as f32, (place.1 * self.scale) as f32)
    }

    /// Blends the color of a role where `add` covers the picture.
    fn cover(&mut self, role: Role, opacity: f64, add: impl FnOnce(&mut Coverage)) {
        add(&mut self.coverage);
        let color = self.theme.color(role);
        self.coverage.blend(self.pixmap.data_mut(), color, opacity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_fills_whole_pixels() {
        let mut canvas = Canvas::new(6.0, 4.0, 2.0, Theme::Dark, Picture::default()).unwrap();
        canvas.fill_rect(Rect::new(1.1, 0.9, 2.0, 50.0), Role::Ink, 1.0);
        canvas.fill_rect(Rect::new(4.0, 0.0, 1.0, 1.0), Role::Ink, 0.5);
        canvas.fill_rect(Rect::new(f64::NAN, 0.0, 1.0, f64::INFINITY), Role::Ink, 1.0);
        let pixmap = canvas.finish().pixmap.unwrap();
        let red = |x, y| pixmap.pixel(x, y).unwrap().red();
        let [ink, behind] = [Role::Ink, Role::Background].map(|role| Theme::Dark.color(role)[0]);
        assert_eq!([red(1, 5), red(2, 1), red(6, 5)], [behind; 3]);
        assert_eq!([red(2, 2), red(5, 7)], [ink; 2]);
        let middle = (u16::from(ink) + u16::from(behind)) / 2;
        assert!(u16::from(red(8, 0)).abs_diff(middle) <= 1);
    }

    #[test]
    fn bad_sizes_are_refused_with_a_sentence() {
        for (width, height, scale) in [
            (0.0, 10.0, 1.0),
            (10.0, f64::NAN, 1.0),
            (1e9, 10.0, 1.0),
            (10.0, 10.0, -1.0),
        ] {
            let canvas = Canvas::new(width, height, scale, Theme::Light, Picture::default());
            assert!(
                matches!(canvas, Err(BadSize { .. })),
                "{width} {height} {scale}"
            );
        }
    }
}
