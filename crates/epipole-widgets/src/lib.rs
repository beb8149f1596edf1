//! The interactive figures of Epipole.
//!
//! A figure is a **model** (state and mathematics, no drawing) and a **view** (drawing, no
//! mathematics beyond layout), both in `gallery/<name>/`, listed once in [`gallery`]. What a figure
//! promises is in [`contract`]; its users drive it through [`Figure`]. The crate knows no browser
//! and no clock: it turns events into state, and state into pixels.
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

#[cfg(feature = "figures")]
pub mod canvas;
pub mod cloud;
#[cfg(feature = "figures")]
pub mod contract;
#[cfg(feature = "figures")]
mod figure;
#[cfg(feature = "figures")]
mod font;
#[cfg(feature = "figures")]
pub mod gallery;
#[cfg(feature = "figures")]
mod kit;
#[cfg(feature = "figures")]
pub mod pointing;
#[cfg(feature = "figures")]
mod snapshot;
#[cfg(feature = "figures")]
mod stage;
pub mod theme;

#[cfg(feature = "figures")]
pub use figure::{Answers, ChallengeStatus, Figure, POSTER_WIDTH};
#[cfg(feature = "figures")]
pub use snapshot::Snapshot;

/// The font of the figures: a subset of IBM Plex Sans, as TrueType.
pub static FONT: &[u8] = include_bytes!("../assets/EpipoleFigureSans.ttf");
