//! The verdict on the reconstruction, with buttons for the steps that it suggests.

use super::look;
use crate::panels::screen::{Action, Screen};
use crate::project::Step;
use crate::session::{Event, Suggestion};
use egui::{RichText, Ui};
use epipole_canvas::theme::Role;

/// Size of the title, points.
const TITLE: f32 = 17.0;

/// Draws the verdict or, until there is one, a button to the growing reconstruction.
pub(crate) fn show(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let known = screen
        .views
        .verdict
        .filter(|known| known.0 == project.revision());
    let known = known.unwrap_or_else(|| (project.revision(), project.verdict()));
    screen.views.verdict = Some(known);
    let Some(verdict) = known.1 else {
        let watches = project.view().step == Step::Reconstruction;
        if project.taking_part().len() > 1 && !watches {
            if ui.button("Watch the reconstruction").clicked() {
                screen.send(Event::Show(Step::Reconstruction));
            }
            ui.separator();
        }
        return;
    };
    let role = match verdict.is_sound() {
        true => Role::Ink,
        false => Role::Outlier,
    };
    let title = RichText::new(verdict.title()).size(TITLE);
    ui.label(title.color(look::color(ui, role)));
    ui.label(verdict.explanation());
    let step = project.view().step;
    ui.horizontal_wrapped(|ui| {
        for suggestion in project.suggestions(verdict) {
            match suggestion {
                // The step is current already.
                Suggestion::Send(_, events) if events == [Event::Show(step)] => {}
                Suggestion::Send(label, events) => {
                    if ui.button(label).clicked() {
                        events.into_iter().for_each(|event| screen.send(event));
                    }
                }
                Suggestion::AddPhotographs => {
                    if ui.button("Add more…").clicked() {
                        screen.actions.push(Action::AddPhotographs);
                    }
                }
            }
        }
    });
    ui.separator();
}
