//! The scenes of the book.

mod long_table;
mod still_life;
mod studio;

pub use long_table::{MovableKind, MovableObject, long_table_camera};
pub use still_life::still_life_camera;
