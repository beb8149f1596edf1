//! Editing of the model: the box that limits it, deleted points, selections.

mod changes;
mod crop;
mod export;
mod remaining;
mod select;

pub use remaining::{Members, Remaining};
pub use select::Layers;
