//! The steps to choose from: below each other, or in one row that scrolls where there is no room.

use crate::panels::Action;
use crate::panels::widgets::look;
use crate::project::{Project, Step};
use crate::session::Event;
use egui::scroll_area::ScrollBarVisibility;
use egui::style::ScrollAnimation;
use egui::{Align, Layout, Response, ScrollArea, Ui};
use epipole_canvas::theme::Role;

/// Below each other.
pub(super) fn column(project: &Project, ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.with_layout(Layout::top_down_justified(Align::Min), |ui| {
        for step in Step::ALL {
            button(project, ui, step, actions);
        }
    });
}

/// One row, in which the step that is looked at is brought to the middle, and one that the keyboard
/// reaches into sight.
///
/// * `shown`: the step that is in the middle already: a reader may have moved the row since
pub(super) fn row(
    project: &Project,
    shown: &mut Option<Step>,
    ui: &mut Ui,
    actions: &mut Vec<Action>,
) {
    let current = project.view().step;
    ScrollArea::horizontal()
        .id_salt("steps")
        .scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden)
        .show(ui, |ui| {
            ui.horizontal(|ui| {
                for step in Step::ALL {
                    let response = button(project, ui, step, actions);
                    let is_new = step == current && *shown != Some(step);
                    if is_new || response.gained_focus() {
                        let at_once = ScrollAnimation::none();
                        response.scroll_to_me_animation(Some(Align::Center), at_once);
                    }
                }
            });
        });
    *shown = Some(current);
}

fn button(project: &Project, ui: &mut Ui, step: Step, actions: &mut Vec<Action>) -> Response {
    let response = ui.selectable_label(project.view().step == step, step.title());
    if response.has_focus() {
        // The fill of the current step hides the toolkit's own ring.
        let stroke = egui::Stroke::new(2.0, look::color(ui, Role::Best));
        let ring = response.rect.shrink(1.0);
        ui.painter()
            .rect_stroke(ring, 3.0, stroke, egui::StrokeKind::Inside);
    }
    if response.clicked() {
        actions.push(Action::Send(Event::Show(step)));
    }
    response
}
