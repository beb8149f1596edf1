//! Jobs: computations too long for a frame, with plain data as input and output.

use super::problem::Problem;
use std::ops::ControlFlow;

/// A computation that a model waits for.
///
/// The caller decides where it runs: a page runs it in a Web Worker; posters, tests and the command
/// line run it immediately. The results are identical bit for bit.
pub trait Job {
    /// Status shown while the job runs, such as "Looking for corners".
    fn label(&self) -> &'static str;

    /// Key that identifies the request, so that a late result can be recognized.
    fn key(&self) -> u64;

    /// Serializes everything that the computation depends on. It can be large (photographs), so it
    /// is called only once a worker is free.
    fn request(&self) -> Vec<u8>;
}

/// The computations that a model requests.
pub trait Asking {
    /// Returns the pending job; `None` if nothing is requested, or once its result is there.
    fn job(&self) -> Option<&dyn Job>;

    /// Takes the result of that job. Returns whether it is valid; if not, keeps an error message.
    fn take(&mut self, result: JobResult) -> bool;
}

/// Callback with the fraction done, 0 to 1; its return value ends or continues the job.
pub type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// Result of a job, as bytes that only its model can decode.
pub type JobResult = Result<Vec<u8>, Problem>;

/// Runs a job: a function of the request alone, so that it can run anywhere. Returns a message for
/// the reader on failure, also when `Progress` ended the job.
pub type Compute = fn(&[u8], Progress<'_>) -> JobResult;

/// A slot for a photograph of the reader's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct PhotoSlot {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader, such as "Left photograph".
    pub label: &'static str,
    /// Largest useful width or height, pixels; a page downscales larger photographs and reports it.
    pub max_side_px: u32,
}
