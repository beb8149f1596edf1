//! Interface to the host of the Lab: a window or a page.

use crate::project::{Blob, Explanation};
use crate::tasks::Branch;

/// Identifier of a job.
pub type JobId = u64;

/// Message from a worker.
#[derive(Debug, Clone)]
pub enum Report {
    /// Progress of a job, 0 to 1, and its current stage.
    Progress(JobId, f32, String),
    /// Intermediate result of a job.
    Partial(JobId, Vec<u8>),
    /// Result of a job, or its error message.
    Done(JobId, Result<Vec<u8>, String>),
    /// Failure of the worker itself, as opposed to an error of the job, with a message.
    Broken(JobId, String),
}

impl Report {
    /// Number of bytes to decode.
    pub(super) fn num_bytes(&self) -> usize {
        match self {
            Self::Partial(_, bytes) | Self::Done(_, Ok(bytes)) => bytes.len(),
            Self::Progress(..) | Self::Done(_, Err(_)) | Self::Broken(..) => 0,
        }
    }
}

/// Input from the reader or the host.
#[derive(Debug, Clone)]
pub enum HostEvent {
    /// Names and files.
    Photographs(Vec<(String, Blob)>),
    /// A project.
    Project(Blob),
    /// Names and files of cameras: a single file, or those of a model.
    Cameras(Vec<(String, Blob)>),
    /// The parameters of an address: a step, a sample, settings.
    Link(Vec<(String, String)>),
    /// Video with this number, waiting for [`Host::ask_for_frames`].
    Video(u32),
    /// Number and name of a video, and frames of the requested part.
    Frames(u32, String, Vec<Blob>),
    /// Read error of the video with this number, with a message.
    NoFrames(u32, String),
    /// Message without data, such as an error or progress.
    Notice(String),
    /// State of the stored project.
    Stored(Stored),
    /// Precomputed results of the sample, as bytes of [`Computed`](crate::project::Computed); empty
    /// if they could not be loaded.
    Results(Blob),
}

/// State of the project stored by the host.
#[derive(Debug, Clone)]
pub enum Stored {
    /// The project stored by the last session, or requested by [`Host::ask_for_kept`].
    Project(Blob),
    /// A stored project that is not open, with a message.
    Closed(String),
    /// The project given to [`Host::keep`] was written: number of bytes.
    Written(usize),
    /// The project given to [`Host::keep`] was not written.
    Failed {
        /// Reason, as a message.
        why: String,
        /// Whether the previously stored project still exists.
        is_there: bool,
    },
    /// The stored project was erased by another page.
    Erased,
}

/// Host of the Lab.
pub trait Host {
    /// Number of jobs that can run at once.
    fn capacity(&self) -> usize;
    /// Starts a job on a worker with the code of this branch.
    fn start(&mut self, job: JobId, branch: Branch, request: Vec<u8>);
    /// Cancels a job that is no longer needed. It may finish nevertheless.
    fn cancel(&mut self, job: JobId);
    /// Reports since the last call.
    fn reports(&mut self) -> Vec<Report>;
    /// Events since the last call.
    fn host_events(&mut self) -> Vec<HostEvent>;
    /// Whether [`HostEvent::Results`] will come: no result of the sample needs to be computed
    /// before.
    fn brings_sample(&self) -> bool;
    /// Opens a dialog for photographs. False if there is none, so that files can only be dropped.
    fn ask_for_photographs(&mut self) -> bool;
    /// Opens a dialog for a project. False if there is none.
    fn ask_for_project(&mut self) -> bool;
    /// Opens a dialog for camera files. False if there is none.
    fn ask_for_camera_files(&mut self) -> bool;
    /// Opens the camera of the device. False if there is none.
    fn ask_for_camera(&mut self) -> bool;
    /// Splits an arrived video into `num_parts` parts of equal length, and reads some frames of one
    /// of them. Parts are requested in order, each after the previous one is processed, to limit
    /// the frames in memory.
    fn ask_for_frames(&mut self, video: u32, part: u32, num_parts: u32);
    /// Saves a file for the reader; returns the message to show.
    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String>;
    /// Whether the host can store a project itself.
    fn can_keep(&self) -> bool;
    /// Stores a project in place of the previous one. The outcome arrives as [`HostEvent::Stored`].
    fn keep(&mut self, project: Vec<u8>);
    /// Erases the stored project.
    fn forget(&mut self);
    /// Requests the stored project, which arrives as [`HostEvent::Stored`].
    fn ask_for_kept(&mut self);
    /// Announces a text to assistive technology.
    fn say(&mut self, words: &str);
    /// Shows the figure of the book that explains a step.
    fn explain(&mut self, explanation: Explanation);
    /// Whether a book with these figures is available.
    fn has_book(&self) -> bool;
    /// Sets the parameters of the address that restore the current view.
    fn address(&mut self, link: &str);
}
