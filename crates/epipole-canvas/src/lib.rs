//! Software renderer of Epipole's figures.
//!
//! [`canvas`] draws all marks of figures, [`theme`] defines their colors, [`cloud`] draws points
//! and cameras in 3D. The crate does not depend on the figures. Equal calls give identical bits on
//! every machine.
//!
//! ```
//! # fn main() -> Result<(), epipole_canvas::canvas::BadSize> {
//! use epipole_canvas::canvas::{Canvas, Picture, Stroke};
//! use epipole_canvas::theme::{Role, Theme};
//! let mut canvas = Canvas::new(80.0, 60.0, 2.0, Theme::Light, Picture::default())?;
//! canvas.line((10.0, 10.0), (70.0, 50.0), Stroke::solid(Role::Ink, 2.0));
//! let picture = canvas.finish();
//! assert_eq!((picture.width(), picture.height()), (160, 120));
//! # Ok(()) }
//! ```

#[cfg(feature = "canvas")]
pub mod canvas;
pub mod cloud;
#[cfg(feature = "canvas")]
mod font;
#[cfg(feature = "canvas")]
mod rect;
pub mod theme;

#[cfg(feature = "canvas")]
pub use rect::Rect;

/// The font of the figures: a subset of IBM Plex Sans, as TrueType.
pub static FONT: &[u8] = include_bytes!("../assets/EpipoleFigureSans.ttf");
