//! The bar above all steps: photographs, samples, projects, undo and redo, running jobs.

use super::App;
use super::host_events::megabytes;
use crate::panels::Action;
use crate::panels::widgets::menu::{item, menu, toggle};
use crate::project::{Sample, Step};
use crate::session::{Event, FileJob, Host};
use egui::{Button, Ui};

impl<H: Host> App<H> {
    /// Draws the actions available in every step.
    pub(super) fn bar(&mut self, narrow: bool, ui: &mut Ui, actions: &mut Vec<Action>) {
        ui.add_space(3.0);
        ui.horizontal_wrapped(|ui| {
            let add = match self.project.view().step {
                _ if narrow => "Add…",
                Step::Calibrate => "Add photographs of a board…",
                _ => "Add photographs…",
            };
            if ui.button(add).clicked() {
                actions.push(Action::AddPhotographs);
            }
            let mut send = |event| actions.push(Action::Send(event));
            menu(ui, "Samples", |ui| {
                for sample in Sample::ALL {
                    if item(ui, sample.title()) {
                        send(Event::OpenSample(sample));
                    }
                }
            });
            menu(ui, "Project", |ui| {
                if item(ui, "Open…") && !self.host.ask_for_project() {
                    self.notice = Some("Drop a project onto this window.".to_owned());
                }
                if item(ui, "Save") {
                    let request = self.project.save_request();
                    self.run(FileJob::SaveProject, request);
                }
                if item(ui, "Remove all photographs") {
                    send(Event::Clear);
                }
                if self.host.can_keep() {
                    self.storage_menu(ui);
                }
            });
            let (can_undo, can_redo) = (self.project.can_undo(), self.project.can_redo());
            if ui.add_enabled(can_undo, Button::new("Undo")).clicked() {
                send(Event::Undo);
            }
            if ui.add_enabled(can_redo, Button::new("Redo")).clicked() {
                send(Event::Redo);
            }
            let paused = self.project.is_paused();
            if paused && ui.button("Resume").clicked() {
                send(Event::Pause(false));
            }
            if self.project.can_try_again() && ui.button("Try again").clicked() {
                send(Event::TryAgain);
            }
            if let Some((words, share)) = self.jobs.progress(&self.project, self.videos.words()) {
                if !paused && ui.button("Stop").clicked() {
                    send(Event::Pause(true));
                }
                ui.weak(match share > 0.0 {
                    true => format!("{words} ({:.0}%)", 100.0 * share),
                    false => words,
                });
            } else if paused {
                ui.weak("Stopped");
            }
            if let Some(notice) = &self.notice {
                ui.weak(notice);
                // Resets the Lab to its initial state.
                if self.storage.is_restored && ui.button("Start over").clicked() {
                    self.erase_stored();
                    send(Event::OpenSample(Sample::Table));
                    send(Event::Show(Step::Reconstruction));
                }
            }
        });
        ui.add_space(3.0);
    }

    /// Draws the menu for the project stored in the browser.
    fn storage_menu(&mut self, ui: &mut Ui) {
        ui.separator();
        let is_closed = self.storage.is_closed();
        if is_closed {
            if item(ui, "Open the kept project") {
                self.host.ask_for_kept();
            }
        } else {
            let mut is_on = self.storage.is_open();
            if toggle(ui, &mut is_on, "Keep in this browser") {
                match is_on {
                    true => self.storage.turn_on(),
                    false => self.erase_stored(),
                }
            }
        }
        if !self.storage.is_empty() && item(ui, "Forget it") {
            self.erase_stored();
        }
        if !is_closed {
            let room = megabytes(self.project.num_file_bytes());
            ui.weak(format!("Uses {room} on this machine. Nothing is uploaded."));
        }
    }
}
