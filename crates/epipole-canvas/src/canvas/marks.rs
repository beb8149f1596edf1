//! Marks at one point: arrows, markers, grips and the dots of clouds.

use super::{Canvas, Place, Shape, Stroke, markers};
use crate::theme::{Rgb, Role};

impl Canvas {
    /// Draws a line with an arrowhead at its end.
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

    /// Draws a marker, whole if its center is inside the clip rectangle; `radius` is half its size.
    pub fn marker(&mut self, center: Place, radius: f64, shape: Shape, role: Role, cased: bool) {
        self.mark(center, radius, shape, role, cased, true);
    }

    /// Draws the outline of a marker, for a point that does not exist yet.
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
        let filled = filled && !matches!(shape, Shape::Ring | Shape::Cross | Shape::Plus);
        let width = if filled {
            0.0
        } else {
            (radius * 0.45).clamp(1.25, 2.5)
        };
        if cased {
            markers::draw(self, center, radius, shape, width + 3.0, Role::Halo);
        }
        markers::draw(self, center, radius, shape, width, role);
    }

    /// Draws the mark of a draggable point: a disk in a ring.
    pub fn grip(&mut self, center: Place, role: Role) {
        if self.clip.contains(center) {
            self.disk(center, 8.5, Role::Halo, 0.9);
            self.circle(center, 7.0, Stroke::solid(role, 2.0));
            self.disk(center, 3.0, role, 1.0);
        }
    }

    /// Draws a small disk in a fixed color, such as a point of a colored cloud, with a rim of the
    /// theme for contrast on any background. Fast enough for thousands.
    pub fn dot(&mut self, center: Place, radius: f64, color: Rgb) {
        if self.clip.contains(center) && radius.is_finite() {
            markers::draw_dot(self, center, radius.clamp(0.5, 20.0), color);
        }
    }

    /// Draws a small square of whole device pixels in a fixed color, such as a point of a surface,
    /// so that neighbors merge; `side` in CSS pixels. Fast enough for tens of thousands.
    pub fn speck(&mut self, center: Place, side: f64, color: Rgb) {
        if !self.clip.contains(center) || !side.is_finite() {
            return;
        }
        let side = side.clamp(0.5, 40.0);
        let num_pixels = (side * self.scale).round().max(1.0);
        let device = |middle: f64, clip: (f64, f64)| {
            // Equals `round` for positions on the picture; `round` is a call in WebAssembly.
            let first = (self.scale * (middle - side / 2.0) + 0.5).floor();
            let low = first.max((clip.0 * self.scale).round()).max(0.0);
            let high = (first + num_pixels).min((clip.1 * self.scale).round());
            low as usize..high.max(low) as usize
        };
        let columns = device(center.0, (self.clip.x, self.clip.right()));
        let rows = device(center.1, (self.clip.y, self.clip.bottom()));
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        let columns = columns.start..columns.end.min(width);
        let [r, g, b] = color;
        let data = self.pixmap.data_mut();
        for row in rows.start..rows.end.min(height) {
            let start = 4 * (row * width + columns.start);
            for pixel in data[start..start + 4 * columns.len()].as_chunks_mut().0 {
                *pixel = [r, g, b, 255];
            }
        }
    }
}
