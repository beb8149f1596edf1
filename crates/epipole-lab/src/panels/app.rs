//! The whole screen: a bar, the steps, the image of a step and its controls.

use super::cloud::CloudView;
use super::depth::DepthView;
use super::host::{Arrival, Host, Wish};
use super::photo::{Lens, Pictures};
use super::work::{Errand, Work};
use super::{
    bar, calibrate, depth, export, features, intake, knobs, look, matches, measure, photographs,
    reconstruction, steps, two_views,
};
use crate::project::{Event, Project, Settings, Step};
use crate::tasks::{Request, Sample};
use egui::{CentralPanel, Panel, ScrollArea, Ui};
use std::collections::VecDeque;

/// Width in points below which steps and controls are stacked.
const NARROW: f32 = 760.0;

/// State of the panels besides the project.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) pictures: Pictures,
    pub(super) lenses: [Lens; 2],
    pub(super) board: calibrate::BoardView,
    pub(super) cloud: CloudView,
    pub(super) depth: DepthView,
    /// Knobs while they are held.
    pub(super) draft: Option<Settings>,
    /// The step that the row of steps has in its middle.
    pub(super) step: Option<Step>,
    /// The feature that was clicked.
    pub(super) feature: Option<usize>,
    /// The place that was clicked in the first photograph of a pair.
    pub(super) probe: Option<[f64; 2]>,
    /// The match that was clicked.
    pub(super) chosen_match: Option<usize>,
    /// A point that waits for another one to be measured.
    pub(super) first_end: Option<usize>,
    /// Points of the floor, while there are not three of them.
    pub(super) corners: Option<Vec<usize>>,
}

/// The Lab on a screen.
pub struct App<H> {
    project: Project,
    host: H,
    work: Work,
    /// Queue of arrivals.
    arrivals: VecDeque<Arrival>,
    memory: Memory,
    said: String,
    link: String,
    /// Revision and news at the last announcement.
    told_at: Option<(u64, Option<String>)>,
}

/// Sets font, sizes and colors of a context, before its first frame.
pub fn prepare(context: &egui::Context) {
    look::set(context);
}

/// Puts a theme on: "light", "dark", "high-contrast", or that of the system.
pub fn wear(context: &egui::Context, theme: &str) {
    look::wear(context, theme);
}

