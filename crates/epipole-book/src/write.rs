//! Pages to a site: templates, frames, assets, compression.

pub mod assets;
pub mod compress;
pub(crate) mod frames;
pub mod stills;
pub mod template;
