//! Things to furnish a scene with.

pub(crate) mod body;
pub(crate) mod proxy;
pub(crate) mod wares;
