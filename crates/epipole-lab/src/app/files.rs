//! Results of file jobs: files to save, projects to open, frames of videos.

use super::App;
use crate::project::{Event, count};
use crate::session::{FileJob, Host};
use crate::tasks::{Answer, Blob};

impl<H: Host> App<H> {
    /// Handles the result of a file job.
    pub(super) fn finish(&mut self, job: FileJob, result: Result<Vec<u8>, String>) {
        let answer = result.and_then(|bytes| Answer::from_bytes(&bytes));
        match job {
            FileJob::Frames(video) => self.take_frames(video, answer),
            FileJob::Store => self.take_written(answer),
            FileJob::Restore => self.restore(answer),
            _ => {
                self.storage.is_restored = false;
                self.news = Some(self.take_file(job, answer));
            }
        }
    }

    /// Saves or opens a file. Returns the message to show.
    fn take_file(&mut self, job: FileJob, answer: Result<Answer, String>) -> String {
        let mut save = |name: &str, bytes: Blob| {
            let (Ok(sentence) | Err(sentence)) = self.host.save(name, bytes.to_vec());
            sentence
        };
        match (job, answer) {
            (_, Err(sentence)) => sentence,
            (FileJob::SaveReconstruction, Ok(Answer::Archive(bytes))) => {
                save("reconstruction.zip", bytes)
            }
            (FileJob::SaveProject, Ok(Answer::Archive(bytes))) => save("project.zip", bytes),
            (FileJob::SaveView, Ok(Answer::Archive(bytes))) => save("view.png", bytes),
            (
                FileJob::Open,
                Ok(Answer::Opened {
                    project,
                    files,
                    computed,
                }),
            ) => {
                let event = Event::OpenProject(Box::new(project), files);
                self.project.update(event);
                self.project.bring(computed);
                "The project is open.".to_owned()
            }
            (_, Ok(_)) => "an unexpected answer arrived".to_owned(),
        }
    }

    /// Requests the next part of a video, or adds the frames of all parts.
    fn take_frames(&mut self, video: u32, answer: Result<Answer, String>) {
        let frames = match answer {
            Ok(Answer::Frames(frames)) => frames,
            Ok(_) => Vec::new(),
            Err(sentence) => {
                self.videos.give_up(video, &mut self.host);
                self.news = Some(sentence);
                return;
            }
        };
        let Some(chosen) = self.videos.take(video, frames, &mut self.host) else {
            return;
        };
        if chosen.is_empty() {
            self.news = Some("No frame of the video can be read.".to_owned());
            return;
        }
        let verb = if chosen.len() == 1 { "was" } else { "were" };
        let frames = count(chosen.len(), "frame");
        self.news = Some(format!("{frames} {verb} taken from the video."));
        self.add_photographs(chosen);
    }

    /// Hands the written project to the browser.
    fn take_written(&mut self, answer: Result<Answer, String>) {
        match answer {
            // It may have been erased meanwhile.
            _ if !self.storage.is_open() => {}
            Ok(Answer::Archive(bytes)) => self.host.keep(bytes.to_vec()),
            Ok(_) => {}
            Err(sentence) => self.not_stored(&sentence, false),
        }
    }

    /// Opens the stored project, at the current step.
    fn restore(&mut self, answer: Result<Answer, String>) {
        match answer {
            Ok(Answer::Opened {
                project,
                files,
                computed,
            }) => {
                let step = self.project.view().step;
                let event = Event::OpenProject(Box::new(project), files);
                self.project.update(event);
                self.project.bring(computed);
                self.project.update(Event::Show(step));
                // The state before the restore was never visible.
                self.project.clear_history();
                self.storage.restored(self.project.saved_key());
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
