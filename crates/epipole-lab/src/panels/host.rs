//! What the Lab asks of the place where it runs: a window or a page.

use super::About;
use crate::tasks::{Blob, Branch};

/// The number of a piece of work.
pub type WorkId = u64;

/// What whoever computes tells.
#[derive(Debug, Clone)]
pub enum Report {
    /// How far a piece of work is, and what it does.
    Progress(WorkId, f32, String),
    /// What a piece of work has so far.
    SoFar(WorkId, Vec<u8>),
    /// A piece of work has come to its end.
    Done(WorkId, Result<Vec<u8>, String>),
    /// A piece of work has broken down, and a sentence why: not what it was asked for, but computing itself.
    Broken(WorkId, String),
}

impl Report {
    /// How many bytes there are to read.
    pub(super) fn num_bytes(&self) -> usize {
        match self {
            Self::SoFar(_, bytes) | Self::Done(_, Ok(bytes)) => bytes.len(),
            Self::Progress(..) | Self::Done(_, Err(_)) | Self::Broken(..) => 0,
        }
    }
}

/// What the reader brought.
#[derive(Debug, Clone)]
pub enum Arrival {
    /// Names and files.
    Photographs(Vec<(String, Blob)>),
    /// A project.
    Project(Blob),
    /// The parameters of an address: a step, a sample, knobs.
    Link(Vec<(String, String)>),
    /// A video of this number, which waits for [`Host::ask_for_frames`].
    Video(u32),
    /// Of a video of this number and name: some frames of the part that was asked for.
    Frames(u32, String, Vec<Blob>),
    /// A video of this number cannot be read any further, and a sentence why.
    NoFrames(u32, String),
    /// Nothing, and a sentence why; or how far it is.
    News(String),
    /// What is kept where the Lab runs.
    Kept(Kept),
    /// What was computed of the sample before, as bytes of [`Computed`](crate::project::Computed); nothing where that did
    /// not come.
    Solved(Blob),
}

/// What is told of a project that the reader chose to keep.
#[derive(Debug, Clone)]
pub enum Kept {
    /// This one was kept when the Lab ran last, or was asked for by [`Host::ask_for_kept`].
    Project(Blob),
    /// There is one, which is not open, and a sentence why.
    Aside(String),
    /// What was given to [`Host::keep`] is kept: so many bytes.
    Done(usize),
    /// What was given is not kept.
    Not {
        /// A sentence why.
        why: String,
        /// Whether something is still there that was kept before.
        is_there: bool,
    },
    /// Elsewhere, the reader has forgotten it.
    Forgotten,
}

/// What a panel asks for that only the place where it runs can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wish {
    /// Give the reader a file with the calibrated camera.
    SaveCamera,
    /// Give the reader a zip file with the reconstruction.
    Export,
    /// Give the reader the space as it is to be seen.
    SaveView,
    /// Take photographs with the camera of the machine.
    TakePhotographs,
}

/// A place where the Lab runs.
pub trait Host {
    /// How many pieces of work can be done at once.
    fn capacity(&self) -> usize;
    /// Starts a piece of work, which needs the code of one branch.
    fn start(&mut self, work: WorkId, branch: Branch, request: Vec<u8>);
    /// Ends a piece of work that nobody wants any more. It may be done all the same.
    fn cancel(&mut self, work: WorkId);
    /// What has been told since this was asked last.
    fn reports(&mut self) -> Vec<Report>;
    /// What the reader has brought since this was asked last.
    fn arrivals(&mut self) -> Vec<Arrival>;
    /// Whether [`Arrival::Solved`] comes: until then nothing of the sample needs to be computed.
    fn brings_sample(&self) -> bool;
    /// Asks the reader for photographs. False where there is no way but dropping them.
    fn ask_for_photographs(&mut self) -> bool;
    /// Asks the reader for a project. False likewise.
    fn ask_for_project(&mut self) -> bool;
    /// Lets the reader take photographs with the camera of the machine. False where there is no way.
    fn ask_for_camera(&mut self) -> bool;
    /// Cuts a video that has arrived into so many parts of equal length, and brings some frames of one of them. The parts
    /// are asked for in their order, each when the one before has been looked through: there are never many frames.
    fn ask_for_frames(&mut self, video: u32, part: u32, num_parts: u32);
    /// Gives the reader a file.
    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String>;
    /// Whether a project can be kept here without giving the reader a file.
    fn can_keep(&self) -> bool;
    /// Keeps a project in place of what was kept before. What came of it arrives as [`Arrival::Kept`].
    fn keep(&mut self, project: Vec<u8>);
    /// Erases what is kept.
    fn forget(&mut self);
    /// Brings what is kept, as [`Arrival::Kept`].
    fn ask_for_kept(&mut self);
    /// What is to be seen now, for whoever does not see it.
    fn say(&mut self, words: &str);
    /// Shows the figure of the book that explains a step.
    fn explain(&mut self, about: About);
    /// Whether there is a book to show it from.
    fn has_book(&self) -> bool;
    /// The parameters that bring back what is to be seen now, for an address.
    fn address(&mut self, link: &str);
}
