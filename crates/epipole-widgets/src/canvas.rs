//! Drawing: every mark that a figure can make. The only file that names tiny-skia.
//!
//! Places and sizes are CSS pixels; the canvas knows how many device pixels each has. Lines are cut
//! at the clip rectangle by arithmetic, and a marker is drawn whole or not at all, so that no
//! costly pixel masks are needed.

mod glyphs;

use crate::contract::{Problem, Rect};
use crate::font::{self, CAP_HEIGHT};
use crate::theme::{Rgb, Role, Theme};
use image::RgbImage;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke as SkiaStroke,
    StrokeDash, Transform,
};

/// A place on the picture, CSS pixels.
pub type Place = (f64, f64);

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// What it means.
    pub role: Role,
    /// Width, CSS pixels.
    pub width: f64,
    /// Pattern.
    pub dash: Dash,
    /// Whether it has a casing, so that it can be seen on a photograph.
    pub cased: bool,
}

impl Stroke {
    /// A solid line.
    pub fn solid(role: Role, width: f64) -> Self {
        Self {
            role,
            width,
            dash: Dash::Solid,
            cased: false,
        }
    }

    /// The same line, dashed.
    pub fn dashed(self) -> Self {
        Self {
            dash: Dash::Dashed,
            ..self
        }
    }

    /// The same line, dotted.
    pub fn dotted(self) -> Self {
        Self {
            dash: Dash::Dotted,
            ..self
        }
    }

    /// The same line with a casing.
    pub fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}

/// The pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// One piece.
    Solid,
    /// Long pieces.
    Dashed,
    /// Short pieces.
    Dotted,
}

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A filled disk.
    Disk,
    /// A circle.
    Ring,
    /// A filled square.
    Square,
    /// A filled diamond.
    Diamond,
    /// A filled triangle, tip up.
    Triangle,
    /// Two crossed strokes, ×.
    Cross,
    /// Two crossed strokes, +.
    Plus,
}

impl Shape {
    /// The shape that goes with [`Role::Series`], so that hue is never the only channel.
    pub fn of_series(index: usize) -> Self {
        [
            Self::Disk,
            Self::Square,
            Self::Diamond,
            Self::Triangle,
            Self::Ring,
            Self::Plus,
        ][index % 6]
    }
}

/// Where a text lies relative to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// How a text looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// What it means.
    pub role: Role,
    /// Size, CSS pixels.
    pub size: f64,
    /// Where it lies.
    pub align: Align,
    /// Whether it has a casing, so that it can be read on a photograph or across lines.
    pub cased: bool,
}

impl TextStyle {
    /// Text that begins at its place.
    pub fn new(role: Role, size: f64) -> Self {
        Self {
            role,
            size,
            align: Align::Start,
            cased: false,
        }
    }

    /// The same text around its place.
    pub fn middle(self) -> Self {
        Self {
            align: Align::Middle,
            ..self
        }
    }

    /// The same text before its place.
    pub fn end(self) -> Self {
        Self {
            align: Align::End,
            ..self
        }
    }

    /// The same text with a casing.
    pub fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}

/// A finished picture: opaque RGBA, 8 bits a channel, rows from top to bottom. Empty by default.
#[derive(Default)]
pub struct Picture(Option<Pixmap>);

impl Picture {
    /// Width, device pixels.
    pub fn width(&self) -> u32 {
        self.0.as_ref().map_or(0, Pixmap::width)
    }

    /// Height, device pixels.
    pub fn height(&self) -> u32 {
        self.0.as_ref().map_or(0, Pixmap::height)
    }

    /// `width * height * 4` bytes. Every pixel is opaque, so premultiplied or not is the same.
    pub fn rgba(&self) -> &[u8] {
        self.0.as_ref().map_or(&[], Pixmap::data)
    }

    /// FNV-1a hash of size and pixels, to compare pictures across platforms.
    pub fn hash(&self) -> u64 {
        let sizes = [self.width(), self.height()].map(u32::to_le_bytes);
        sizes
            .iter()
            .flatten()
            .chain(self.rgba())
            .fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
            })
    }
}

