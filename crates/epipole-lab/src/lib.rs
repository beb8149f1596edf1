//! The Lab: from photographs to a measured reconstruction, in the browser or in a window.
//!
//! Each module uses only those before it:
//!
//! ```text
//! project    →    tasks          →    session         →    panels        →    app
//! Project:        Task: input,        update(Event)        Panel: a file      bar, steps,
//! document,       output, code        pending()            per step with      events, files
//! view, cache     Query: key,         done(output)         its view state
//!                 inputs              Jobs, Host                              native, web
//! ```
//!
//! 1. A [`Project`](project::Project) holds the document, the view, and the outputs of tasks.
//!    Panels draw from it and return actions; only [`update`](project::Project::update) changes
//!    the document.
//! 2. A [`Query`](tasks::Query), such as `FeaturesOf(photo)`, names an output. Its key is a hash of
//!    everything that the output depends on, so nothing needs to be invalidated: a change gives
//!    another key, and undo gives the former key. `project.get(query)` reads the cache.
//! 3. [`pending`](project::Project::pending) lists the queries without an output whose inputs are
//!    available. Jobs send the [`Task`](tasks::Task) of each as bytes to a thread or a worker,
//!    which runs it by `compute`; [`done`](project::Project::done) puts the output into the cache,
//!    which makes further queries pending.
//!
//! A new computation is a file in `tasks/` and a line in `tasks/list.rs`; a new panel is a file in
//! `panels/`, a line in `panels/mod.rs`, and a variant of [`Step`](project::Step).

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
