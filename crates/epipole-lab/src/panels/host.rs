//! What the Lab asks of the place where it runs: a window or a page.

use crate::tasks::Blob;

/// The number of a piece of work.
pub type WorkId = u64;

/// What whoever computes tells.
#[derive(Debug, Clone)]
pub enum Report {
    /// How far a piece of work is, and what it does.
    Progress(WorkId, f32, String),
    /// A piece of work has come to its end.
    Done(WorkId, Result<Vec<u8>, String>),
}

/// What the reader brought.
#[derive(Debug, Clone)]
pub enum Arrival {
    /// Names and files.
    Photographs(Vec<(String, Blob)>),
    /// A project.
    Project(Blob),
}

/// A place where the Lab runs.
pub trait Host {
    /// How many pieces of work can be done at once.
    fn capacity(&self) -> usize;
    /// Starts a piece of work.
    fn start(&mut self, work: WorkId, request: Vec<u8>);
    /// Ends a piece of work that nobody wants any more. It may be done all the same.
    fn cancel(&mut self, work: WorkId);
    /// What has been told since this was asked last.
    fn reports(&mut self) -> Vec<Report>;
    /// What the reader has brought since this was asked last.
    fn arrivals(&mut self) -> Vec<Arrival>;
    /// Asks the reader for photographs. False where there is no way but dropping them.
    fn ask_for_photographs(&mut self) -> bool;
    /// Asks the reader for a project. False likewise.
    fn ask_for_project(&mut self) -> bool;
    /// Gives the reader a file.
    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String>;
    /// What is to be seen now, for whoever does not see it.
    fn say(&mut self, words: &str);
}