/// A picture being drawn.
pub struct Canvas {
    pixmap: Pixmap,
    scale: f64,
    theme: Theme,
    clip: Rect,
}

impl Canvas {
    /// The largest side of a picture, device pixels.
    pub const MAX_SIDE: f64 = 8192.0;

    /// An empty picture of `width × height` CSS pixels with `scale` device pixels each, filled
    /// with the background. `buffer` is reused if it fits.
    ///
    /// # Errors
    /// [`Problem::BadSize`] if a side has no pixels, too many, or is not finite.
    pub fn new(
        width: f64,
        height: f64,
        scale: f64,
        theme: Theme,
        buffer: Picture,
    ) -> Result<Self, Problem> {
        let (device_width, device_height) = ((width * scale).round(), (height * scale).round());
        let bad = Problem::BadSize {
            width: device_width,
            height: device_height,
        };
        let fits = |side: f64| (1.0..=Self::MAX_SIDE).contains(&side);
        if !fits(device_width) || !fits(device_height) || !scale.is_finite() {
            return Err(bad);
        }
        let size = (device_width as u32, device_height as u32);
        let reused = buffer
            .0
            .filter(|pixmap| (pixmap.width(), pixmap.height()) == size);
        let mut pixmap = match reused {
            Some(pixmap) => pixmap,
            None => Pixmap::new(size.0, size.1).ok_or(bad)?,
        };
        pixmap.fill(skia_color(theme.color(Role::Background), 1.0));
        Ok(Self {
            pixmap,
            scale,
            theme,
            clip: Rect::new(0.0, 0.0, width, height),
        })
    }

    /// The finished picture.
    pub fn finish(self) -> Picture {
        Picture(Some(self.pixmap))
    }

    /// The reader's colors.
    pub fn theme(&self) -> Theme {
        self.theme
    }

    /// Draws with everything outside `rect` cut off.
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

    /// A filled rectangle, its sides moved to the nearest device pixels.
    pub fn fill_rect(&mut self, rect: Rect, role: Role, opacity: f64) {
        self.fill(rect, self.theme.color(role), opacity);
    }

    /// A filled rectangle in a color of a scale or of the world.
    pub fn fill_color(&mut self, rect: Rect, color: Rgb) {
        self.fill(rect, color, 1.0);
    }

