//! The interactive figures of Epipole.
//!
//! A figure consists of a **model** (state and mathematics, without drawing) and a **view**
//! (drawing, without mathematics beyond layout), both in `gallery/<name>/` and listed once in
//! [`gallery`]. [`contract`] defines the interface of a figure; users access it through [`Figure`].
//! The crate depends on neither browser nor clock: it turns events into state, and state into
//! pixels.
//!
//! ```
//! # fn main() -> Result<(), epipole_widgets::contract::Problem> {
//! use epipole_widgets::{Figure, contract::{Event, Value}, theme::Theme};
//! let mut figure = Figure::new("ransac-race")?;
//! figure.update(&Event::Set { id: "outliers".into(), value: Value::Number(0.2) })?;
//! assert_eq!(figure.query(), "outliers=0.20");
//! let picture = figure.draw(760.0, 1.0, Theme::Light)?;
//! assert_eq!(picture.width(), 760);
//! # Ok(()) }
//! ```

pub mod contract;
mod figure;
pub mod gallery;
mod kit;
pub mod pointing;
mod snapshot;
mod stage;
#[cfg(test)]
mod typescript;

pub use epipole_canvas::{canvas, theme};
pub use figure::{Answers, Figure, POSTER_WIDTH};
pub use snapshot::Snapshot;
