//! The scenes of the book.

mod cameras;
mod long_table;
mod still_life;
mod studio;

pub use cameras::{long_table_camera, still_life_camera};
pub use long_table::{MovableKind, MovableObject};
pub use still_life::{still_life_cloth, still_life_landscape};