    fn fill(&mut self, rect: Rect, color: Rgb, opacity: f64) {
        // Whole pixels need no coverage, so a large rectangle costs little.
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
                // The nearest whole number to sum / 255.
                *byte = ((sum + (sum >> 8)) >> 8) as u8;
            }
        }
    }

    /// A rectangle's border, inside it.
    pub fn stroke_rect(&mut self, rect: Rect, stroke: Stroke) {
        let r = rect.inset(stroke.width / 2.0);
        let corners = [
            (r.x, r.y),
            (r.right(), r.y),
            (r.right(), r.bottom()),
            (r.x, r.bottom()),
        ];
        self.polygon_outline(&corners, stroke);
    }

    /// A panel: surface and border.
    pub fn panel(&mut self, rect: Rect) {
        self.fill_rect(rect, Role::Surface, 1.0);
        self.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
    }

    /// A straight line between two places.
    pub fn line(&mut self, from: Place, to: Place, stroke: Stroke) {
        if let Some((from, to)) = clip_segment(from, to, self.clip) {
            let mut builder = PathBuilder::new();
            builder.move_to(from.0 as f32, from.1 as f32);
            builder.line_to(to.0 as f32, to.1 as f32);
            self.stroke_path(builder.finish(), stroke);
        }
    }

    /// Straight lines from place to place.
    pub fn polyline(&mut self, places: &[Place], stroke: Stroke) {
        let mut builder = PathBuilder::new();
        let mut pen: Option<Place> = None;
        for pair in places.windows(2) {
            match clip_segment(pair[0], pair[1], self.clip) {
                Some((from, to)) => {
                    if pen != Some(from) {
                        builder.move_to(from.0 as f32, from.1 as f32);
                    }
                    builder.line_to(to.0 as f32, to.1 as f32);
                    pen = Some(to);
                }
                None => pen = None,
            }
        }
        self.stroke_path(builder.finish(), stroke);
    }

    /// The outline of a polygon.
    pub fn polygon_outline(&mut self, places: &[Place], stroke: Stroke) {
        let mut closed = places.to_vec();
        closed.extend(places.first());
        self.polyline(&closed, stroke);
    }

    /// A filled polygon, convex or not, cut at the clip rectangle.
    pub fn polygon(&mut self, places: &[Place], role: Role, opacity: f64) {
        let inside = clip_polygon(places, self.clip);
        let mut builder = PathBuilder::new();
        for (index, &(x, y)) in inside.iter().enumerate() {
            if index == 0 {
                builder.move_to(x as f32, y as f32);
            } else {
                builder.line_to(x as f32, y as f32);
            }
        }
        builder.close();
        self.fill_path(builder.finish(), role, opacity);
    }

    /// A circle's outline, drawn whole if its center is inside the clip rectangle.
    pub fn circle(&mut self, center: Place, radius: f64, stroke: Stroke) {
        if self.clip.contains(center) {
            let path = PathBuilder::from_circle(center.0 as f32, center.1 as f32, radius as f32);
            self.stroke_path(path, stroke);
        }
    }

    /// A filled disk, drawn whole if its center is inside the clip rectangle.
    pub fn disk(&mut self, center: Place, radius: f64, role: Role, opacity: f64) {
        if self.clip.contains(center) {
            let path = PathBuilder::from_circle(center.0 as f32, center.1 as f32, radius as f32);
            self.fill_path(path, role, opacity);
        }
    }

    /// A small disk in a color of the world, such as a point of a colored cloud, with a rim of the
    /// theme so that it shows on any background. Made for thousands: it writes pixels itself.
    pub fn dot(&mut self, center: Place, radius: f64, color: Rgb) {
        let usable = center.0.is_finite() && center.1.is_finite() && radius.is_finite();
        if !usable || !self.clip.contains(center) {
            return;
        }
        let (x, y) = (center.0 * self.scale - 0.5, center.1 * self.scale - 0.5);
        let (x, y) = (x as f32, y as f32);
        let inner = (radius.clamp(0.5, 20.0) * self.scale) as f32;
        let outer = inner + 0.7 * self.scale as f32;
        let rim = self.theme.color(Role::Muted).map(f32::from);
        let fill = color.map(f32::from);
        let reach = outer + 0.5;
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        // Casts to an unsigned number take what is negative for 0.
        let rows = (y - reach).ceil() as u32..((y + reach) as u32).saturating_add(1).min(height);
        let data = self.pixmap.data_mut();
        for v in rows {
            let dy = v as f32 - y;
            let half = (reach * reach - dy * dy).max(0.0).sqrt();
            let first = ((x - half).ceil() as u32).min(width);
            let end = ((x + half) as u32).saturating_add(1).clamp(first, width);
            let start = 4 * (v * width + first) as usize;
            let pixels = data[start..][..4 * (end - first) as usize].chunks_exact_mut(4);
            for (u, pixel) in (first..end).zip(pixels) {
                let dx = u as f32 - x;
                let distance = (dx * dx + dy * dy).sqrt();
                let cover = |radius: f32| (radius + 0.5 - distance).clamp(0.0, 1.0);
                let (around, inside) = (0.55 * cover(outer), cover(inner));
                for (byte, (rim, fill)) in pixel.iter_mut().zip(rim.iter().zip(fill)) {
                    let behind = f32::from(*byte);
                    let rimmed = behind + (rim - behind) * around;
                    *byte = (rimmed + (fill - rimmed) * inside + 0.5) as u8;
                }
            }
        }
    }

    /// A line with an arrowhead at its end.
    pub fn arrow(&mut self, from: Place, to: Place, stroke: Stroke) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = libm::hypot(dx, dy);
        if length < 1e-9 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let head = (3.0 + 2.5 * stroke.width).min(length);
        let base = (to.0 - ux * head, to.1 - uy * head);
        let half = head * 0.45;
        let tip = [
            to,
            (base.0 - uy * half, base.1 + ux * half),
            (base.0 + uy * half, base.1 - ux * half),
        ];
        if stroke.cased {
            self.polygon_outline(&tip, Stroke::solid(Role::Halo, 2.5));
        }
        self.line(from, base, stroke);
        self.polygon(&tip, stroke.role, 1.0);
    }

    /// A marker, drawn whole if its center is inside the clip rectangle; `radius` is half its size.
    pub fn marker(&mut self, center: Place, radius: f64, shape: Shape, role: Role, cased: bool) {
        self.mark(center, radius, shape, role, cased, true);
    }

    /// The outline of a marker: the same thing, but only where it would be.
    pub fn hollow_marker(
        &mut self,
        center: Place,
        radius: f64,
        shape: Shape,
        role: Role,
        cased: bool,
    ) {
        self.mark(center, radius, shape, role, cased, false);
    }

    fn mark(
        &mut self,
        center: Place,
        radius: f64,
        shape: Shape,
        role: Role,
        cased: bool,
        filled: bool,
    ) {
        if !self.clip.contains(center) {
            return;
        }
        let (x, y, r) = (center.0 as f32, center.1 as f32, radius as f32);
        let mut builder = PathBuilder::new();
        let mut polygon = |points: &[(f32, f32)]| {
            for (index, &(px, py)) in points.iter().enumerate() {
                if index == 0 {
                    builder.move_to(x + px * r, y + py * r);
                } else {
                    builder.line_to(x + px * r, y + py * r);
                }
            }
            builder.close();
        };
        let filled = filled && !matches!(shape, Shape::Ring | Shape::Cross | Shape::Plus);
        match shape {
            Shape::Disk | Shape::Ring => builder.push_circle(x, y, r),
            Shape::Square => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            Shape::Diamond => polygon(&[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)]),
            Shape::Triangle => polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
            Shape::Cross | Shape::Plus => {
                let d = if shape == Shape::Cross {
                    (0.8, 0.8)
                } else {
                    (1.1, 0.0)
                };
                builder.move_to(x - d.0 * r, y - d.1 * r);
                builder.line_to(x + d.0 * r, y + d.1 * r);
                builder.move_to(x - d.1 * r, y + d.0 * r);
                builder.line_to(x + d.1 * r, y - d.0 * r);
            }
        }
        let Some(path) = builder.finish() else { return };
        let width = if filled {
            0.0
        } else {
            (radius * 0.45).clamp(1.25, 2.5)
        };
        if cased {
            let casing = Stroke::solid(Role::Halo, width + 3.0);
            self.stroke_plain(&path, casing.role, casing.width, Dash::Solid);
        }
        if filled {
            self.fill_path(Some(path), role, 1.0);
        } else {
            self.stroke_plain(&path, role, width, Dash::Solid);
        }
    }

    /// The mark of something that can be dragged: a disk in a ring.
    pub fn grip(&mut self, center: Place, role: Role) {
        if self.clip.contains(center) {
            self.disk(center, 8.5, Role::Halo, 0.9);
            self.circle(center, 7.0, Stroke::solid(role, 2.0));
            self.disk(center, 3.0, role, 1.0);
        }
    }

    /// A line of text; `place` is on its baseline.
    pub fn text(&mut self, place: Place, text: &str, style: TextStyle) {
        let width = text_width(text, style.size);
        let left = match style.align {
            Align::Start => place.0,
            Align::Middle => place.0 - width / 2.0,
            Align::End => place.0 - width,
        };
        let place = (left * self.scale, place.1 * self.scale);
        let size = style.size * self.scale;
        let mut draw = |casing: f64, role: Role| {
            let color = self.theme.color(role);
            glyphs::draw(&mut self.pixmap, text, place, size, casing, color);
        };
        if style.cased {
            draw(3.5 * self.scale, Role::Halo);
        }
        draw(0.0, style.role);
    }

    /// A line of text whose capitals are centered on `place` vertically.
    pub fn label(&mut self, place: Place, text: &str, style: TextStyle) {
        self.text(
            (place.0, place.1 + style.size * CAP_HEIGHT / 2.0),
            text,
            style,
        );
    }

    /// Lines of text that fill a rectangle from its top, broken between words; the height that
    /// they take.
    pub fn paragraph(&mut self, rect: Rect, text: &str, style: TextStyle) -> f64 {
        let line_height = line_height(style.size);
        let x = match style.align {
            Align::Start => rect.x,
            Align::Middle => rect.center().0,
            Align::End => rect.right(),
        };
        let lines = break_lines(text, style.size, rect.width);
        for (index, line) in lines.iter().enumerate() {
            let y = rect.y + (index as f64 + 0.5) * line_height;
            self.label((x, y), line, style);
        }
        lines.len() as f64 * line_height
    }

    /// A photograph, scaled to fill `rect`.
    ///
    /// Interpolation is bilinear in fixed-point arithmetic, so it is fast and the same everywhere.
    pub fn photograph(&mut self, rect: Rect, photograph: &RgbImage) {
        let device = |value: f64| (value * self.scale).round() as i64;
        let (left, top) = (device(rect.x), device(rect.y));
        let (right, bottom) = (device(rect.right()), device(rect.bottom()));
        let (pixmap_width, pixmap_height) = (
            i64::from(self.pixmap.width()),
            i64::from(self.pixmap.height()),
        );
        let (photo_width, photo_height) = photograph.dimensions();
        if right <= left || bottom <= top || photo_width == 0 || photo_height == 0 {
            return;
        }
        let columns = Taps::new(left, right, photo_width, 0..pixmap_width);
        let rows = Taps::new(top, bottom, photo_height, 0..pixmap_height);
        let stride = photo_width as usize * 3;
        let mut source = vec![0u32; photo_width as usize];
        let mut across = |row: usize, stretched: &mut [u8]| {
            let bytes = &photograph.as_raw()[row * stride..][..stride];
            for (pixel, rgb) in source.iter_mut().zip(bytes.chunks_exact(3)) {
                *pixel = u32::from_le_bytes([rgb[0], rgb[1], rgb[2], 255]);
            }
            for (pixel, column) in stretched.chunks_exact_mut(4).zip(&columns.taps) {
                let (a, b) = (source[column.first], source[column.second]);
                pixel.copy_from_slice(&blend(a, b, column.weight_256.into()).to_le_bytes());
            }
        };
        // Two neighboring rows of the photograph, stretched to the target's width and kept while
        // they last, then blended: the inner loop runs along memory.
        let length = columns.taps.len() * 4;
        let mut stretched = [(); 2].map(|()| (usize::MAX, vec![0u8; length]));
        let target_stride = self.pixmap.width() as usize * 4;
        let target = self.pixmap.data_mut();
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
                let sum = u16::from(a) * (256 - weight) + u16::from(b) * weight;
                *byte = ((sum + 128) >> 8) as u8;
            }
        }
    }

    fn transform(&self) -> Transform {
        Transform::from_scale(self.scale as f32, self.scale as f32)
    }

    fn paint(&self, role: Role, opacity: f64) -> Paint<'static> {
        let mut paint = Paint::default();
        paint.set_color(skia_color(self.theme.color(role), opacity));
        paint.anti_alias = true;
        paint
    }

    fn fill_path(&mut self, path: Option<Path>, role: Role, opacity: f64) {
        if let Some(path) = path {
            let paint = self.paint(role, opacity);
            self.pixmap
                .fill_path(&path, &paint, FillRule::Winding, self.transform(), None);
        }
    }

    fn stroke_path(&mut self, path: Option<Path>, stroke: Stroke) {
        let Some(path) = path else { return };
        if stroke.cased {
            self.stroke_plain(&path, Role::Halo, stroke.width + 2.5, Dash::Solid);
        }
        self.stroke_plain(&path, stroke.role, stroke.width, stroke.dash);
    }

    fn stroke_plain(&mut self, path: &Path, role: Role, width: f64, dash: Dash) {
        let width = width as f32;
        let pattern = match dash {
            Dash::Solid => None,
            Dash::Dashed => StrokeDash::new(vec![6.0 + width, 4.0 + width], 0.0),
            Dash::Dotted => StrokeDash::new(vec![1.2 * width, 2.5 + 1.5 * width], 0.0),
        };
        // Round ends on every dot would cost more than the rest of the picture.
        let cap = if dash == Dash::Solid {
            LineCap::Round
        } else {
            LineCap::Butt
        };
        let skia_stroke = SkiaStroke {
            width,
            line_cap: cap,
            line_join: LineJoin::Round,
            dash: pattern,
            ..SkiaStroke::default()
        };
        let paint = self.paint(role, 1.0);
        self.pixmap
            .stroke_path(path, &paint, &skia_stroke, self.transform(), None);
    }
}

