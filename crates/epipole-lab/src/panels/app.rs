//! The whole of what is seen: a bar, the steps, the picture of a step and its knobs.

use super::cloud::CloudView;
use super::host::{Arrival, Host};
use super::photo::{Lens, Pictures};
use super::work::{Errand, Work};
use super::{features, look, matches, measure, photographs, reconstruction, two_views};
use crate::project::{Event, Project, Settings, Step};
use crate::tasks::{Request, Sample};
use egui::{CentralPanel, Panel, ScrollArea, Ui};

/// Below this width, steps and knobs stand below each other.
const NARROW: f32 = 760.0;

/// What panels remember beside the project.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) pictures: Pictures,
    pub(super) lenses: [Lens; 2],
    pub(super) cloud: CloudView,
    /// Knobs while they are held.
    pub(super) draft: Option<Settings>,
    /// The feature that was clicked.
    pub(super) feature: Option<usize>,
    /// The place that was clicked in the first photograph of a pair.
    pub(super) probe: Option<[f64; 2]>,
    /// The match that was clicked.
    pub(super) chosen_match: Option<usize>,
    /// A point that waits for another one to be measured.
    pub(super) first_end: Option<usize>,
}

/// The Lab on a screen.
pub struct App<H> {
    project: Project,
    host: H,
    work: Work,
    memory: Memory,
    said: String,
    /// When that was found out: the revision, and the news.
    told_at: Option<(u64, Option<String>)>,
}

/// Sets font, sizes and colors of a context, before its first frame.
pub fn prepare(context: &egui::Context) {
    look::set(context);
}

