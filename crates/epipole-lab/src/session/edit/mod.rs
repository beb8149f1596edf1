//! Editing of the model: the box that limits it, deleted points, selections.

mod changes;
mod crop;
mod export;
mod kept;
mod select;

pub use kept::{Kept, Members};
pub use select::Layers;