/// Width of a line of text, CSS pixels.
pub fn text_width(text: &str, size: f64) -> f64 {
    font::width(text) * size
}

/// Height of a paragraph of this width, CSS pixels.
pub fn paragraph_height(text: &str, size: f64, width: f64) -> f64 {
    break_lines(text, size, width).len() as f64 * line_height(size)
}

fn line_height(size: f64) -> f64 {
    (size * 1.4).round()
}

/// Lines of text no wider than `width`, broken between words; a longer word has its own line.
fn break_lines(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), size) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn skia_color([r, g, b]: Rgb, opacity: f64) -> Color {
    Color::from_rgba8(r, g, b, (opacity.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// `(a (256 − weight) + b weight) / 256` of each of four bytes, rounded. Sixteen bits hold
/// 255 · 256, so two bytes are blended at once.
#[inline]
fn blend(a: u32, b: u32, weight_256: u32) -> u32 {
    const EVEN: u32 = 0x00ff_00ff;
    const HALF: u32 = 0x0080_0080;
    let mix = |a: u32, b: u32| (a & EVEN) * (256 - weight_256) + (b & EVEN) * weight_256 + HALF;
    ((mix(a, b) >> 8) & EVEN) | (mix(a >> 8, b >> 8) & !EVEN)
}

/// Where each device pixel along one side takes its color from.
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
    fn new(start: i64, end: i64, source_len: u32, visible: std::ops::Range<i64>) -> Self {
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
}

/// The part of a segment inside a rectangle.
///
/// Source: Liang & Barsky 1984, "A new concept and method for line clipping".
fn clip_segment(from: Place, to: Place, clip: Rect) -> Option<(Place, Place)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if !(dx.is_finite() && dy.is_finite() && from.0.is_finite() && from.1.is_finite()) {
        return None;
    }
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (p, q) in [
        (-dx, from.0 - clip.x),
        (dx, clip.right() - from.0),
        (-dy, from.1 - clip.y),
        (dy, clip.bottom() - from.1),
    ] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            enter = enter.max(q / p);
        } else {
            leave = leave.min(q / p);
        }
    }
    let at = |s: f64| (from.0 + s * dx, from.1 + s * dy);
    let start = if enter > 0.0 { at(enter) } else { from };
    let end = if leave < 1.0 { at(leave) } else { to };
    (enter <= leave).then_some((start, end))
}

