//! Painted surfaces. Each function returns a texture that depends only on its arguments.
//!
//! Colors are linear, so numbers are smaller than they look: 0.2 is middle gray.

mod books;
mod lettering;
pub(crate) mod noise;
mod prints;
mod rooms;
pub(crate) mod texture;
mod wares;

pub(crate) use books::{book_cover, book_spine, linen, pages};
pub(crate) use prints::{block_print, geometric, landscape, star_chart};
pub(crate) use rooms::{boards, floor, measured_boards, number, plaster, window};
pub(crate) use wares::{apple, citrus, jug, mug, tin};
