//! Interface to the page: functions of its script, and input that waits for the next frame.

use crate::project::{Blob, Explanation};
use crate::session::{Host, HostEvent, JobId, Report};
use crate::tasks::Branch;
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Script of the page, which has workers, file inputs and downloads.
    pub type Shell;

    #[wasm_bindgen(method, structural)]
    fn capacity(this: &Shell) -> u32;
    #[wasm_bindgen(method, structural)]
    fn start(this: &Shell, job: f64, branch: &str, request: Vec<u8>);
    #[wasm_bindgen(method, structural)]
    fn cancel(this: &Shell, job: f64);
    #[wasm_bindgen(method, structural, js_name = bringsSample)]
    fn brings_sample(this: &Shell) -> bool;
    #[wasm_bindgen(method, structural, js_name = askForPhotographs)]
    fn ask_for_photographs(this: &Shell);
    #[wasm_bindgen(method, structural, js_name = askForProject)]
    fn ask_for_project(this: &Shell);
    #[wasm_bindgen(method, structural, js_name = askForCameraFiles)]
    fn ask_for_camera_files(this: &Shell);
    #[wasm_bindgen(method, structural, js_name = askForCamera)]
    fn ask_for_camera(this: &Shell);
    #[wasm_bindgen(method, structural, js_name = askForFrames)]
    fn ask_for_frames(this: &Shell, video: u32, part: u32, num_parts: u32);
    #[wasm_bindgen(method, structural)]
    fn save(this: &Shell, name: &str, bytes: Vec<u8>);
    #[wasm_bindgen(method, structural)]
    fn say(this: &Shell, words: &str);
    #[wasm_bindgen(method, structural)]
    fn explain(this: &Shell, figure: &str, page: &str, title: &str);
    #[wasm_bindgen(method, structural)]
    fn address(this: &Shell, link: &str);
    #[wasm_bindgen(method, structural)]
    fn keep(this: &Shell, project: Vec<u8>);
    #[wasm_bindgen(method, structural)]
    fn forget(this: &Shell);
    #[wasm_bindgen(method, structural, js_name = askForKept)]
    fn ask_for_kept(this: &Shell);
}

/// Unread input from the page.
#[derive(Default)]
pub(super) struct Inbox {
    pub(super) reports: Vec<Report>,
    pub(super) host_events: Vec<HostEvent>,
    pub(super) photographs: Vec<(String, Blob)>,
    pub(super) cameras: Vec<(String, Blob)>,
    pub(super) frames: Vec<Blob>,
    pub(super) theme: Option<String>,
    pub(super) context: Option<egui::Context>,
}

/// Host of the Lab in a page.
pub(super) struct Page {
    pub(super) shell: Shell,
    pub(super) inbox: Rc<RefCell<Inbox>>,
}

impl Host for Page {
    fn capacity(&self) -> usize {
        self.shell.capacity() as usize
    }

    fn start(&mut self, job: JobId, branch: Branch, request: Vec<u8>) {
        let branch = match branch {
            Branch::Vision => "vision",
            Branch::Files => "files",
        };
        self.shell.start(job as f64, branch, request);
    }

    fn cancel(&mut self, job: JobId) {
        self.shell.cancel(job as f64);
    }

    fn reports(&mut self) -> Vec<Report> {
        std::mem::take(&mut self.inbox.borrow_mut().reports)
    }

    fn host_events(&mut self) -> Vec<HostEvent> {
        std::mem::take(&mut self.inbox.borrow_mut().host_events)
    }

    fn brings_sample(&self) -> bool {
        self.shell.brings_sample()
    }

    fn ask_for_photographs(&mut self) -> bool {
        self.shell.ask_for_photographs();
        true
    }

    fn ask_for_project(&mut self) -> bool {
        self.shell.ask_for_project();
        true
    }

    fn ask_for_camera_files(&mut self) -> bool {
        self.shell.ask_for_camera_files();
        true
    }

    fn ask_for_camera(&mut self) -> bool {
        self.shell.ask_for_camera();
        true
    }

    fn ask_for_frames(&mut self, video: u32, part: u32, num_parts: u32) {
        self.shell.ask_for_frames(video, part, num_parts);
    }

    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String> {
        self.shell.save(name, bytes);
        Ok(format!("{name} is saved."))
    }

    fn say(&mut self, words: &str) {
        self.shell.say(words);
    }

    fn explain(&mut self, explanation: Explanation) {
        self.shell
            .explain(explanation.figure, explanation.page, explanation.title);
    }

    fn has_book(&self) -> bool {
        true
    }

    fn address(&mut self, link: &str) {
        self.shell.address(link);
    }

    fn can_keep(&self) -> bool {
        true
    }

    fn keep(&mut self, project: Vec<u8>) {
        self.shell.keep(project);
    }

    fn forget(&mut self) {
        self.shell.forget();
    }

    fn ask_for_kept(&mut self) {
        self.shell.ask_for_kept();
    }
}
