//! The app: a bar, the steps, and the picture and controls of the current step.

use crate::panels::{self, Action, Panel, Screen, Views};
use crate::project::{Project, Sample, Step};
use crate::session::{Event, FileJob, Host, HostEvent, Jobs, Storage, Videos};
use crate::tasks::{CalibrationOfBoards, Request, WriteCamera, WritePicture};
mod bar;
mod files;
mod host_events;
mod steps;

use crate::panels::widgets::{empty, look};
use egui::{CentralPanel, Panel as Area, ScrollArea, Ui};
use std::collections::VecDeque;
use std::time::Duration;

/// Width in points below which steps and controls are stacked.
const NARROW: f32 = 760.0;

/// The Lab on a screen.
pub struct App<H> {
    project: Project,
    host: H,
    jobs: Jobs,
    /// Videos whose frames are being extracted.
    videos: Videos,
    /// Project stored in the browser.
    storage: Storage,
    /// Queue of host events.
    host_events: VecDeque<HostEvent>,
    /// Whether precomputed results of the sample are still to arrive.
    waits_for_sample: bool,
    /// Message about the last file.
    notice: Option<String>,
    panels: [(Step, Box<dyn Panel>); 9],
    views: Views,
    /// List of steps.
    steps: steps::Steps,
    /// Description last announced.
    description: String,
    /// Link last set.
    link: String,
    /// Revision and notice at the last announcement.
    announced: Option<(u64, Option<String>)>,
}

/// Sets font, sizes and colors of a context, before its first frame.
pub fn prepare(context: &egui::Context) {
    look::set(context);
}

/// Applies a theme: "light", "dark", "high-contrast", or that of the system for any other name.
pub fn set_theme(context: &egui::Context, theme: &str) {
    look::set_theme(context, theme);
}

