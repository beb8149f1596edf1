//! Lines between points: straight, dashed, around polygons and circles.

use super::clip::clip_segment;
use super::coverage::Coverage;
use super::strokes::Cap;
use super::{Canvas, Dash, Place, Stroke};
use crate::Rect;
use crate::theme::Role;

/// Extra width of a casing over its line, CSS pixels.
const CASING: f64 = 2.5;

impl Canvas {
    /// Draws a straight line between two points.
    pub fn line(&mut self, from: Place, to: Place, stroke: Stroke) {
        self.polyline(&[from, to], stroke);
    }

    /// Draws straight lines from point to point.
    pub fn polyline(&mut self, places: &[Place], stroke: Stroke) {
        if stroke.cased {
            self.stroke_plain(places, Role::Halo, stroke.width + CASING, Dash::Solid);
        }
        self.stroke_plain(places, stroke.role, stroke.width, stroke.dash);
    }

    /// Draws the outline of a polygon.
    pub fn polygon_outline(&mut self, places: &[Place], stroke: Stroke) {
        let mut closed = places.to_vec();
        closed.extend(places.first());
        self.polyline(&closed, stroke);
    }

    /// Draws a rectangle's border, inside it.
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

    /// Draws a circle, whole if its center is inside the clip rectangle; never dashed.
    pub fn circle(&mut self, center: Place, radius: f64, stroke: Stroke) {
        if !self.clip.contains(center) {
            return;
        }
        if stroke.cased {
            self.ring(center, radius, Role::Halo, stroke.width + CASING);
        }
        self.ring(center, radius, stroke.role, stroke.width);
    }

    pub(super) fn ring(&mut self, center: Place, radius: f64, role: Role, width: f64) {
        let scale = self.scale;
        let at = self.device(center);
        self.cover(role, 1.0, |coverage| {
            coverage.add_ring(at, (radius * scale) as f32, (width * scale) as f32);
        });
    }

    pub(super) fn stroke_plain(&mut self, places: &[Place], role: Role, width: f64, dash: Dash) {
        let (scale, clip) = (self.scale, self.clip);
        let device = |place: Place| ((place.0 * scale) as f32, (place.1 * scale) as f32);
        let thick = (width * scale) as f32;
        // Round caps would turn dashes into dots.
        let cap = if dash == Dash::Solid {
            Cap::Round
        } else {
            Cap::Flat
        };
        let add = |coverage: &mut Coverage, from: Place, to: Place| {
            coverage.add_segment(device(from), device(to), thick, cap);
        };
        let pieces = places
            .windows(2)
            .filter_map(|pair| clip_segment(pair[0], pair[1], clip));
        self.cover(role, 1.0, |coverage| match pattern(dash, width) {
            None => pieces.for_each(|(from, to)| add(coverage, from, to)),
            Some(pattern) => cut(pieces, pattern, |from, to, goes_on| {
                add(coverage, from, to);
                if goes_on {
                    coverage.add_disk(device(from), thick / 2.0);
                }
            }),
        });
    }
}

/// Returns the length of a dash and of the gap after it, CSS pixels.
fn pattern(dash: Dash, width: f64) -> Option<(f64, f64)> {
    match dash {
        Dash::Solid => None,
        Dash::Dashed => Some((6.0 + width, 4.0 + width)),
        Dash::Dotted => Some((1.2 * width, 2.5 + 1.5 * width)),
    }
}

/// Cuts lines into dashes. The pattern continues where a line begins at the end of another, and
/// each dash reports whether it continues around the corner.
fn cut(
    pieces: impl Iterator<Item = (Place, Place)>,
    (on, gap): (f64, f64),
    mut dash: impl FnMut(Place, Place, bool),
) {
    let mut phase = 0.0;
    let mut pen = None;
    for (from, to) in pieces {
        if pen != Some(from) {
            phase = 0.0;
        }
        pen = Some(to);
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = libm::hypot(dx, dy);
        if length == 0.0 {
            continue;
        }
        let at = |s: f64| (from.0 + dx * s / length, from.1 + dy * s / length);
        let mut start = -phase;
        while start < length {
            if start + on > 0.0 {
                dash(
                    at(start.max(0.0)),
                    at((start + on).min(length)),
                    start < 0.0,
                );
            }
            start += on + gap;
        }
        phase = length - (start - on - gap);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_on_around_a_corner_and_begin_anew_after_a_break() {
        let lines = [
            ((0.0, 0.0), (5.0, 0.0)),
            ((5.0, 0.0), (5.0, 5.0)),
            ((9.0, 9.0), (12.0, 9.0)),
        ];
        let mut dashes = Vec::new();
        cut(lines.into_iter(), (2.0, 1.5), |from, to, goes_on| {
            dashes.push((from, to, goes_on));
        });
        let expected = [
            ((0.0, 0.0), (2.0, 0.0), false),
            ((3.5, 0.0), (5.0, 0.0), false),
            ((5.0, 0.0), (5.0, 0.5), true),
            ((5.0, 2.0), (5.0, 4.0), false),
            ((9.0, 9.0), (11.0, 9.0), false),
        ];
        assert_eq!(dashes, expected);
    }
}
