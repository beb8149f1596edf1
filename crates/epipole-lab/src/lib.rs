//! The Lab: from one's own photographs to a measured reconstruction, in the browser or in a window.
//!
//! Each module uses only those before it:
//!
//! * [`project`]: the open project as data.
//! * [`tasks`]: long computations, one file each, for a thread or for a worker of the browser.
//! * [`session`]: changes of the project, missing outputs, running jobs.
//! * `panels`: one per step, in egui.
//! * `app`: the screen around the panels. `native` in the binary, and `web`, run it.

#[cfg(feature = "panels")]
pub mod app;
#[cfg(feature = "panels")]
mod panels;
pub mod project;
pub mod session;
pub mod tasks;
#[cfg(all(
    target_arch = "wasm32",
    any(feature = "page", feature = "vision-worker", feature = "files-worker")
))]
pub mod web;
