//! The Lab in the browser: a page, and workers with a module of their own.

#[cfg(feature = "page")]
mod mirror;
#[cfg(feature = "page")]
mod page;
#[cfg(feature = "worker")]
pub mod worker;
