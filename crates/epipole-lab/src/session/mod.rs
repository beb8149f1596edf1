//! The session: changes of the project, missing outputs, running jobs, and the host.
//!
//! A project changes only by [`Project::update`] and [`Project::done`]. [`Project::pending`] lists
//! the outputs to compute, and [`Pending::request`] returns the task of each for a worker.
//!
//! [`Project::update`]: crate::project::Project::update
//! [`Project::done`]: crate::project::Project::done
//! [`Project::pending`]: crate::project::Project::pending

mod boards;
mod edit;
mod event;
mod figures;
#[cfg(feature = "panels")]
mod host;
mod import;
#[cfg(feature = "panels")]
mod jobs;
mod link;
mod pixels;
mod queue;
mod report;
mod saving;
#[cfg(feature = "panels")]
mod storage;
mod update;
#[cfg(feature = "panels")]
mod videos;

pub use edit::{Layers, Members, Remaining};
pub use event::Event;
#[cfg(feature = "panels")]
pub use host::{Host, HostEvent, JobId, Report, Stored};
#[cfg(feature = "panels")]
pub(crate) use jobs::{FileJob, Jobs};
pub use queue::Pending;
#[cfg(feature = "panels")]
pub(crate) use report::count;
pub use report::{
    Alignment, BoardOutcome, Disagreement, Floor, Length, Scale, ScaleBar, ScaleSource, StepState,
    Suggestion, Verdict,
};
#[cfg(feature = "panels")]
pub(crate) use storage::Storage;
#[cfg(feature = "panels")]
pub(crate) use videos::Videos;
