//! The view of a figure: drawing, no mathematics beyond layout.

use super::{Declared, Layout};
use crate::canvas::Canvas;
use serde::Serialize;

/// The aspect of a figure's picture where there is room, which decides where a page puts the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Aspect {
    /// Broad, such as two photographs side by side: it takes the whole width, and what the reader
    /// moves stands below it in one low band. At most 470 CSS pixels tall at the largest of
    /// [`WIDTHS`](super::WIDTHS).
    Broad,
    /// Tall: what the reader moves stands beside it. At most 560 CSS pixels tall at the middle one of
    /// [`WIDTHS`](super::WIDTHS).
    Tall,
}

/// Draws a model.
pub trait View: Default + 'static {
    /// What it draws.
    type Model: Declared;

    /// The shape of its picture.
    const ASPECT: Aspect = Aspect::Tall;

    /// Panels and height for a given width of the page, CSS pixels; narrow pages stack panels.
    fn layout(&self, model: &Self::Model, width: f64) -> Layout;

    /// Draws the present state. Handles are drawn by the view too; the focus ring is the page's.
    fn draw(&mut self, model: &Self::Model, layout: &Layout, canvas: &mut Canvas);

    /// Does a few milliseconds of what the first drawing would do all at once, such as painting the
    /// textures of a scene; false when there is nothing left to do. The pictures are the same with and
    /// without.
    fn prepare(&mut self, _model: &Self::Model) -> bool {
        false
    }

    /// Does a few milliseconds of work that makes the next drawing better, such as a slice of a
    /// sharper photograph; false when there is nothing left to do.
    fn refine(&mut self, _model: &Self::Model) -> bool {
        false
    }
}
