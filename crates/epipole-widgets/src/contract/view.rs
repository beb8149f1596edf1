//! The view of a figure: drawing, no mathematics beyond layout.

use super::{Layout, Model};
use crate::canvas::Canvas;

/// Draws a model.
pub trait View: Default + 'static {
    /// What it draws.
    type Model: Model;

    /// Panels and height for a given width of the page, CSS pixels; narrow pages stack panels.
    fn layout(&self, model: &Self::Model, width: f64) -> Layout;

    /// Draws the present state. Handles are drawn by the view too; the focus ring is the page's.
    fn draw(&mut self, model: &Self::Model, layout: &Layout, canvas: &mut Canvas);

    /// Does a few milliseconds of work that makes the next drawing better, such as a slice of a
    /// sharper photograph; false when there is nothing left to do.
    fn refine(&mut self, _model: &Self::Model) -> bool {
        false
    }
}
