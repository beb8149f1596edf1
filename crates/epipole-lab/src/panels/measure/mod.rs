//! Measurements: lengths, angles, areas, volumes, control points and the floor.

mod lists;
mod making;
mod marks;

use super::screen::{Panel, Screen};
use super::widgets::pick::Click;
use super::widgets::{controls, dense_anchor, look, vertex_anchor};
use crate::project::{Anchor, Step};
use crate::session::Event;
use egui::Ui;
use epipole_canvas::theme::Role;
use making::{Kind, Making};
use marks::Marks;

/// Panel of the step "Measure".
#[derive(Default)]
pub(super) struct Measuring {
    making: Making,
    /// Control point whose name is being typed.
    draft: lists::NameDraft,
    /// Point clicked last.
    last: Option<Anchor>,
    /// Whether the last click hit no point.
    has_missed: bool,
}

impl Measuring {
    /// Takes a click: a point of the figure in progress.
    fn take(&mut self, screen: &mut Screen<'_>, click: Click) {
        let project = screen.project;
        self.last = match click {
            Click::Missed => None,
            Click::Point(point) => project.anchor_of(point),
            Click::Dense(index) => dense_anchor(project, index, screen.views.cloud.surface),
            Click::Vertex(index) => vertex_anchor(project, index),
        };
        self.has_missed = self.last.is_none();
        if let Some(anchor) = self.last
            && let Some(event) = self.making.add(project, anchor)
        {
            screen.send(event);
        }
    }

    /// Shows the choice of the next figure, its instruction, and the ways out of it.
    fn next(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        if let Some(kind) = controls::choose(ui, "Kind", self.making.kind, &Kind::ALL) {
            self.making.start(kind);
        }
        ui.label(self.making.instruction(project));
        if self.has_missed {
            let words = "No point there. Click nearer to one, or zoom in.";
            ui.colored_label(look::color(ui, Role::Outlier), words);
        }
        if self.making.can_finish()
            && ui.button("Finish").clicked()
            && let Some(event) = self.making.finish(project)
        {
            screen.send(event);
        }
        match (self.making.kind, self.making.points.is_empty()) {
            (Kind::Length, true) => {}
            (Kind::Length, false) => {
                if ui.button("Choose another start").clicked() {
                    self.making.start(Kind::Length);
                }
            }
            _ => {
                if ui.button("Cancel").clicked() {
                    self.making.start(Kind::Length);
                }
            }
        }
    }

    /// Shows the state of the floor.
    fn floor(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        ui.separator();
        match project.document().floor {
            None => {
                if self.making.kind != Kind::Floor && ui.button("Set the floor").clicked() {
                    self.making.start(Kind::Floor);
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
        let marks = Marks {
            ui,
            painter: ui.painter_at(rect),
            place: |anchor: &Anchor| {
                let kept = project.is_remaining(anchor).then_some(anchor)?;
                let place = project.anchored(kept)?;
                screen.views.cloud.place_of(place, rect)
            },
        };
        marks.lengths(project);
        marks.shapes(project);
        marks.control_points(project);
        let floor = project.document().floor.iter().flatten();
        for place in floor.filter_map(&marks.place) {
            marks.square(place);
        }
        marks.points(&self.making.points);
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        if project.component().is_none() {
            // The text in place of the image gives the reason.
            return controls::book(ui, Step::Measure);
        }
        self.next(screen, ui);
        lists::lengths(screen, ui);
        lists::shapes(screen, ui);
        lists::control_points(screen, ui, &mut self.draft);
        self.floor(screen, ui);
        ui.add_space(6.0);
        ui.weak(
            "± is one standard deviation from the keypoints alone; the cameras are taken as exact.",
        );
        controls::book(ui, Step::Measure);
    }
}
