//! The Lab in the browser: a page, and workers with a separate module.

#[cfg(feature = "page")]
mod mirror;
#[cfg(feature = "page")]
mod page;
#[cfg(feature = "page")]
mod shell;
#[cfg(any(feature = "vision-worker", feature = "files-worker"))]
pub mod worker;