impl<H: Host> App<H> {
    /// With the sample, which is solved at once.
    pub fn new(host: H) -> Self {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Table));
        project.update(Event::Show(Step::Reconstruction));
        Self {
            project,
            host,
            work: Work::default(),
            memory: Memory::default(),
            said: String::new(),
            told_at: None,
        }
    }

    /// The state.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// The place where it runs.
    pub fn host(&mut self) -> &mut H {
        &mut self.host
    }

    /// Does what is to be done between two frames. True while something is under way.
    pub fn go_on(&mut self) -> bool {
        for arrival in self.host.arrivals() {
            match arrival {
                Arrival::Photographs(files) => {
                    // One's own photographs take the place of the sample.
                    let is_sample = |photo: &crate::project::Given| {
                        matches!(photo.source, crate::tasks::Source::Rendered(..))
                    };
                    if self.project.document().photos.iter().all(is_sample) {
                        self.project.update(Event::Clear);
                    }
                    self.project.update(Event::Add(files));
                    self.project.update(Event::Show(Step::Photographs));
                }
                Arrival::Project(archive) => {
                    let request = Request::Open { archive };
                    self.work.run(Errand::Open, &request, &mut self.host);
                }
            }
        }
        self.work.go_on(&mut self.project, &mut self.host);
        let now = (self.project.revision(), self.work.news.clone());
        if self.told_at.as_ref() == Some(&now) {
            return self.work.is_busy();
        }
        self.told_at = Some(now);
        let words = match &self.work.news {
            Some(news) => format!("{} {news}", self.project.describe()),
            None => self.project.describe(),
        };
        if words != self.said {
            self.host.say(&words);
            self.said = words;
        }
        self.work.is_busy()
    }

    /// Draws a frame. Once before the first one, [`prepare`] is to be called.
    pub fn ui(&mut self, ui: &mut Ui) {
        let mut events = Vec::new();
        self.keys(ui, &mut events);
        let narrow = ui.available_width() < NARROW;
        Panel::top("bar").show(ui, |ui| self.bar(ui, &mut events));
        if narrow {
            Panel::top("steps in a row").show(ui, |ui| {
                ui.horizontal_wrapped(|ui| self.steps(ui, &mut events));
            });
            let height = ui.available_height();
            Panel::bottom("knobs below")
                .exact_size(0.42 * height)
                .show(ui, |ui| {
                    self.knobs(ui, &mut events);
                });
        } else {
            Panel::left("steps")
                .exact_size(168.0)
                .resizable(false)
                .show(ui, |ui| {
                    ui.add_space(6.0);
                    self.steps(ui, &mut events);
                });
            Panel::right("knobs")
                .exact_size(316.0)
                .resizable(false)
                .show(ui, |ui| {
                    self.knobs(ui, &mut events);
                });
        }
        CentralPanel::default().show(ui, |ui| self.picture(ui, &mut events));
        if !events.is_empty() {
            // What follows from them is started, and shown, with the next frame.
            ui.ctx().request_repaint();
        }
        for event in events {
            self.project.update(event);
        }
    }

    fn keys(&self, ui: &Ui, events: &mut Vec<Event>) {
        let typing = ui.ctx().egui_wants_keyboard_input();
        ui.input(|input| {
            if input.modifiers.command && !typing && input.key_pressed(egui::Key::Z) {
                events.push(match input.modifiers.shift {
                    true => Event::Redo,
                    false => Event::Undo,
                });
            }
        });
    }

    fn bar(&mut self, ui: &mut Ui, events: &mut Vec<Event>) {
        ui.add_space(3.0);
        ui.horizontal_wrapped(|ui| {
            ui.heading("Lab");
            if ui.button("Add photographs…").clicked() && !self.host.ask_for_photographs() {
                self.work.news = Some("Drop photographs onto this window.".to_owned());
            }
            ui.menu_button("Samples", |ui| {
                for sample in Sample::ALL {
                    if ui.button(sample.title()).clicked() {
                        events.push(Event::OpenSample(sample));
                        self.memory = Memory::default();
                    }
                }
            });
            ui.menu_button("Project", |ui| {
                if ui.button("Open…").clicked() && !self.host.ask_for_project() {
                    self.work.news = Some("Drop a project onto this window.".to_owned());
                }
                if ui.button("Save").clicked() {
                    let request = self.project.save_request();
                    self.work.run(Errand::Save, &request, &mut self.host);
                }
                if ui.button("Remove all photographs").clicked() {
                    events.push(Event::Clear);
                }
            });
            if ui
                .add_enabled(self.project.can_undo(), egui::Button::new("Undo"))
                .clicked()
            {
                events.push(Event::Undo);
            }
            if ui
                .add_enabled(self.project.can_redo(), egui::Button::new("Redo"))
                .clicked()
            {
                events.push(Event::Redo);
            }
            let paused = self.project.is_paused();
            if paused && ui.button("Go on").clicked() {
                events.push(Event::Pause(false));
            }
            if let Some((words, share)) = self.work.words(&self.project) {
                if !paused && ui.button("Stop").clicked() {
                    events.push(Event::Pause(true));
                }
                ui.weak(match share > 0.0 {
                    true => format!("{words} ({:.0} %)", 100.0 * share),
                    false => words,
                });
            } else if paused {
                ui.weak("stopped");
            } else if let Some(news) = &self.work.news {
                ui.weak(news);
            }
        });
        ui.add_space(3.0);
    }

    fn steps(&self, ui: &mut Ui, events: &mut Vec<Event>) {
        for step in Step::ALL {
            let current = self.project.view().step == step;
            let text = egui::RichText::new(step.title());
            let label = ui.selectable_label(current, text);
            if label.clicked() {
                events.push(Event::Show(step));
            }
        }
    }

    fn picture(&mut self, ui: &mut Ui, events: &mut Vec<Event>) {
        let (project, memory) = (&self.project, &mut self.memory);
        if project.document().photos.is_empty() {
            ui.centered_and_justified(|ui| {
                ui.label("Add photographs of one thing from different places, or open a sample.")
            });
            return;
        }
        match project.view().step {
            Step::Photographs => photographs::picture(project, memory, ui, events),
            Step::Features => features::picture(project, memory, ui),
            Step::Matches => matches::picture(project, ui, events),
            Step::TwoViews => two_views::picture(project, memory, ui),
            Step::Reconstruction | Step::Export => reconstruction::picture(project, memory, ui),
            Step::Measure => measure::picture(project, memory, ui, events),
        }
    }

    fn knobs(&mut self, ui: &mut Ui, events: &mut Vec<Event>) {
        let (project, memory) = (&self.project, &mut self.memory);
        let step = project.view().step;
        let mut export = false;
        ScrollArea::vertical()
            .id_salt(step)
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.add_space(6.0);
                ui.heading(step.title());
                match step {
                    Step::Photographs => photographs::knobs(project, memory, ui, events),
                    Step::Features => features::knobs(project, memory, ui, events),
                    Step::Matches => matches::knobs(project, memory, ui, events),
                    Step::TwoViews => two_views::knobs(project, memory, ui, events),
                    Step::Reconstruction => reconstruction::knobs(project, memory, ui, events),
                    Step::Measure => measure::knobs(project, memory, ui, events),
                    Step::Export => export = self::export(project, ui),
                }
            });
        if export && let Some(request) = self.project.export_request() {
            self.work.run(Errand::Export, &request, &mut self.host);
        }
    }
}

/// What is exported. True if that was asked for.
fn export(project: &Project, ui: &mut Ui) -> bool {
    ui.label(project.describe());
    let ready = project.component().is_some();
    let clicked = ui
        .add_enabled(ready, egui::Button::new("Save reconstruction.zip"))
        .clicked();
    ui.label(
        "It holds images/ and sparse/0/ as COLMAP's text model, which other programs open; \
         points.ply, the points with their colors; reconstruction.json, as the command line prints \
         it; and the command that does the same.",
    );
    ui.weak(match project.scale() {
        Some(_) => "Lengths are meters, by the length that you measured.",
        None => "The unit is arbitrary: measure a length to have meters.",
    });
    clicked
}
