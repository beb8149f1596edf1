//! Tasks, and the project's queries that they answer.

use crate::project::{Key, Project, Step, to_bytes};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::ops::ControlFlow;

/// Progress of a running task.
#[derive(Debug)]
pub enum Progress<'a> {
    /// Fraction done, 0 to 1, and the current stage in a few words.
    Share(f32, &'a str),
    /// Intermediate output, as bytes.
    Partial(Vec<u8>),
}

/// Progress callback of a task; cancels it by [`ControlFlow::Break`].
pub type Monitor<'a> = &'a mut dyn FnMut(Progress<'_>) -> ControlFlow<()>;

/// Reports the fraction done.
///
/// # Errors
/// "stopped", if the callback cancels.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn report(monitor: Monitor<'_>, share: f32, stage: &str) -> Result<(), String> {
    match monitor(Progress::Share(share, stage)).is_break() {
        true => Err("stopped".to_owned()),
        false => Ok(()),
    }
}

/// Computation in a worker. The value holds all inputs of the output.
pub trait Task: Serialize + DeserializeOwned {
    /// Type of the output.
    type Output: Serialize + DeserializeOwned + 'static;

    /// Whether a decoded output is consistent.
    fn is_whole(_output: &Self::Output) -> bool {
        true
    }

    /// Encodes an output.
    fn write(output: &Self::Output) -> Vec<u8> {
        to_bytes(output)
    }

    /// Decodes an output.
    ///
    /// # Errors
    /// A message for invalid bytes.
    fn read(bytes: &[u8]) -> Result<Self::Output, String> {
        let output = postcard::from_bytes(bytes).ok().filter(Self::is_whole);
        output.ok_or_else(|| "the answer did not arrive whole".to_owned())
    }
}

/// Code of a task, compiled only into its worker.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) trait Run: Task {
    /// Computes the output.
    ///
    /// # Errors
    /// A message for the reader; "stopped" if the monitor cancels.
    fn run(self, monitor: Monitor<'_>) -> Result<Self::Output, String>;
}

/// Kind of file that outputs are written to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// The file of a project.
    Project,
    /// The sample of the Lab: without descriptors, which take 90 % of the size and are needed only
    /// for their display and for new matches.
    Sample,
}

/// Output of the task of a query.
pub type Output<Q> = <<Q as Query>::Task as Task>::Output;

/// Query about the project, answered by the cached output of a task.
pub trait Query: Copy + 'static {
    /// Task that answers it.
    type Task: Task;

    /// Step of the Lab that shows the output.
    const STEP: Step;

    /// Queries of this kind for the current document, in order.
    fn all(project: &Project) -> Vec<Self>;

    /// Hash of everything that the output depends on; `None` while that is unknown.
    fn key(self, project: &Project) -> Option<Key>;

    /// Whether the inputs of the task are available.
    ///
    /// * `is_imported`: whether the output comes from a file, so that only the inputs for its
    ///   validation are needed
    fn is_ready(self, project: &Project, is_imported: bool) -> bool;

    /// Priority, most urgent lowest.
    fn priority(self, project: &Project) -> u8;

    /// The task with its inputs.
    fn task(self, project: &Project) -> Option<Self::Task>;

    /// Description while it is running.
    fn label(self, project: &Project) -> String;

    /// Whether an output or an error message is available.
    fn is_settled(self, project: &Project) -> bool {
        project.get(self).is_some() || project.failure(self).is_some()
    }

    /// Returns the form of an output in a file; `None` if it is computed again.
    fn stored(_output: &Output<Self>, _destination: Destination) -> Option<Output<Self>> {
        None
    }

    /// Whether an output from an untrusted file is valid for this query.
    fn fits(self, _project: &Project, _output: &Output<Self>) -> bool {
        false
    }
}

impl Project {
    /// Returns the output of a query, if it is in the cache.
    pub fn get<Q: Query>(&self, query: Q) -> Option<&Output<Q>> {
        self.cache.get(query.key(self)?)
    }

    /// Returns the error message of a query's task, if it failed.
    pub fn failure<Q: Query>(&self, query: Q) -> Option<&str> {
        self.cache.failure(query.key(self)?)
    }
}
