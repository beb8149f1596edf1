//! The Lab in a window, with threads that compute. Files are given as arguments, chosen or dropped;
//! files are saved in the folder where the program was started.

mod dialog;
mod memory;

use dialog::FileKind;
use epipole_lab::app::{App, prepare};
use epipole_lab::project::Explanation;
use epipole_lab::session::{Host, HostEvent, JobId, Report};
use epipole_lab::tasks::{Branch, Progress, compute};
pub(crate) use memory::give_back;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, OnceLock};

/// Message after a panic.
const MISTAKE: &str =
    "this is a mistake of the Lab, not of your photographs: try again, or try other settings";

/// Opens the window.
///
/// # Errors
/// If there is no display, or no OpenGL.
pub(crate) fn run(files: Vec<PathBuf>) -> eframe::Result {
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Epipole Lab")
            .with_inner_size([1280.0, 800.0]),
        ..eframe::NativeOptions::default()
    };
    let create = Box::new(move |creation: &eframe::CreationContext<'_>| {
        prepare(&creation.egui_ctx);
        let window = Window::new(creation.egui_ctx.clone(), read(&files));
        Ok(Box::new(Frames(App::new(window))) as Box<dyn eframe::App>)
    });
    eframe::run_native("epipole-lab", options, create)
}

/// Reads files; an unreadable photograph shows its error in place of the image.
fn read(paths: &[PathBuf]) -> Vec<HostEvent> {
    let mut host_events = Vec::new();
    let (mut photographs, mut cameras) = (Vec::new(), Vec::new());
    for path in paths {
        if is_video(path) {
            let sentence =
                "Videos open in the Lab in a browser: their frames become photographs there.";
            host_events.push(HostEvent::Notice(sentence.to_owned()));
            continue;
        }
        let bytes = std::fs::read(path).unwrap_or_default();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.to_lowercase().ends_with(".zip") {
            host_events.push(HostEvent::Project(bytes.into()));
        } else if is_camera(path) {
            cameras.push((name.into_owned(), bytes.into()));
        } else {
            photographs.push((name.into_owned(), bytes.into()));
        }
    }
    if !photographs.is_empty() {
        host_events.push(HostEvent::Photographs(photographs));
    }
    // Poses are matched by the names of the photographs that were opened with them.
    if !cameras.is_empty() {
        host_events.push(HostEvent::Cameras(cameras));
    }
    host_events
}

fn is_video(path: &Path) -> bool {
    has_ending(path, &["mp4", "m4v", "mov", "webm", "mkv", "ogv", "avi"])
}

fn is_camera(path: &Path) -> bool {
    has_ending(path, FileKind::Cameras.endings())
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    endings.contains(&ending.to_lowercase().as_str())
}

struct Window {
    context: egui::Context,
    sender: Sender<Report>,
    receiver: Receiver<Report>,
    canceled: HashMap<JobId, Arc<AtomicBool>>,
    host_events: Vec<HostEvent>,
    /// Channel for the results of dialogs.
    chosen_sender: Sender<Vec<HostEvent>>,
    chosen: Receiver<Vec<HostEvent>>,
    /// Whether a dialog is open; only one is at a time.
    asks: Arc<AtomicBool>,
}

impl Window {
    fn new(context: egui::Context, host_events: Vec<HostEvent>) -> Self {
        let (sender, receiver) = channel();
        let (chosen_sender, chosen) = channel();
        Self {
            context,
            sender,
            receiver,
            canceled: HashMap::new(),
            host_events,
            chosen_sender,
            chosen,
            asks: Arc::default(),
        }
    }

    /// Opens a dialog without blocking.
    fn ask(&self, kind: FileKind) {
        if self.asks.swap(true, Ordering::Relaxed) {
            return;
        }
        let (asks, chosen, context) = (
            Arc::clone(&self.asks),
            self.chosen_sender.clone(),
            self.context.clone(),
        );
        std::thread::spawn(move || {
            let host_events = match dialog::ask(kind) {
                Some(paths) => read(&paths),
                None => {
                    let sentence = "There is no file dialog here: drop files onto this window, or name them when you start the Lab.";
                    vec![HostEvent::Notice(sentence.to_owned())]
                }
            };
            asks.store(false, Ordering::Relaxed);
            // The window may be gone by now.
            drop(chosen.send(host_events));
            context.request_repaint();
        });
    }
}

