//! Light: a window, the glow of the room, and maps of both on every surface.
//!
//! Nothing in a scene moves its light, so shadows and the shade near contacts are computed once,
//! for the first photograph, and a pixel only looks them up.

mod baking;
mod lighting;
mod maps;
mod shade;

pub(crate) use baking::{Baking, Shading};
pub(crate) use lighting::{Lighting, single};
pub(crate) use maps::{Decal, LightMap};
