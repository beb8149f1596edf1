//! Painted surfaces. Each function returns a texture that depends only on its arguments.
//!
//! Colors are linear, so numbers are smaller than perceived brightness: 0.2 is middle gray.

mod books;
mod lettering;
pub(crate) mod noise;
mod prints;
mod props;
mod rooms;
pub(crate) mod texture;

pub(crate) use books::{book_cover, book_spine, linen, pages};
pub(crate) use prints::{block_print, geometric, landscape, star_chart};
pub(crate) use props::{apple, citrus, jug, mug, tin};
pub(crate) use rooms::{boards, floor, measured_boards, number, plaster, window};