impl<H: Host> App<H> {
    /// With the sample, which is solved at once.
    pub fn new(host: H) -> Self {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Table));
        project.update(Event::Show(Step::Reconstruction));
        project.forget_past();
        let work = Work::new(host.brings_sample());
        Self {
            project,
            host,
            work,
            arrivals: VecDeque::new(),
            memory: Memory::default(),
            said: String::new(),
            link: String::new(),
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

    /// Does the work between two frames. True while something is running.
    pub fn go_on(&mut self) -> bool {
        self.arrivals.extend(self.host.arrivals());
        // Arrivals after a project wait until it is open.
        while !self.work.is_opening()
            && let Some(arrival) = self.arrivals.pop_front()
        {
            intake::take(arrival, &mut self.project, &mut self.work, &mut self.host);
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
        let link = self.project.link();
        if link != self.link {
            self.host.address(&link);
            self.link = link;
        }
        self.work.is_busy()
    }

    /// Whether there is more to do between two frames than was done: [`App::go_on`] wants to be
    /// called soon.
    pub fn is_waiting(&self) -> bool {
        self.work.is_waiting()
    }

    /// Draws a frame. Once before the first one, [`prepare`] is to be called.
    pub fn ui(&mut self, ui: &mut Ui) {
        let mut events = Vec::new();
        self.keys(ui, &mut events);
        let narrow = ui.available_width() < NARROW;
        Panel::top("bar").show(ui, |ui| {
            bar::bar(
                &self.project,
                &mut self.work,
                &mut self.host,
                narrow,
                ui,
                &mut events,
            );
        });
        if narrow {
            Panel::top("steps in a row").show(ui, |ui| {
                steps::row(&self.project, &mut self.memory.step, ui, &mut events);
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
                    steps::column(&self.project, ui, &mut events);
                });
            Panel::right("knobs")
                .exact_size(316.0)
                .resizable(false)
                .show(ui, |ui| {
                    self.knobs(ui, &mut events);
                });
        }
        CentralPanel::default().show(ui, |ui| self.picture(ui, &mut events));
        if !events.is_empty() || self.is_waiting() {
            // The effects of the events start, and show, with the next frame.
            ui.ctx().request_repaint();
        }
        for event in events {
            if matches!(event, Event::OpenSample(_)) {
                self.memory = Memory::default();
            }
            self.project.update(event);
        }
        if self.project.is_paused() {
            // Stopping takes effect before the next frame.
            self.work.go_on(&mut self.project, &mut self.host);
        }
        self.work.keep(&self.project, &mut self.host, ui);
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

    fn picture(&mut self, ui: &mut Ui, events: &mut Vec<Event>) {
        let (project, memory) = (&self.project, &mut self.memory);
        if project.view().step == Step::Calibrate {
            return calibrate::picture(project, memory, ui, events);
        }
        if project.document().photos.is_empty() {
            let words =
                "Add photographs of one thing, taken from different places, or open a sample.";
            return knobs::instead(ui, words);
        }
        match project.view().step {
            Step::Photographs | Step::Calibrate => {
                photographs::picture(project, memory, ui, events)
            }
            Step::Features => features::picture(project, memory, ui),
            Step::Matches => matches::picture(project, ui, events),
            Step::TwoViews => two_views::picture(project, memory, ui),
            Step::Reconstruction | Step::Export => reconstruction::picture(project, memory, ui),
            Step::Depth => depth::picture(project, memory, ui),
            Step::Measure => measure::picture(project, memory, ui, events),
        }
    }

    fn knobs(&mut self, ui: &mut Ui, events: &mut Vec<Event>) {
        let (project, memory) = (&self.project, &mut self.memory);
        let step = project.view().step;
        let mut explain = false;
        let mut wish = None;
        let has_book = self.host.has_book();
        ScrollArea::vertical()
            .id_salt(step)
            .auto_shrink(false)
            .show(ui, |ui| {
                // Nothing lies under the bar that scrolls.
                ui.set_max_width(ui.available_width() - 10.0);
                ui.add_space(6.0);
                ui.horizontal_wrapped(|ui| {
                    ui.heading(step.title());
                    if has_book && ui.button("What is this?").clicked() {
                        explain = true;
                    }
                });
                match step {
                    Step::Photographs => wish = photographs::knobs(project, memory, ui, events),
                    Step::Calibrate => wish = calibrate::knobs(project, memory, ui, events),
                    Step::Features => features::knobs(project, memory, ui, events),
                    Step::Matches => matches::knobs(project, memory, ui, events),
                    Step::TwoViews => two_views::knobs(project, memory, ui, events),
                    Step::Reconstruction => reconstruction::knobs(project, memory, ui, events),
                    Step::Depth => depth::knobs(project, memory, ui, events),
                    Step::Measure => measure::knobs(project, memory, ui, events),
                    Step::Export => wish = export::knobs(project, ui),
                }
            });
        if let Some(wish) = wish {
            self.grant(wish);
        }
        if explain {
            self.host.explain(step.about());
        }
    }

    fn grant(&mut self, wish: Wish) {
        match wish {
            Wish::TakePhotographs => {
                if !self.host.ask_for_camera() {
                    self.work.news =
                        Some("Only the Lab in a browser can take photographs.".to_owned());
                }
            }
            Wish::Export => {
                if let Some(request) = self.project.export_request() {
                    self.work.run(Errand::Export, &request, &mut self.host);
                }
            }
            Wish::SaveView => {
                if let Some((width, rgba)) = self.memory.cloud.pixels() {
                    let request = Request::Picture { width, rgba };
                    self.work.run(Errand::View, &request, &mut self.host);
                }
            }
            Wish::SaveCamera => {
                if let Some(text) = self.project.camera_json() {
                    let saved = self.host.save("camera.json", text.into_bytes());
                    let (Ok(sentence) | Err(sentence)) = saved;
                    self.work.news = Some(sentence);
                }
            }
        }
    }
}
