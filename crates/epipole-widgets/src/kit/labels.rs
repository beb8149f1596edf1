//! Placement of labels beside marks, without overlaps if possible.

use crate::canvas::{Align, Canvas, Place, TextStyle, text_width};
use crate::contract::Rect;
use crate::theme::Role;

/// Margin around a label, CSS pixels.
const MARGIN: f64 = 3.0;

/// Labels of one panel.
pub(crate) struct Labels {
    bounds: Rect,
    taken: Vec<Rect>,
}

impl Labels {
    /// Creates an empty set of labels within `bounds`.
    pub(crate) fn new(bounds: Rect) -> Self {
        Self {
            bounds,
            taken: Vec::new(),
        }
    }

    /// Keeps labels off a mark.
    pub(crate) fn keep_free(&mut self, center: Place, radius: f64) {
        let (x, y) = (center.0 - radius, center.1 - radius);
        self.taken.push(Rect::new(x, y, 2.0 * radius, 2.0 * radius));
    }

    /// Keeps labels off a rectangle.
    pub(crate) fn keep_rect_free(&mut self, rect: Rect) {
        self.taken.push(rect);
    }

    /// Keeps labels off the part of a line within the bounds.
    pub(crate) fn keep_line_free(&mut self, from: Place, to: Place) {
        const STEP: f64 = 8.0;
        let length = libm::hypot(to.0 - from.0, to.1 - from.1);
        if !(length > 0.0 && length < 1e5) {
            return;
        }
        let direction = ((to.0 - from.0) / length, (to.1 - from.1) / length);
        for index in 0..=(length / STEP) as usize {
            let along = STEP * index as f64;
            let place = (from.0 + along * direction.0, from.1 + along * direction.1);
            if self.bounds.contains(place) {
                self.keep_free(place, 2.0);
            }
        }
    }

    /// Draws a label at the first of some positions without overlap, or else at the one with the
    /// least. The alignment of a position refers to the label's start, middle or end, at half its
    /// height.
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Canvas,
        places: &[(Place, Align)],
        text: &str,
        style: TextStyle,
    ) {
        let width = text_width(text, style.size) + 2.0 * MARGIN;
        let height = style.size + 2.0 * MARGIN;
        let mut best: Option<(f64, Rect)> = None;
        for ((x, y), align) in places {
            let left = match align {
                Align::Start => x - MARGIN,
                Align::Middle => x - width / 2.0,
                Align::End => x - width + MARGIN,
            };
            let wanted = Rect::new(left, y - height / 2.0, width, height);
            let rect = self.moved_inside(wanted);
            let moved = (rect.x - wanted.x).abs() + (rect.y - wanted.y).abs();
            let covered: f64 = self.taken.iter().map(|other| overlap(&rect, other)).sum();
            let cost = covered + moved;
            if best.is_none_or(|(least, _)| cost < least - 1e-9) {
                best = Some((cost, rect));
            }
        }
        if let Some((_, rect)) = best {
            let style = TextStyle {
                align: Align::Start,
                ..style
            };
            canvas.label((rect.x + MARGIN, rect.center().1), text, style);
            self.taken.push(rect);
        }
    }

    /// Draws the name of a mark beside it, at a font size and in the color of a role.
    pub(crate) fn name(
        &mut self,
        canvas: &mut Canvas,
        (place, distance): (Place, f64),
        text: &str,
        (role, size): (Role, f64),
    ) {
        let style = TextStyle::new(role, size).cased();
        self.draw(canvas, &Self::around(place, distance), text, style);
    }

    /// Returns six positions around a mark, upper right first.
    pub(crate) fn around((x, y): Place, distance: f64) -> [(Place, Align); 6] {
        let up = distance + 8.0;
        [
            ((x + distance * 0.6, y - up), Align::Start),
            ((x - distance * 0.6, y - up), Align::End),
            ((x + distance * 0.6, y + up), Align::Start),
            ((x - distance * 0.6, y + up), Align::End),
            ((x + distance + 3.0, y), Align::Start),
            ((x - distance - 3.0, y), Align::End),
        ]
    }

    /// Moves a rectangle into the bounds; a larger one is aligned with their start.
    fn moved_inside(&self, rect: Rect) -> Rect {
        let fit = |start: f64, size: f64, low: f64, high: f64| start.min(high - size).max(low);
        Rect::new(
            fit(rect.x, rect.width, self.bounds.x, self.bounds.right()),
            fit(rect.y, rect.height, self.bounds.y, self.bounds.bottom()),
            rect.width,
            rect.height,
        )
    }
}

fn overlap(a: &Rect, b: &Rect) -> f64 {
    let width = a.right().min(b.right()) - a.x.max(b.x);
    let height = a.bottom().min(b.bottom()) - a.y.max(b.y);
    width.max(0.0) * height.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Picture;
    use crate::theme::{Role, Theme};

    #[test]
    fn labels_stay_inside_and_apart() {
        let bounds = Rect::new(0.0, 0.0, 200.0, 100.0);
        let mut canvas = Canvas::new(200.0, 100.0, 1.0, Theme::Light, Picture::default()).unwrap();
        let mut labels = Labels::new(bounds);
        let style = TextStyle::new(Role::Ink, 12.0);
        for _ in 0..4 {
            labels.draw(
                &mut canvas,
                &Labels::around((150.0, 50.0), 10.0),
                "label",
                style,
            );
        }
        labels.draw(
            &mut canvas,
            &[((500.0, -20.0), Align::Middle)],
            "label",
            style,
        );
        for (index, rect) in labels.taken.iter().enumerate() {
            assert!(rect.x >= 0.0 && rect.right() <= 200.0, "{rect:?}");
            for other in &labels.taken[..index] {
                assert!(overlap(rect, other) < 1.0, "{rect:?} {other:?}");
            }
        }
    }
}
