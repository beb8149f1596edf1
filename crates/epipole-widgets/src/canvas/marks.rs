//! Marks of one place: arrows, markers, grips and the dots of clouds.

use super::{Canvas, Place, Shape, Stroke, markers};
use crate::theme::{Rgb, Role};

impl Canvas {
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

    /// The mark of something that can be dragged: a disk in a ring.
    pub fn grip(&mut self, center: Place, role: Role) {
        if self.clip.contains(center) {
            self.disk(center, 8.5, Role::Halo, 0.9);
            self.circle(center, 7.0, Stroke::solid(role, 2.0));
            self.disk(center, 3.0, role, 1.0);
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
}
