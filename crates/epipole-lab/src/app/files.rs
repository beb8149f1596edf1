//! Results of file jobs: files to save, projects to open, frames of videos.

use super::App;
use crate::project::Blob;
use crate::session::{Event, FileJob, Host, count};
use crate::tasks::{
    CamerasRead, ChooseFrame, Export, OpenProject, Opened, ReadCameras, SaveProject, Task,
    WriteCamera, WritePicture,
};

impl<H: Host> App<H> {
    /// Handles the result of a file job.
    pub(super) fn finish(&mut self, job: FileJob, result: Result<Vec<u8>, String>) {
        let done = match job {
            FileJob::SaveReconstruction => self.save::<Export>("reconstruction.zip", result),
            FileJob::SaveProject => self.save::<SaveProject>("project.zip", result),
            FileJob::SaveView => self.save::<WritePicture>("view.png", result),
            FileJob::Open => read::<OpenProject>(result).map(|opened| {
                self.open(opened);
                "The project is open.".to_owned()
            }),
            FileJob::SaveCamera(format) => self.save::<WriteCamera>(format.file_name(), result),
            FileJob::OpenCameras => read::<ReadCameras>(result).map(|read| match read {
                CamerasRead::Camera(camera) => {
                    self.project.update(Event::UseCamera(Some(camera)));
                    self.project.use_words().trim().to_owned()
                }
                CamerasRead::Poses(poses) => {
                    let notice = format!("{} is in use.", poses.file);
                    self.project.update(Event::UsePoses(Some(poses)));
                    notice
                }
            }),
            FileJob::Frames(video) => return self.take_frames(video, read::<ChooseFrame>(result)),
            FileJob::Store => return self.take_written(read::<SaveProject>(result)),
            FileJob::Restore => return self.restore(read::<OpenProject>(result)),
        };
        self.storage.is_restored = false;
        let (Ok(sentence) | Err(sentence)) = done;
        self.notice = Some(sentence);
    }

    /// Saves the file written by a task. Returns the message to show.
    fn save<T: Task<Output = Blob>>(
        &mut self,
        name: &str,
        result: Result<Vec<u8>, String>,
    ) -> Result<String, String> {
        self.host.save(name, read::<T>(result)?.to_vec())
    }

    fn open(&mut self, opened: Opened) {
        let event = Event::OpenProject(Box::new(opened.project), opened.files);
        self.project.update(event);
        self.project.import(opened.computed);
    }

    /// Requests the next part of a video, or adds the frames of all parts.
    fn take_frames(&mut self, video: u32, frames: Result<Vec<(String, Blob)>, String>) {
        let frames = match frames {
            Ok(frames) => frames,
            Err(sentence) => {
                self.videos.give_up(video, &mut self.host);
                self.notice = Some(sentence);
                return;
            }
        };
        let Some(chosen) = self.videos.take(video, frames, &mut self.host) else {
            return;
        };
        if chosen.is_empty() {
            self.notice = Some("No frame of the video can be read.".to_owned());
            return;
        }
        let verb = if chosen.len() == 1 { "was" } else { "were" };
        let frames = count(chosen.len(), "frame");
        self.notice = Some(format!("{frames} {verb} taken from the video."));
        self.add_photographs(chosen);
    }

    /// Hands the written project to the browser.
    fn take_written(&mut self, written: Result<Blob, String>) {
        match written {
            // The stored project may have been erased meanwhile.
            _ if !self.storage.is_open() => {}
            Ok(bytes) => self.host.keep(bytes.to_vec()),
            Err(sentence) => self.not_stored(&sentence, false),
        }
    }

    /// Opens the stored project, at the current step.
    fn restore(&mut self, opened: Result<Opened, String>) {
        match opened {
            Ok(opened) => {
                let step = self.project.view().step;
                self.open(opened);
                self.project.update(Event::Show(step));
                // The state before the restore was never visible.
                self.project.clear_history();
                self.storage.restored(self.project.saved_key());
                self.notice = Some(
                    "The project kept in this browser is open again. Nothing was uploaded."
                        .to_owned(),
                );
            }
            Err(sentence) => {
                self.notice = Some(format!(
                    "The kept project does not open: {sentence}. It stays until you forget it in the Project menu."
                ));
            }
        }
    }
}

/// Decodes the output of a task.
fn read<T: Task>(result: Result<Vec<u8>, String>) -> Result<T::Output, String> {
    T::read(&result?)
}
