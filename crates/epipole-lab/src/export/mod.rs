//! What leaves the Lab: zip files with a reconstruction, or with a project to go on with.

mod archive;
mod depth;
mod model;
mod summary;

pub(crate) use archive::{open, save};
pub(crate) use model::{Order, reconstruction};