impl Host for Window {
    fn capacity(&self) -> usize {
        static COUNT: OnceLock<usize> = OnceLock::new();
        *COUNT.get_or_init(|| std::thread::available_parallelism().map_or(2, usize::from))
    }

    fn start(&mut self, job: JobId, _branch: Branch, request: Vec<u8>) {
        let stop = Arc::new(AtomicBool::new(false));
        self.canceled.insert(job, Arc::clone(&stop));
        let (sender, context) = (self.sender.clone(), self.context.clone());
        std::thread::spawn(move || {
            // The window may be gone by now.
            let tell = |report| drop(sender.send(report));
            let mut monitor = |progress: Progress<'_>| {
                tell(match progress {
                    Progress::Share(share, words) => Report::Progress(job, share, words.to_owned()),
                    Progress::Partial(bytes) => Report::Partial(job, bytes),
                });
                context.request_repaint();
                match stop.load(Ordering::Relaxed) {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            };
            // A panic leaves no shared state behind: a request goes in, an answer comes out.
            let computed = catch_unwind(AssertUnwindSafe(|| compute(&request, &mut monitor)));
            tell(match computed {
                Ok(result) => Report::Done(job, result),
                Err(_) => Report::Broken(job, MISTAKE.to_owned()),
            });
            context.request_repaint();
        });
    }

    fn cancel(&mut self, job: JobId) {
        if let Some(stop) = self.canceled.remove(&job) {
            stop.store(true, Ordering::Relaxed);
        }
    }

    fn reports(&mut self) -> Vec<Report> {
        let reports: Vec<Report> = self.receiver.try_iter().collect();
        for report in &reports {
            if let Report::Done(job, _) | Report::Broken(job, _) = report {
                self.canceled.remove(job);
            }
        }
        reports
    }

    fn host_events(&mut self) -> Vec<HostEvent> {
        self.host_events.extend(self.chosen.try_iter().flatten());
        std::mem::take(&mut self.host_events)
    }

    fn brings_sample(&self) -> bool {
        false
    }

    fn ask_for_photographs(&mut self) -> bool {
        self.ask(FileKind::Photographs);
        true
    }

    fn ask_for_project(&mut self) -> bool {
        self.ask(FileKind::Project);
        true
    }

    fn ask_for_camera_files(&mut self) -> bool {
        self.ask(FileKind::Cameras);
        true
    }

    fn ask_for_camera(&mut self) -> bool {
        false
    }

    fn ask_for_frames(&mut self, _video: u32, _part: u32, _num_parts: u32) {
        // Never called: no video arrives here.
    }

    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String> {
        let (stem, ending) = name.rsplit_once('.').unwrap_or((name, "zip"));
        let mut path = PathBuf::from(name);
        let mut number = 2;
        // Existing files are not overwritten.
        while path.exists() {
            path = PathBuf::from(format!("{stem}-{number}.{ending}"));
            number += 1;
        }
        match std::fs::write(&path, bytes) {
            Ok(()) => {
                let whole = std::path::absolute(&path).unwrap_or(path);
                Ok(format!("{} is saved.", whole.display()))
            }
            Err(error) => Err(format!("{} could not be written: {error}", path.display())),
        }
    }

    fn can_keep(&self) -> bool {
        // The reader saves and opens files instead.
        false
    }

    fn keep(&mut self, _project: Vec<u8>) {}

    fn forget(&mut self) {}

    fn ask_for_kept(&mut self) {}

    fn explain(&mut self, _explanation: Explanation) {}

    fn has_book(&self) -> bool {
        false
    }

    fn address(&mut self, _link: &str) {}

    fn say(&mut self, _words: &str) {
        // The toolkit reports to assistive technology itself.
    }
}

struct Frames(App<Window>);

impl eframe::App for Frames {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let dropped = ui.input(|input| input.raw.dropped_files.clone());
        let paths: Vec<PathBuf> = dropped
            .into_iter()
            .map(|file| file.path().to_path_buf())
            .collect();
        self.0.host().host_events.extend(read(&paths));
        self.0.advance();
        self.0.ui(ui);
    }
}