/// The part of a polygon inside a rectangle.
///
/// Source: Sutherland & Hodgman 1974, "Reentrant polygon clipping".
fn clip_polygon(places: &[Place], clip: Rect) -> Vec<Place> {
    if places.iter().any(|p| !p.0.is_finite() || !p.1.is_finite()) {
        return Vec::new();
    }
    let sides: [fn(Place, Rect) -> f64; 4] = [
        |p, r| p.0 - r.x,
        |p, r| r.right() - p.0,
        |p, r| p.1 - r.y,
        |p, r| r.bottom() - p.1,
    ];
    let mut inside = places.to_vec();
    for depth in sides {
        let before = std::mem::take(&mut inside);
        for (index, &to) in before.iter().enumerate() {
            let from = before[(index + before.len() - 1) % before.len()];
            let (d0, d1) = (depth(from, clip), depth(to, clip));
            if (d0 >= 0.0) != (d1 >= 0.0) {
                let s = d0 / (d0 - d1);
                inside.push((from.0 + s * (to.0 - from.0), from.1 + s * (to.1 - from.1)));
            }
            if d1 >= 0.0 {
                inside.push(to);
            }
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLIP: Rect = Rect {
        x: 0.0,
        y: 0.0,
        width: 10.0,
        height: 10.0,
    };

    #[test]
    fn segments_are_cut_at_the_clip_rectangle() {
        let cut = clip_segment((-10.0, 5.0), (20.0, 5.0), CLIP);
        assert_eq!(cut, Some(((0.0, 5.0), (10.0, 5.0))));
        assert_eq!(clip_segment((-1.0, -1.0), (-5.0, 20.0), CLIP), None);
        assert_eq!(clip_segment((f64::NAN, 0.0), (1.0, 1.0), CLIP), None);
        assert_eq!(clip_segment((f64::INFINITY, 0.0), (1.0, 1.0), CLIP), None);
    }

    #[test]
    fn polygons_are_cut_at_the_clip_rectangle() {
        let cut = clip_polygon(
            &[(-5.0, -5.0), (15.0, -5.0), (15.0, 15.0), (-5.0, 15.0)],
            CLIP,
        );
        let area = cut
            .iter()
            .zip(cut.iter().cycle().skip(1))
            .map(|(a, b)| a.0 * b.1 - b.0 * a.1)
            .sum::<f64>()
            / 2.0;
        assert_eq!(area, 100.0);
    }

    #[test]
    fn text_is_broken_between_words() {
        let lines = break_lines("one two three four", 10.0, text_width("one two", 10.0));
        assert_eq!(lines, ["one two", "three", "four"]);
        assert_eq!(break_lines("long", 10.0, 1.0), ["long"]);
        assert!(break_lines(" ", 10.0, 50.0).is_empty());
    }

    #[test]
    fn a_rectangle_fills_whole_pixels() {
        let mut canvas = Canvas::new(6.0, 4.0, 2.0, Theme::Dark, Picture::default()).unwrap();
        canvas.fill_rect(Rect::new(1.1, 0.9, 2.0, 50.0), Role::Ink, 1.0);
        canvas.fill_rect(Rect::new(4.0, 0.0, 1.0, 1.0), Role::Ink, 0.5);
        canvas.fill_rect(Rect::new(f64::NAN, 0.0, 1.0, f64::INFINITY), Role::Ink, 1.0);
        let pixmap = canvas.finish().0.unwrap();
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
                matches!(canvas, Err(Problem::BadSize { .. })),
                "{width} {height} {scale}"
            );
        }
    }

    #[test]
    fn a_photograph_at_its_own_size_keeps_its_pixels() {
        let photograph =
            RgbImage::from_fn(7, 5, |x, y| image::Rgb([x as u8 * 30, y as u8 * 40, 9]));
        let mut canvas = Canvas::new(9.0, 7.0, 1.0, Theme::Light, Picture::default()).unwrap();
        canvas.photograph(Rect::new(1.0, 1.0, 7.0, 5.0), &photograph);
        let pixmap = canvas.finish().0.unwrap();
        for (x, y, pixel) in photograph.enumerate_pixels() {
            let drawn = pixmap.pixel(x + 1, y + 1).unwrap();
            assert_eq!([drawn.red(), drawn.green(), drawn.blue()], pixel.0);
        }
    }

    #[test]
    fn a_photograph_hanging_over_the_edge_is_cut() {
        let photograph = RgbImage::from_pixel(8, 8, image::Rgb([10, 20, 30]));
        let mut canvas = Canvas::new(6.0, 6.0, 2.0, Theme::Light, Picture::default()).unwrap();
        canvas.photograph(Rect::new(-3.0, -3.0, 20.0, 6.0), &photograph);
        let pixmap = canvas.finish().0.unwrap();
        let drawn = pixmap.pixel(0, 0).unwrap();
        assert_eq!([drawn.red(), drawn.green(), drawn.blue()], [10, 20, 30]);
    }
}