impl<H: Host> App<H> {
    /// Opens the sample, with its reconstruction shown as soon as it is computed.
    pub fn new(host: H) -> Self {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Table));
        project.update(Event::Show(Step::Reconstruction));
        project.clear_history();
        Self {
            project,
            jobs: Jobs::default(),
            videos: Videos::default(),
            storage: Storage::default(),
            host_events: VecDeque::new(),
            waits_for_sample: host.brings_sample(),
            host,
            notice: None,
            panels: panels::all(),
            views: Views::default(),
            steps: steps::Steps::default(),
            description: String::new(),
            link: String::new(),
            announced: None,
        }
    }

    /// The open project.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// The environment.
    pub fn host(&mut self) -> &mut H {
        &mut self.host
    }

    /// Processes host events and jobs between two frames. True while anything is running or
    /// waiting.
    pub fn advance(&mut self) -> bool {
        self.host_events.extend(self.host.host_events());
        // Events after a project wait until it is open.
        while !self.jobs.is_opening()
            && let Some(host_event) = self.host_events.pop_front()
        {
            self.take(host_event);
        }
        self.run_jobs();
        let now = (self.project.revision(), self.notice.clone());
        if self.announced.as_ref() != Some(&now) {
            self.announced = Some(now);
            self.announce();
        }
        !self.jobs.is_empty() || self.is_waiting()
    }

    fn run_jobs(&mut self) {
        while let Some((job, result)) = self.jobs.receive(&mut self.project, &mut self.host) {
            self.finish(job, result);
        }
        let is_sample = self.project.document().is_sample();
        // Another project, or precomputed results, are about to arrive.
        let is_held = self.jobs.is_opening() || (self.waits_for_sample && is_sample);
        self.jobs.schedule(&self.project, &mut self.host, is_held);
    }

    /// Passes description and link to the host if they have changed.
    fn announce(&mut self) {
        let mut description = self.project.describe();
        if let Some(notice) = &self.notice {
            description = format!("{description} {notice}");
        }
        if description != self.description {
            self.host.say(&description);
            self.description = description;
        }
        let link = self.project.link();
        if link != self.link {
            self.host.address(&link);
            self.link = link;
        }
    }

    /// Whether [`App::advance`] has work left and should be called again soon.
    pub fn is_waiting(&self) -> bool {
        self.jobs.is_waiting()
    }

    /// Draws a frame. Requires [`prepare`] before the first one.
    pub fn ui(&mut self, ui: &mut Ui) {
        let mut actions = Vec::new();
        keys(ui, &mut actions);
        let running = self.jobs.steps();
        self.steps
            .update(&self.project, running, ui.input(|input| input.time));
        let narrow = ui.available_width() < NARROW;
        Area::top("bar").show(ui, |ui| self.bar(narrow, ui, &mut actions));
        if narrow {
            Area::top("steps in a row").show(ui, |ui| {
                self.steps.row(&self.project, ui, &mut actions);
            });
            let height = ui.available_height();
            Area::bottom("knobs below")
                .exact_size(0.42 * height)
                .show(ui, |ui| self.controls(ui, &mut actions));
        } else {
            Area::left("steps")
                .exact_size(168.0)
                .resizable(false)
                .show(ui, |ui| {
                    ui.add_space(6.0);
                    self.steps.column(&self.project, ui, &mut actions);
                });
            Area::right("knobs")
                .exact_size(316.0)
                .resizable(false)
                .show(ui, |ui| self.controls(ui, &mut actions));
        }
        CentralPanel::default().show(ui, |ui| self.picture(ui, &mut actions));
        if !actions.is_empty() || self.is_waiting() {
            // Actions take effect, and are visible, in the next frame.
            ui.ctx().request_repaint();
        }
        for action in actions {
            self.act(action);
        }
        if self.project.is_paused() {
            // Stopping takes effect before the next frame.
            self.run_jobs();
        }
        self.store(ui);
    }

    fn picture(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let step = self.project.view().step;
        if self.project.document().photos.is_empty() && step != Step::Calibrate {
            let mut screen = Screen {
                project: &self.project,
                views: &mut self.views,
                actions,
            };
            return empty::show(&mut screen, ui);
        }
        self.show(actions, |panel, screen| panel.picture(screen, ui));
    }

    fn controls(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let step = self.project.view().step;
        ScrollArea::vertical()
            .id_salt(step)
            .auto_shrink(false)
            .show(ui, |ui| {
                // Nothing may lie below the scroll bar.
                ui.set_max_width(ui.available_width() - 10.0);
                ui.add_space(6.0);
                ui.horizontal_wrapped(|ui| {
                    ui.heading(step.title());
                    if self.host.has_book() && ui.button("What is this?").clicked() {
                        self.host.explain(step.explanation());
                    }
                });
                self.show(actions, |panel, screen| panel.controls(screen, ui));
            });
    }

    /// Shows the panel of the current step.
    fn show(
        &mut self,
        actions: &mut Vec<Action>,
        draw: impl FnOnce(&mut dyn Panel, &mut Screen<'_>),
    ) {
        let current = self.project.view().step;
        let mut screen = Screen {
            project: &self.project,
            views: &mut self.views,
            actions,
        };
        if let Some((_, panel)) = self.panels.iter_mut().find(|(step, _)| *step == current) {
            draw(&mut **panel, &mut screen);
        }
    }

    fn act(&mut self, action: Action) {
        match action {
            Action::Send(event) => {
                if matches!(event, Event::OpenSample(_)) {
                    self.panels = panels::all();
                    self.views = Views::default();
                    self.steps = steps::Steps::default();
                }
                // The message about the opened file is outdated.
                if matches!(event, Event::UsePoses(None) | Event::UseCamera(None)) {
                    self.notice = None;
                }
                self.project.update(event);
            }
            Action::AddPhotographs => {
                if !self.host.ask_for_photographs() {
                    self.notice = Some("Drop photographs onto this window.".to_owned());
                }
            }
            Action::TakePhotographs => {
                if !self.host.ask_for_camera() {
                    self.notice =
                        Some("Only the Lab in a browser can take photographs.".to_owned());
                }
            }
            Action::OpenCameras => {
                if !self.host.ask_for_camera_files() {
                    self.notice = Some("There is no file dialog here.".to_owned());
                }
            }
            Action::SaveCameraAs(format) => {
                if let Some(found) = self.project.get(CalibrationOfBoards) {
                    let camera = found.camera.clone();
                    self.run(FileJob::SaveCamera(format), WriteCamera { camera, format });
                }
            }
            Action::SaveReconstruction(format) => {
                if let Some(request) = self.project.export_request(format) {
                    self.run(FileJob::SaveReconstruction, request);
                }
            }
            Action::SaveView => {
                if let Some((width, rgba)) = self.views.cloud.pixels() {
                    self.run(FileJob::SaveView, WritePicture { width, rgba });
                }
            }
            Action::SaveCamera => {
                if let Some(text) = self.project.camera_json() {
                    let saved = self.host.save("camera.json", text.into_bytes());
                    let (Ok(sentence) | Err(sentence)) = saved;
                    self.notice = Some(sentence);
                }
            }
        }
    }

    /// Starts a file job, unless one of its kind is running.
    fn run(&mut self, job: FileJob, task: impl Into<Request>) {
        if !self.jobs.runs(job) {
            self.notice = None;
            self.storage.is_restored = false;
            self.jobs.start_file(job, &task.into(), &mut self.host);
        }
    }

    /// Stores the open project in the browser after a pause in the changes.
    fn store(&mut self, ui: &Ui) {
        if !self.storage.is_open() {
            return;
        }
        let (key, now_s) = (self.project.saved_key(), ui.input(|input| input.time));
        match self.storage.wait_s(key, now_s) {
            None => {}
            Some(wait_s) if wait_s > 0.0 => ui
                .ctx()
                .request_repaint_after(Duration::from_secs_f64(wait_s)),
            Some(_) if self.jobs.runs(FileJob::Store) || self.jobs.runs(FileJob::Open) => {}
            Some(_) => {
                self.storage.begin(key);
                let request = self.project.keep_request().into();
                self.jobs
                    .start_file(FileJob::Store, &request, &mut self.host);
            }
        }
    }
}

/// Handles the keys of undo and redo.
fn keys(ui: &Ui, actions: &mut Vec<Action>) {
    let typing = ui.ctx().egui_wants_keyboard_input();
    ui.input(|input| {
        if input.modifiers.command && !typing && input.key_pressed(egui::Key::Z) {
            actions.push(Action::Send(match input.modifiers.shift {
                true => Event::Redo,
                false => Event::Undo,
            }));
        }
    });
}
