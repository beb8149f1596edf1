//! Marks of measures over the 3-D view.

use super::super::widgets::look;
use crate::project::{Anchor, Project, ShapeKind};
use egui::{Painter, Pos2, Rect, Stroke, StrokeKind, Ui, vec2};
use epipole_canvas::theme::Role;

/// Draws marks in the color of handles.
pub(super) struct Marks<'a, P: Fn(&Anchor) -> Option<Pos2>> {
    pub(super) ui: &'a Ui,
    pub(super) painter: Painter,
    /// Position of an anchor on the screen.
    pub(super) place: P,
}

impl<P: Fn(&Anchor) -> Option<Pos2>> Marks<'_, P> {
    fn stroke(&self, width: f32) -> Stroke {
        Stroke::new(width, look::color(self.ui, Role::Grip))
    }

    fn text(&self, words: String, at: Pos2) {
        let ink = look::color(self.ui, Role::Ink);
        let font = egui::FontId::proportional(14.0);
        let text = self.painter.layout_no_wrap(words, font, ink);
        let at = at + vec2(8.0, -20.0);
        let behind = Rect::from_min_size(at, text.size()).expand(3.0);
        let background = look::color(self.ui, Role::Background);
        self.painter.rect_filled(behind, 3.0, background);
        self.painter.galley(at, text, ink);
    }

    pub(super) fn circle(&self, at: Pos2, radius: f32) {
        self.painter.circle_stroke(at, radius, self.stroke(2.0));
    }

    /// Draws a square, so that color is not the only distinction.
    pub(super) fn square(&self, at: Pos2) {
        let square = Rect::from_center_size(at, vec2(11.0, 11.0));
        let stroke = self.stroke(2.0);
        (self.painter).rect_stroke(square, 0.0, stroke, StrokeKind::Middle);
    }

    /// Draws the lengths with their values.
    pub(super) fn lengths(&self, project: &Project) {
        for (index, measure) in project.document().measures.iter().enumerate() {
            let [Some(from), Some(to)] = measure.ends.each_ref().map(&self.place) else {
                continue;
            };
            self.painter.line_segment([from, to], self.stroke(2.0));
            for end in [from, to] {
                self.circle(end, 5.0);
            }
            let words = format!("{}: {}", index + 1, project.length_words(index));
            self.text(words, from.lerp(to, 0.5));
        }
    }

    /// Draws the sides of figures with their names.
    pub(super) fn shapes(&self, project: &Project) {
        for (index, shape) in project.document().shapes.iter().enumerate() {
            let places: Option<Vec<Pos2>> = shape.points.iter().map(&self.place).collect();
            let Some(places) = places else { continue };
            self.sides(&places, shape.kind != ShapeKind::Angle);
            let sum = places
                .iter()
                .fold(vec2(0.0, 0.0), |sum, at| sum + at.to_vec2());
            let middle = (sum / places.len().max(1) as f32).to_pos2();
            self.text(project.shape_name(index), middle);
        }
    }

    fn sides(&self, places: &[Pos2], is_closed: bool) {
        let next = places.iter().cycle().skip(1);
        let count = places.len().saturating_sub(usize::from(!is_closed));
        for (from, to) in places.iter().zip(next).take(count) {
            self.painter.line_segment([*from, *to], self.stroke(2.0));
        }
        for place in places {
            self.circle(*place, 5.0);
        }
    }

    /// Draws the control points as crosses with their names.
    pub(super) fn control_points(&self, project: &Project) {
        for control in &project.document().control_points {
            let Some(at) = (self.place)(&control.point) else {
                continue;
            };
            for arm in [vec2(8.0, 0.0), vec2(0.0, 8.0)] {
                self.painter
                    .line_segment([at - arm, at + arm], self.stroke(2.0));
            }
            self.text(control.name.clone(), at);
        }
    }

    /// Draws the points of the figure in progress.
    pub(super) fn points(&self, points: &[Anchor]) {
        let places: Vec<Pos2> = points.iter().filter_map(&self.place).collect();
        for two in places.windows(2) {
            self.painter
                .line_segment([two[0], two[1]], self.stroke(1.0));
        }
        for place in places {
            self.painter.circle_stroke(place, 7.0, self.stroke(2.5));
        }
    }
}
