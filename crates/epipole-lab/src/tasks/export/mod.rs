//! Zip file of a reconstruction: a model for another program, a page, PLY, JSON, photographs and
//! depth.

#[cfg(feature = "files")]
mod cloud;
mod contents;
#[cfg(feature = "files")]
mod depth;
#[cfg(feature = "files")]
mod frame;
#[cfg(feature = "files")]
mod model;
#[cfg(feature = "files")]
mod summary;
#[cfg(feature = "files")]
mod texture;
#[cfg(feature = "files")]
mod trajectory;

pub use contents::{Export, ExportFormat, Measured, Recipe};
