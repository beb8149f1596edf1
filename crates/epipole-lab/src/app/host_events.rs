//! Handling of host events: photographs (of boards in the step "Calibrate"), projects, videos,
//! links.

use super::App;
use crate::project::{Blob, Computed, Step};
use crate::session::{Event, FileJob, Host, HostEvent, Stored};
use crate::tasks::{ChooseFrame, OpenProject, ReadCameras};

impl<H: Host> App<H> {
    pub(super) fn take(&mut self, host_event: HostEvent) {
        match host_event {
            HostEvent::Photographs(files) => self.add_photographs(files),
            HostEvent::Project(archive) => self.run(FileJob::Open, OpenProject { archive }),
            HostEvent::Cameras(files) => {
                let photos = self.project.photo_files();
                let task = ReadCameras { files, photos };
                self.run(FileJob::OpenCameras, task);
            }
            HostEvent::Link(parameters) => {
                let problems = self.project.open_link(&parameters);
                if !problems.is_empty() {
                    self.notice = Some(problems.join(" "));
                }
            }
            HostEvent::Video(video) => {
                let num_parts = self.project.document().settings.num_frames;
                self.videos.add(video, num_parts, &mut self.host);
            }
            HostEvent::Frames(video, name, frames) => {
                if let Some(part) = self.videos.part_of(video) {
                    let task = ChooseFrame { name, part, frames };
                    self.run(FileJob::Frames(video), task);
                }
            }
            HostEvent::NoFrames(video, sentence) => {
                self.videos.give_up(video, &mut self.host);
                self.notice = Some(sentence);
            }
            HostEvent::Stored(stored) => self.take_stored(stored),
            HostEvent::Results(bytes) => {
                self.waits_for_sample = false;
                self.project.import(Computed::from_bytes(&bytes));
            }
            HostEvent::Notice(sentence) => self.notice = Some(sentence),
        }
    }

    /// Adds photographs, which replace a sample.
    pub(super) fn add_photographs(&mut self, files: Vec<(String, Blob)>) {
        let document = self.project.document();
        if self.project.view().step == Step::Calibrate {
            if document.has_sample_boards() {
                self.project.update(Event::ClearBoards);
            }
            self.project.update(Event::AddBoards(files));
            return;
        }
        // A single event, so that one undo reverts it.
        self.project.update(match document.is_sample() {
            true => Event::Begin(files),
            false => Event::Add(files),
        });
        self.project.update(Event::Show(Step::Photographs));
    }

    fn take_stored(&mut self, stored: Stored) {
        match stored {
            Stored::Project(archive) => {
                self.storage.close();
                self.run(FileJob::Restore, OpenProject { archive });
            }
            Stored::Closed(sentence) => {
                self.storage.close();
                self.notice = Some(sentence);
            }
            Stored::Written(num_bytes) => {
                if self.storage.end() {
                    let room = megabytes(num_bytes);
                    self.notice = Some(format!(
                        "This browser keeps the project, {room}, and every change to it. Nothing is uploaded."
                    ));
                }
            }
            Stored::Failed { why, is_there } => self.not_stored(&why, is_there),
            Stored::Erased => {
                self.storage.turn_off();
                self.notice = Some("Another page of the Lab removed the kept project from this browser. It is still open here.".to_owned());
            }
        }
    }

    pub(super) fn not_stored(&mut self, why: &str, is_there: bool) {
        self.storage.turn_off();
        let before = match is_there {
            true => {
                self.storage.close();
                " The project kept before is still there."
            }
            false => "",
        };
        self.notice = Some(format!(
            "The project is not kept in this browser: {why} Save it as a file from the Project menu.{before}"
        ));
    }

    /// Erases the stored project.
    pub(super) fn erase_stored(&mut self) {
        self.storage.turn_off();
        self.host.forget();
        self.notice = Some("The project is no longer kept in this browser.".to_owned());
    }
}

/// Formats a number of bytes in megabytes.
pub(super) fn megabytes(bytes: usize) -> String {
    match bytes {
        0..100_000 => "less than 0.1 MB".to_owned(),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}
