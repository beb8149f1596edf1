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

/// Delay of a frame after a progress report: it collects reports of several workers, which each
/// frame slows down.
const PATIENCE: Duration = Duration::from_millis(250);

/// Delay of a frame after an answer.
const SOON: Duration = Duration::from_millis(120);
/// Delay that requests a single further frame; without one, egui draws two.
const NEXT: Duration = Duration::from_millis(1);

struct Frames(App<Page>);

impl eframe::App for Frames {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let inbox = Rc::clone(&self.0.host().inbox);
        if let Some(theme) = inbox.borrow_mut().theme.take() {
            set_theme(ui.ctx(), &theme);
        }
        // Answers request a frame when they arrive, so there is no need to draw before.
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
    /// Creates a Lab that shows nothing yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self {
            runner: eframe::WebRunner::new(),
            inbox: Rc::default(),
            mirror: Mirror::default(),
        }
    }

    /// Starts drawing on a canvas.
    ///
    /// # Errors
    /// If WebGL is not available.
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

    /// Puts input into the inbox, and requests a frame at once.
    fn receive(&self, put: impl FnOnce(&mut Inbox)) {
        self.receive_within(Duration::ZERO, put);
    }

    /// Puts input into the inbox, and requests a frame after a delay.
    fn receive_within(&self, wait: Duration, put: impl FnOnce(&mut Inbox)) {
        let mut inbox = self.inbox.borrow_mut();
        put(&mut inbox);
        if let Some(context) = &inbox.context {
            context.request_repaint_after(wait);
        }
    }

    /// Starts the follow-up jobs of an answer at once, so that workers do not wait for a frame.
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

    /// Delivers a photograph, to be added by the next [`Lab::deliver`].
    pub fn photograph(&self, name: String, bytes: Vec<u8>) {
        self.inbox
            .borrow_mut()
            .photographs
            .push((name, bytes.into()));
    }

    /// Adds the photographs delivered since the last call.
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

    /// Delivers a frame of the requested part of a video, to be used by the next [`Lab::frames`].
    pub fn frame(&self, bytes: Vec<u8>) {
        self.inbox.borrow_mut().frames.push(bytes.into());
    }

    /// Ends the frames of the requested part.
    pub fn frames(&self, video: u32, name: String) {
        self.receive(|inbox| {
            let frames = std::mem::take(&mut inbox.frames);
            inbox
                .host_events
                .push(HostEvent::Frames(video, name, frames));
        });
    }

    /// Ends a video early, with the reason.
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

    /// Applies the parameters of an address: names and values alternately.
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

    /// Delivers a camera file, to be opened by the next [`Lab::cameras`].
    #[wasm_bindgen(js_name = cameraFile)]
    pub fn camera_file(&self, name: String, bytes: Vec<u8>) {
        self.inbox.borrow_mut().cameras.push((name, bytes.into()));
    }

    /// Opens the camera files delivered since the last call.
    pub fn cameras(&self) {
        self.receive(|inbox| {
            let cameras = std::mem::take(&mut inbox.cameras);
            inbox.host_events.push(HostEvent::Cameras(cameras));
        });
    }

    fn stored(&self, stored: Stored) {
        self.receive(|inbox| inbox.host_events.push(HostEvent::Stored(stored)));
    }

    /// Delivers the project stored in the browser.
    #[wasm_bindgen(js_name = keptProject)]
    pub fn kept_project(&self, archive: Vec<u8>) {
        self.stored(Stored::Project(archive.into()));
    }

    /// Reports that the browser stores a project that is not open, with the reason.
    #[wasm_bindgen(js_name = keptAside)]
    pub fn kept_aside(&self, sentence: String) {
        self.stored(Stored::Closed(sentence));
    }

    /// Reports that the project was stored: number of bytes.
    pub fn kept(&self, num_bytes: f64) {
        self.stored(Stored::Written(num_bytes as usize));
    }

    /// Reports that the project was not stored, with the reason, and whether the previous one still
    /// exists.
    #[wasm_bindgen(js_name = notKept)]
    pub fn not_kept(&self, why: String, is_there: bool) {
        self.stored(Stored::Failed { why, is_there });
    }

    /// Reports that another page has erased the stored project.
    pub fn forgotten(&self) {
        self.stored(Stored::Erased);
    }

    /// Applies a theme: "light", "dark" or "high-contrast".
    pub fn theme(&self, theme: String) {
        self.receive(|inbox| inbox.theme = Some(theme));
    }

    /// Returns all widgets, if they have changed: one per line, in the format of `mirror.rs`.
    pub fn widgets(&self) -> Option<String> {
        self.mirror.changed_widgets()
    }

    /// Operates a widget, given its number, role and name: clicks it, or sets its value.
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

    /// Returns the message of a panic, after which the Lab has stopped.
    pub fn panic(&self) -> Option<String> {
        self.runner.panic_summary().map(|summary| summary.message())
    }
}
