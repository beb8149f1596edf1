//! The bar above all steps: photographs, samples, projects, undo and redo, running jobs.

use super::host::Host;
use super::menu::{item, menu};
use super::work::{Errand, Work};
use crate::project::{Event, Project, Step};
use crate::tasks::Sample;
use egui::Ui;

/// Draws the actions available in every step.
pub(super) fn bar(
    project: &Project,
    work: &mut Work,
    host: &mut impl Host,
    narrow: bool,
    ui: &mut Ui,
    events: &mut Vec<Event>,
) {
    ui.add_space(3.0);
    ui.horizontal_wrapped(|ui| {
        let add = match project.view().step {
            _ if narrow => "Add…",
            Step::Calibrate => "Add photographs of a board…",
            _ => "Add photographs…",
        };
        if ui.button(add).clicked() && !host.ask_for_photographs() {
            work.news = Some("Drop photographs onto this window.".to_owned());
        }
        menu(ui, "Samples", |ui| {
            for sample in Sample::ALL {
                if item(ui, sample.title()) {
                    events.push(Event::OpenSample(sample));
                }
            }
        });
        menu(ui, "Project", |ui| {
            if item(ui, "Open…") && !host.ask_for_project() {
                work.news = Some("Drop a project onto this window.".to_owned());
            }
            if item(ui, "Save") {
                let request = project.save_request();
                work.run(Errand::Save, &request, host);
            }
            if item(ui, "Remove all photographs") {
                events.push(Event::Clear);
            }
            if host.can_keep() {
                work.keeping_menu(project, host, ui);
            }
        });
        if ui
            .add_enabled(project.can_undo(), egui::Button::new("Undo"))
            .clicked()
        {
            events.push(Event::Undo);
        }
        if ui
            .add_enabled(project.can_redo(), egui::Button::new("Redo"))
            .clicked()
        {
            events.push(Event::Redo);
        }
        let paused = project.is_paused();
        if paused && ui.button("Resume").clicked() {
            events.push(Event::Pause(false));
        }
        if project.can_try_again() && ui.button("Try again").clicked() {
            events.push(Event::TryAgain);
        }
        if let Some((words, share)) = work.words(project) {
            if !paused && ui.button("Stop").clicked() {
                events.push(Event::Pause(true));
            }
            ui.weak(match share > 0.0 {
                true => format!("{words} ({:.0} %)", 100.0 * share),
                false => words,
            });
        } else if paused {
            ui.weak("Stopped");
        }
        if let Some(news) = work.news.clone() {
            ui.weak(news);
            work.start_over(host, ui, events);
        }
    });
    ui.add_space(3.0);
}
