//! Pages to a site: assets, templates, frames, compression.

pub(crate) mod address;
pub mod assets;
pub mod compress;
pub(crate) mod disk;
pub(crate) mod frames;
pub(crate) mod gathered;
pub(crate) mod manifest;
pub mod manual;
pub mod policy;
pub mod stills;
pub(crate) mod template;
