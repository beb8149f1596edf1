//! Light: a window, the ambient light of the room, and maps of both on every surface.
//!
//! Light sources never move, so shadows and contact shade are computed once, for the first
//! photograph, and pixels only look them up.

mod baking;
mod lighting;
mod maps;
mod shade;

pub(crate) use baking::{Baking, Shading};
pub(crate) use lighting::{Lighting, single};
pub(crate) use maps::{Decal, LightMap};
