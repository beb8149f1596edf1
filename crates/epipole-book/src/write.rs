//! Writing of the site: assets, templates, frames, compression.

pub(crate) mod address;
pub mod assets;
pub(crate) mod cards;
pub mod compress;
pub(crate) mod disk;
pub(crate) mod frames;
pub(crate) mod manifest;
pub mod manual;
pub(crate) mod page_files;
pub mod policy;
mod published;
pub mod stills;
pub(crate) mod template;
