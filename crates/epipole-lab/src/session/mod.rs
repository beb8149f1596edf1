//! Work beside the panels: running jobs, videos, the project that the browser stores, and the
//! environment that they need.

mod host;
mod jobs;
mod storage;
mod videos;

pub use host::{Arrival, Host, JobId, Report, Stored};
pub(crate) use jobs::{FileJob, Jobs};
pub(crate) use storage::Storage;
pub(crate) use videos::Videos;
