//! The panels on a host that computes synchronously, operated by their labels.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use epipole_lab::app::{App, prepare};
use epipole_lab::project::Explanation;
use epipole_lab::session::{Host, HostEvent, JobId, Report, Stored};
use epipole_lab::tasks::Branch;

/// A host that computes at once.
#[derive(Default)]
pub(crate) struct Desk {
    pub(crate) reports: Vec<Report>,
    pub(crate) host_events: Vec<HostEvent>,
    pub(crate) saved: Vec<(String, Vec<u8>)>,
    pub(crate) said: String,
    pub(crate) asked: usize,
    pub(crate) frames: Vec<(u32, u32, u32)>,
    pub(crate) explained: Vec<Explanation>,
    pub(crate) address: String,
    pub(crate) kept: Option<Vec<u8>>,
    /// Number of jobs started.
    pub(crate) num_started: usize,
    /// Whether the sample comes solved.
    pub(crate) brings_sample: bool,
    /// Whether everything that is computed breaks down.
    pub(crate) breaks: bool,
    /// Whether it keeps nothing, as a window: then a menu has less in it, and is narrower.
    pub(crate) keeps_nothing: bool,
}

impl Host for Desk {
    fn capacity(&self) -> usize {
        4
    }

    fn start(&mut self, work: JobId, _branch: Branch, request: Vec<u8>) {
        self.num_started += 1;
        if self.breaks {
            let sentence = "there is not enough memory".to_owned();
            self.reports.push(Report::Broken(work, sentence));
            return;
        }
        self.reports
            .push(Report::Done(work, super::computed(&request)));
    }

    fn cancel(&mut self, _work: JobId) {}

    fn reports(&mut self) -> Vec<Report> {
        std::mem::take(&mut self.reports)
    }

    fn host_events(&mut self) -> Vec<HostEvent> {
        std::mem::take(&mut self.host_events)
    }

    fn brings_sample(&self) -> bool {
        self.brings_sample
    }

    fn ask_for_photographs(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_project(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_camera_files(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_camera(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_frames(&mut self, video: u32, part: u32, num_parts: u32) {
        self.frames.push((video, part, num_parts));
    }

    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String> {
        self.saved.push((name.to_owned(), bytes));
        Ok(format!("{name} is saved."))
    }

    fn explain(&mut self, explanation: Explanation) {
        self.explained.push(explanation);
    }

    fn has_book(&self) -> bool {
        true
    }

    fn address(&mut self, link: &str) {
        self.address = link.to_owned();
    }

    fn can_keep(&self) -> bool {
        !self.keeps_nothing
    }

    fn keep(&mut self, project: Vec<u8>) {
        let host_event = HostEvent::Stored(Stored::Written(project.len()));
        self.host_events.push(host_event);
        self.kept = Some(project);
    }

    fn forget(&mut self) {
        self.kept = None;
    }

    fn ask_for_kept(&mut self) {
        let kept = self.kept.clone();
        let host_event = kept.map(|project| HostEvent::Stored(Stored::Project(project.into())));
        self.host_events.extend(host_event);
    }

    fn say(&mut self, words: &str) {
        self.said = words.to_owned();
    }
}

pub(crate) type Bench<'a> = Harness<'a, App<Desk>>;

/// The Lab in a screen of this size, when the sample is solved.
pub(crate) fn open<'a>(width: f32, height: f32) -> Bench<'a> {
    open_with(Desk::default(), width, height)
}

/// The same on a host of one's own.
pub(crate) fn open_with<'a>(desk: Desk, width: f32, height: f32) -> Bench<'a> {
    let frame = |ui: &mut egui::Ui, app: &mut App<Desk>| {
        app.advance();
        app.ui(ui);
    };
    let mut bench = Harness::builder()
        .with_size(egui::vec2(width, height))
        .with_context_setup(prepare)
        .build_ui_state(frame, App::new(desk));
    rest(&mut bench);
    bench
}

/// Clicks the first thing of this name.
pub(crate) fn click(bench: &mut Bench<'_>, name: &str) {
    bench.get_all_by_label(name).next().unwrap().click();
    bench.run_steps(4);
}

/// Draws frames until nothing is under way.
pub(crate) fn rest(bench: &mut Bench<'_>) {
    for _ in 0..200 {
        bench.step();
        if !bench.state_mut().advance() && bench.state().project().pending().is_empty() {
            break;
        }
    }
    bench.run_steps(3);
}
