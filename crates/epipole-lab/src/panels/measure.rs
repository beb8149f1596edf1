//! Measurements: a known length between two points sets the scale of all others.

use super::screen::{Panel, Screen};
use super::widgets::pick::Click;
use super::widgets::{controls, dense_anchor, look, vertex_anchor};
use crate::project::{Anchor, Measure, Step};
use crate::session::Event;
use egui::{DragValue, Stroke, Ui};
use epipole_canvas::theme::Role;

/// Panel of the step "Measure".
#[derive(Default)]
pub(super) struct Measuring {
    /// First end of a length, until the second is clicked.
    first_end: Option<Anchor>,
    /// Points of the floor, until three are clicked.
    corners: Option<Vec<Anchor>>,
    /// Point clicked last.
    last: Option<Anchor>,
    /// Whether the last click hit no point.
    has_missed: bool,
}

impl Measuring {
    /// Takes a click: an end of a length, or a point of the floor.
    fn take(&mut self, screen: &mut Screen<'_>, click: Click) {
        let project = screen.project;
        self.last = match click {
            Click::Missed => None,
            Click::Point(point) => project.anchor_of(point),
            Click::Dense(index) => dense_anchor(project, index, screen.views.cloud.surface),
            Click::Vertex(index) => vertex_anchor(project, index),
        };
        self.has_missed = self.last.is_none();
        let Some(anchor) = self.last else { return };
        if let Some(corners) = &mut self.corners {
            if !corners.contains(&anchor) {
                corners.push(anchor);
            }
            if let Ok(corners) = corners.clone().try_into() {
                screen.send(Event::Floor(Some(corners)));
                self.corners = None;
            }
            return;
        }
        match self.first_end.take() {
            Some(first) if first != anchor => screen.send(Event::Measure(Measure {
                ends: [first, anchor],
                length_m: None,
            })),
            Some(_) => {}
            None => self.first_end = Some(anchor),
        }
    }
}

impl Panel for Measuring {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        if project.component().is_none() {
            return controls::instead(ui, &project.describe());
        }
        let rect = ui.available_rect_before_wrap();
        if let Some(click) = screen.views.cloud.show(project, ui, rect) {
            self.take(screen, click);
        }
        let place = |anchor: &Anchor| {
            let place = project.anchored(anchor)?;
            screen.views.cloud.place_of(place, rect)
        };
        let painter = ui.painter_at(rect);
        let color = look::color(ui, Role::Grip);
        let ink = look::color(ui, Role::Ink);
        let font = egui::FontId::proportional(14.0);
        for (index, measure) in project.document().measures.iter().enumerate() {
            let [Some(from), Some(to)] = measure.ends.each_ref().map(place) else {
                continue;
            };
            painter.line_segment([from, to], Stroke::new(2.0, color));
            for end in [from, to] {
                painter.circle_stroke(end, 5.0, Stroke::new(2.0, color));
            }
            let words = format!("{}: {}", index + 1, project.length_words(index));
            let text = painter.layout_no_wrap(words, font.clone(), ink);
            let at = from.lerp(to, 0.5) + egui::vec2(8.0, -20.0);
            let behind = egui::Rect::from_min_size(at, text.size()).expand(3.0);
            painter.rect_filled(behind, 3.0, look::color(ui, Role::Background));
            painter.galley(at, text, ink);
        }
        let floor = project.document().floor.iter().flatten();
        let corners = self.corners.iter().flatten().chain(floor);
        for place in corners.filter_map(place) {
            // Squares, so that color is not the only distinction.
            let square = egui::Rect::from_center_size(place, egui::vec2(11.0, 11.0));
            painter.rect_stroke(
                square,
                0.0,
                Stroke::new(2.0, color),
                egui::StrokeKind::Middle,
            );
        }
        if let Some(place) = self.first_end.as_ref().and_then(place) {
            painter.circle_stroke(place, 7.0, Stroke::new(2.5, color));
        }
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        if project.component().is_none() {
            // The text in place of the image gives the reason.
            return controls::book(ui, Step::Measure);
        }
        let missed = |ui: &mut Ui| {
            let words = "No point there. Click nearer to one, or zoom in.";
            ui.colored_label(look::color(ui, Role::Outlier), words);
        };
        if let Some(corners) = &self.corners {
            ui.label(format!(
                "Click three points of the floor: {} of 3.",
                corners.len()
            ));
            if self.has_missed {
                missed(ui);
            }
            if ui.button("Cancel").clicked() {
                self.corners = None;
            }
            return;
        }
        ui.label(
            match (project.document().measures.is_empty(), self.first_end) {
                (_, Some(_)) => "One end is chosen. Click the other.",
                (true, None) => {
                    "Click two points whose distance you know and type it: it sets the scale."
                }
                (false, None) => "Click two points to measure another length.",
            },
        );
        if self.has_missed {
            missed(ui);
        }
        if self.first_end.is_some() && ui.button("Choose another start").clicked() {
            self.first_end = None;
        }
        let sets_scale = project.scale().map(|scale| scale.measure);
        for (index, measure) in project.document().measures.iter().enumerate() {
            ui.separator();
            ui.strong(format!("{}: {}", index + 1, project.length_words(index)));
            ui.horizontal_wrapped(|ui| {
                let label = ui.label("known length, m");
                let mut meters = measure.length_m.unwrap_or(0.0);
                let field = DragValue::new(&mut meters)
                    .range(0.0..=1e6)
                    .speed(0.01)
                    .max_decimals(4);
                let response = ui
                    .add(field.update_while_editing(false))
                    .labelled_by(label.id);
                if (response.changed() && !response.dragged()) || response.drag_stopped() {
                    let known = (meters > 0.0).then_some(meters);
                    screen.send(Event::Length(index, known));
                }
                if ui.button("Remove").clicked() {
                    screen.send(Event::Forget(index));
                }
            });
            if sets_scale == Some(index) {
                ui.weak("sets the scale");
            } else if let (Some(known), Some(found)) =
                (measure.length_m, project.length_in_meters(index))
            {
                let off = 100.0 * (found.value / known - 1.0);
                ui.weak(format!("{off:+.2}% from what you typed"));
            }
        }
        ui.separator();
        match project.document().floor {
            None => {
                if ui.button("Set the floor").clicked() {
                    self.corners = Some(Vec::new());
                    self.first_end = None;
                }
            }
            Some(_) => {
                ui.label(project.floor_words().trim());
                if ui.button("Remove the floor").clicked() {
                    screen.send(Event::Floor(None));
                }
            }
        }
        if let Some(anchor) = &self.last {
            let height = project.height_words(anchor);
            if !height.is_empty() {
                ui.label(format!("The point you clicked: {height}"));
            }
        }
        ui.add_space(6.0);
        ui.weak(
            "± is one standard deviation from the keypoints alone; the cameras are taken as exact.",
        );
        controls::book(ui, Step::Measure);
    }
}
