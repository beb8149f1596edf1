//! The wasm interface: exports for the page, imports from it.

use super::mirror::{Mirror, Operation};
use super::shell::{Inbox, Page, Shell};
use crate::app::{App, prepare, set_theme};
use crate::session::{HostEvent, JobId, Report, Stored};
use eframe::web_sys::HtmlCanvasElement;
use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// Delay of a progress report until the next frame: several workers report within it, and each
/// frame slows them down.
const PATIENCE: Duration = Duration::from_millis(250);

/// Delay until an answer is shown.
const SOON: Duration = Duration::from_millis(120);
/// Delay of a single further frame: without any, egui draws two.
const NEXT: Duration = Duration::from_millis(1);

struct Frames(App<Page>);

impl eframe::App for Frames {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let inbox = Rc::clone(&self.0.host().inbox);
        if let Some(theme) = inbox.borrow_mut().theme.take() {
            set_theme(ui.ctx(), &theme);
        }
        // Answers request a frame when they arrive, so nothing has to be drawn until then.
        self.0.advance();
        self.0.ui(ui);
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

/// The Lab of a page.
#[wasm_bindgen]
pub struct Lab {
    runner: eframe::WebRunner,
    inbox: Rc<RefCell<Inbox>>,
    mirror: Mirror,
}

#[wasm_bindgen]
impl Lab {
    /// A Lab that shows nothing yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self {
            runner: eframe::WebRunner::new(),
            inbox: Rc::default(),
            mirror: Mirror::default(),
        }
    }

    /// Shows itself on a canvas.
    ///
    /// # Errors
    /// If there is no WebGL.
    pub async fn start(&self, canvas: HtmlCanvasElement, shell: Shell) -> Result<(), JsValue> {
        let (inbox, mirror) = (Rc::clone(&self.inbox), self.mirror.clone());
        let creator = Box::new(move |creation: &eframe::CreationContext<'_>| {
            prepare(&creation.egui_ctx);
            creation.egui_ctx.add_plugin(mirror);
            inbox.borrow_mut().context = Some(creation.egui_ctx.clone());
            let app = App::new(Page { shell, inbox });
            Ok(Box::new(Frames(app)) as Box<dyn eframe::App>)
        });
        let options = eframe::WebOptions::default();
        self.runner.start(canvas, options, creator).await
    }

    /// Takes something, for the next frame.
    fn receive(&self, put: impl FnOnce(&mut Inbox)) {
        self.receive_within(Duration::ZERO, put);
    }

    /// The same for something that can wait for others.
    fn receive_within(&self, wait: Duration, put: impl FnOnce(&mut Inbox)) {
        let mut inbox = self.inbox.borrow_mut();
        put(&mut inbox);
        if let Some(context) = &inbox.context {
            context.request_repaint_after(wait);
        }
    }

    /// Starts the follow-up jobs of an answer at once: workers do not wait for a frame.
    fn answered(&self, report: Report) {
        self.receive_within(SOON, |inbox| inbox.reports.push(report));
        let rests = (self.runner.app_mut::<Frames>()).is_none_or(|mut frames| {
            frames.0.advance();
            !frames.0.is_waiting()
        });
        if !rests {
            self.receive_within(NEXT, |_| {});
        }
    }

    /// Reports the progress of a job.
    pub fn progress(&self, job: f64, share: f32, words: String) {
        self.receive_within(PATIENCE, |inbox| {
            inbox
                .reports
                .push(Report::Progress(job as JobId, share, words))
        });
    }

    /// Delivers the intermediate result of a job.
    #[wasm_bindgen(js_name = soFar)]
    pub fn so_far(&self, job: f64, answer: Vec<u8>) {
        let report = Report::Partial(job as JobId, answer);
        self.receive_within(PATIENCE, |inbox| inbox.reports.push(report));
    }

    /// Delivers an answer.
    pub fn done(&self, job: f64, answer: Vec<u8>) {
        self.answered(Report::Done(job as JobId, Ok(answer)));
    }

    /// Delivers an error message; `broken` for a failure of the worker itself.
    pub fn failed(&self, job: f64, sentence: String, broken: bool) {
        let job = job as JobId;
        let report = match broken {
            true => Report::Broken(job, sentence),
            false => Report::Done(job, Err(sentence)),
        };
        self.answered(report);
    }

    /// Delivers a photograph, to be added with the next [`Lab::deliver`].
    pub fn photograph(&self, name: String, bytes: Vec<u8>) {
        self.inbox
            .borrow_mut()
            .photographs
            .push((name, bytes.into()));
    }

    /// All photographs of one choice have come.
    pub fn deliver(&self) {
        self.receive(|inbox| {
            let photographs = std::mem::take(&mut inbox.photographs);
            inbox.host_events.push(HostEvent::Photographs(photographs));
        });
    }

    /// Announces a video whose frames can be requested.
    pub fn video(&self, video: u32) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Video(video)));
    }

    /// Delivers a frame of the requested part of a video, to be used with the next [`Lab::frames`].
    pub fn frame(&self, bytes: Vec<u8>) {
        self.inbox.borrow_mut().frames.push(bytes.into());
    }

    /// All frames of that part have been delivered.
    pub fn frames(&self, video: u32, name: String) {
        self.receive(|inbox| {
            let frames = std::mem::take(&mut inbox.frames);
            inbox
                .host_events
                .push(HostEvent::Frames(video, name, frames));
        });
    }

    /// No more frames of a video follow, with the reason.
    #[wasm_bindgen(js_name = noFrames)]
    pub fn no_frames(&self, video: u32, sentence: String) {
        self.receive(|inbox| {
            inbox.frames.clear();
            inbox.host_events.push(HostEvent::NoFrames(video, sentence));
        });
    }

    /// Shows progress or an error message.
    pub fn notice(&self, sentence: String) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Notice(sentence)));
    }

    /// Applies the parameters of an address: names and values by turns.
    pub fn link(&self, parameters: Vec<String>) {
        let pairs = parameters.chunks_exact(2);
        let parameters = pairs
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect();
        self.receive(|inbox| inbox.host_events.push(HostEvent::Link(parameters)));
    }

    /// Delivers the precomputed results of the sample; empty if they could not be loaded.
    pub fn solved(&self, computed: Vec<u8>) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Results(computed.into())));
    }

    /// Opens a project.
    pub fn project(&self, archive: Vec<u8>) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Project(archive.into())));
    }

    /// Delivers a file of cameras, to be opened with the next [`Lab::cameras`].
    #[wasm_bindgen(js_name = cameraFile)]
    pub fn camera_file(&self, name: String, bytes: Vec<u8>) {
        self.inbox.borrow_mut().cameras.push((name, bytes.into()));
    }

    /// All files of cameras that were chosen together have been delivered.
    pub fn cameras(&self) {
        self.receive(|inbox| {
            let cameras = std::mem::take(&mut inbox.cameras);
            inbox.host_events.push(HostEvent::Cameras(cameras));
        });
    }

    fn stored(&self, stored: Stored) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Stored(stored)));
    }

    /// Delivers the project that the browser keeps.
    #[wasm_bindgen(js_name = keptProject)]
    pub fn kept_project(&self, archive: Vec<u8>) {
        self.stored(Stored::Project(archive.into()));
    }

    /// The browser keeps a project that is not open, and a sentence why.
    #[wasm_bindgen(js_name = keptAside)]
    pub fn kept_aside(&self, sentence: String) {
        self.stored(Stored::Closed(sentence));
    }

    /// The project was kept: number of bytes.
    pub fn kept(&self, num_bytes: f64) {
        self.stored(Stored::Written(num_bytes as usize));
    }

    /// The project was not kept, with the reason, and whether the previous one still exists.
    #[wasm_bindgen(js_name = notKept)]
    pub fn not_kept(&self, why: String, is_there: bool) {
        self.stored(Stored::Failed { why, is_there });
    }

    /// Another page has erased the kept project.
    pub fn forgotten(&self) {
        self.stored(Stored::Erased);
    }

    /// Puts a theme on: "light", "dark" or "high-contrast".
    pub fn theme(&self, theme: String) {
        self.receive(|inbox| inbox.theme = Some(theme));
    }

    /// All widgets, if they have changed: one per line, in the format of `mirror.rs`.
    pub fn widgets(&self) -> Option<String> {
        self.mirror.changed_widgets()
    }

    /// Operates a widget, by its number, role and name: clicks it, or sets its number.
    pub fn operate(&self, widget: &str, role: String, name: String, value: Option<f64>) {
        let Ok(widget) = widget.parse() else { return };
        self.mirror.operate(Operation {
            widget,
            role,
            name,
            value,
            missed: 0,
        });
        self.receive(|_| {});
    }

    /// The message of a panic, after which the Lab has stopped.
    pub fn panic(&self) -> Option<String> {
        self.runner.panic_summary().map(|summary| summary.message())
    }
}
