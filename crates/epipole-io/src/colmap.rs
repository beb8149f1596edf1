//! Parts of COLMAP's files shared by cameras and models.

pub(crate) mod cameras;
mod models;
pub(crate) mod words;
