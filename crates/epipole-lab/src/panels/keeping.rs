//! A project that the reader chose to keep in the browser: when it is put there, how it comes back,
//! how it is forgotten.

use super::host::{Host, Kept};
use super::menu;
use super::work::{Errand, Work};
use crate::project::{Event, Key, Project, Step};
use crate::tasks::{Answer, Request, Sample};
use std::time::Duration;

/// Time without changes after which they are kept, seconds.
const REST_S: f64 = 1.0;

/// State of the kept project.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum State {
    /// Nothing.
    #[default]
    Nothing,
    /// A project that is not open.
    Aside,
    /// The project that is open, with every change.
    Open,
}

/// Keeping of the project in the browser.
#[derive(Default)]
pub(super) struct Keeping {
    state: State,
    /// Key of the kept version, or of the one being written.
    kept: Option<Key>,
    /// Key of a changed version, and the time of the change in seconds.
    changed: Option<(Key, f64)>,
    /// Whether to confirm to the reader that it is kept.
    is_new: bool,
    /// Whether it was just restored.
    pub(super) is_back: bool,
}

/// Bytes in words.
fn megabytes(bytes: usize) -> String {
    match bytes {
        0..100_000 => "less than 0.1 MB".to_owned(),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

impl Work {
    /// The choice in the menu of the project.
    pub(super) fn keeping_menu(
        &mut self,
        project: &Project,
        host: &mut impl Host,
        ui: &mut egui::Ui,
    ) {
        ui.separator();
        let state = self.keeping.state;
        if state == State::Aside {
            if menu::item(ui, "Open the kept project") {
                host.ask_for_kept();
            }
        } else {
            let mut is_on = state == State::Open;
            if menu::toggle(ui, &mut is_on, "Keep in this browser") {
                match is_on {
                    true => {
                        self.keeping.state = State::Open;
                        self.keeping.is_new = true;
                    }
                    false => self.forget_kept(host),
                }
            }
        }
        if state != State::Nothing && menu::item(ui, "Forget it") {
            self.forget_kept(host);
        }
        if state != State::Aside {
            let room = megabytes(project.num_file_bytes());
            ui.weak(format!("Uses {room} on this machine. Nothing is uploaded."));
        }
    }

    /// Nothing is kept any more.
    fn forget_kept(&mut self, host: &mut impl Host) {
        self.keeping = Keeping::default();
        host.forget();
        self.news = Some("The project is no longer kept in this browser.".to_owned());
    }

    /// A way back to how the Lab opens for everyone, beside the sentence that a project came back.
    pub(super) fn start_over(
        &mut self,
        host: &mut impl Host,
        ui: &mut egui::Ui,
        events: &mut Vec<Event>,
    ) {
        if self.keeping.is_back && ui.button("Start over").clicked() {
            self.forget_kept(host);
            events.push(Event::OpenSample(Sample::Table));
            events.push(Event::Show(Step::Reconstruction));
        }
    }

    /// Keeps the project after a pause in the changes.
    pub(super) fn keep(&mut self, project: &Project, host: &mut impl Host, ui: &egui::Ui) {
        if self.keeping.state != State::Open {
            return;
        }
        let key = project.saved_key();
        if self.keeping.kept == Some(key) {
            self.keeping.changed = None;
            return;
        }
        let now_s = ui.input(|input| input.time);
        let since_s = match self.keeping.changed {
            Some((changed, since_s)) if changed == key => since_s,
            _ => {
                self.keeping.changed = Some((key, now_s));
                now_s
            }
        };
        let rest_s = since_s + REST_S - now_s;
        if rest_s > 0.0 {
            ui.ctx()
                .request_repaint_after(Duration::from_secs_f64(rest_s));
        } else if !self.runs(Errand::Keep) && !self.runs(Errand::Open) {
            self.keeping.kept = Some(key);
            self.start_errand(Errand::Keep, &project.keep_request(), host);
        }
    }

    /// Hands the written project to the browser.
    pub(super) fn written(&mut self, answer: Result<Answer, String>, host: &mut impl Host) {
        match answer {
            // It may have been forgotten meanwhile.
            _ if self.keeping.state != State::Open => {}
            Ok(Answer::Archive(bytes)) => host.keep(bytes.to_vec()),
            Ok(_) => {}
            Err(sentence) => self.not_kept(&sentence, false),
        }
    }

    fn not_kept(&mut self, why: &str, is_there: bool) {
        self.keeping = Keeping::default();
        let before = match is_there {
            true => {
                self.keeping.state = State::Aside;
                " The project kept before is still there."
            }
            false => "",
        };
        self.news = Some(format!(
            "The project is not kept in this browser: {why} Save it as a file from the Project menu.{before}"
        ));
    }

    /// Handles news of the kept project.
    pub(super) fn hear_of_kept(&mut self, kept: Kept, host: &mut impl Host) {
        match kept {
            Kept::Project(archive) => {
                self.keeping.state = State::Aside;
                self.run(Errand::Reopen, &Request::Open { archive }, host);
            }
            Kept::Aside(sentence) => {
                self.keeping = Keeping::default();
                self.keeping.state = State::Aside;
                self.news = Some(sentence);
            }
            Kept::Done(num_bytes) => {
                if std::mem::take(&mut self.keeping.is_new) {
                    let room = megabytes(num_bytes);
                    self.news = Some(format!(
                        "This browser keeps the project, {room}, and every change to it. Nothing is uploaded."
                    ));
                }
            }
            Kept::Not { why, is_there } => self.not_kept(&why, is_there),
            Kept::Forgotten => {
                self.keeping = Keeping::default();
                self.news = Some("Another page of the Lab removed the kept project from this browser. It is still open here.".to_owned());
            }
        }
    }

    /// Opens the kept project, at the current step.
    pub(super) fn reopened(&mut self, answer: Result<Answer, String>, project: &mut Project) {
        match answer {
            Ok(Answer::Opened {
                project: saved,
                files,
                computed,
            }) => {
                let step = project.view().step;
                project.update(Event::OpenProject(Box::new(saved), files));
                project.bring(computed);
                project.update(Event::Show(step));
                // The state before the restore was never visible.
                project.forget_past();
                self.keeping = Keeping {
                    state: State::Open,
                    kept: Some(project.saved_key()),
                    is_back: true,
                    ..Keeping::default()
                };
                self.news = Some(
                    "The project kept in this browser is open again. Nothing was uploaded."
                        .to_owned(),
                );
            }
            Ok(_) => {}
            Err(sentence) => {
                self.news = Some(format!(
                    "The kept project does not open: {sentence}. It stays until you forget it in the Project menu."
                ));
            }
        }
    }
}
