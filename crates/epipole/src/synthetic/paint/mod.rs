//! Painted surfaces. Each function returns a texture that depends on nothing but its arguments.
//!
//! Colors are linear, so they look darker as numbers than on the screen: 0.2 is middle gray.

pub(super) mod lettering;
mod prints;
mod rooms;
mod wares;

pub(super) use prints::{block_print, geometric, landscape, star_chart};
pub(super) use rooms::{boards, floor, measured_boards, number, plaster, window};
pub(super) use wares::{apple, book_cover, book_spine, citrus, jug, linen, mug, pages, tin};

/// A color with full or partial gloss.
fn with_gloss(color: [f32; 3], gloss: f32) -> [f32; 4] {
    [color[0], color[1], color[2], gloss]
}
