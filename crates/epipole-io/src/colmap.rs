//! Parts of COLMAP's files that cameras and models share.

pub(crate) mod cameras;
mod models;
pub(crate) mod words;
