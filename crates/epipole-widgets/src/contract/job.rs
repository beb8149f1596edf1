//! Jobs: computations too long for a frame, as plain data in and plain data out.

use super::problem::Problem;
use std::ops::ControlFlow;

/// A computation that a model waits for.
///
/// The model states what it needs; who runs it is not its business. A page runs it in a Web Worker,
/// posters, tests and the command line at once: both give the same bytes.
pub trait Job {
    /// What the page says while it runs, such as "Looking for corners".
    fn label(&self) -> &'static str;

    /// A number that tells requests apart, so that an answer that comes too late is recognized.
    fn key(&self) -> u64;

    /// Everything that the computation depends on. Photographs among it make it large, so it is
    /// asked for once there is somebody to carry it out.
    fn request(&self) -> Vec<u8>;
}

/// What a model asks of whoever computes.
pub trait Asking {
    /// The computation that is outstanding; `None` if nothing is asked, or once its result is there.
    fn job(&self) -> Option<&dyn Job>;

    /// Takes the result of that computation, and says whether it is an answer. Why it is none is then kept as a
    /// sentence.
    fn take(&mut self, result: JobResult) -> bool;
}

/// Told the share that is done, 0 to 1; answers whether to go on.
pub type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// What a job gives: bytes that only its model understands.
pub type JobResult = Result<Vec<u8>, Problem>;

/// Carries out a job: a function of the request alone, so that it can run anywhere. Gives a sentence for the
/// reader where there is no result, also when `Progress` ended it.
pub type Compute = fn(&[u8], Progress<'_>) -> JobResult;

/// A place for a photograph of the reader's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct PhotoSlot {
    /// Permanent name.
    pub id: &'static str,
    /// What the reader reads, such as "Left photograph".
    pub label: &'static str,
    /// The largest width or height that is useful here; a page scales larger ones down and says so.
    pub max_side_px: u32,
}
