//! Zip file of a reconstruction: a model for another program, a page, PLY, JSON, photographs,
//! depth, measures and a report.

#[cfg(feature = "files")]
mod cloud;
mod contents;
#[cfg(feature = "files")]
mod depth;
#[cfg(feature = "files")]
mod frame;
mod measured;
#[cfg(feature = "files")]
mod model;
#[cfg(feature = "files")]
mod paper;
#[cfg(feature = "files")]
mod report;
#[cfg(feature = "files")]
mod summary;
#[cfg(feature = "files")]
mod table;
#[cfg(feature = "files")]
mod texture;
#[cfg(feature = "files")]
mod trajectory;
#[cfg(feature = "files")]
mod view;

pub use contents::{Export, ExportFormat, Recipe};
pub use measured::{Aligned, Mark, Measured, MeasuredControl, MeasuredShape, Measures};
