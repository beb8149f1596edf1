//! Point clouds.

mod ply;

pub use ply::{read_ply, write_ply};
