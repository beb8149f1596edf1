//! Objects to furnish a scene with.

pub(crate) mod body;
pub(crate) mod props;
pub(crate) mod proxy;
