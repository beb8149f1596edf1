//! The Lab: from one's own photographs to a measured reconstruction, in the browser or in a window.
//!
//! * [`project`]: the state as plain data. Events go in; what is to be computed comes out. No
//!   screen, no clock.
//! * [`tasks`]: what takes long, from bytes to bytes, for a thread or for a worker of the browser.
//! * `export`: zip files with COLMAP's text model, PLY and JSON, and projects that open again.
//! * `session`: running jobs, and the environment that they need.
//! * `panels`: one per step, in egui.
//! * `app`: the screen around the panels.
//! * `web`, and `native` in the binary: the two places where it runs.

#[cfg(feature = "panels")]
pub mod app;
#[cfg(feature = "files")]
mod export;
#[cfg(feature = "panels")]
mod panels;
pub mod project;
#[cfg(feature = "panels")]
pub mod session;
pub mod tasks;
#[cfg(all(
    target_arch = "wasm32",
    any(feature = "page", feature = "vision-worker", feature = "files-worker")
))]
pub mod web;
