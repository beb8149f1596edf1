//! The view of a figure: drawing, without mathematics beyond layout.

use super::{Declared, Layout};
use crate::canvas::Canvas;
use image::RgbImage;
use serde::Serialize;

/// Aspect of a figure's picture on wide pages, from which a page arranges everything else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Aspect {
    /// Broad, such as two photographs side by side: it takes the whole width, with the controls in
    /// one low band below. At most 470 CSS pixels tall at the largest of [`WIDTHS`](super::WIDTHS).
    Broad,
    /// Tall, with the controls beside it. At most 560 CSS pixels tall at the middle one of
    /// [`WIDTHS`](super::WIDTHS).
    Tall,
}

/// Draws a model.
pub trait View: Default + 'static {
    /// Model of the figure.
    type Model: Declared;

    /// Aspect of the picture.
    const ASPECT: Aspect = Aspect::Tall;

    /// Returns panels and height for a page width in CSS pixels; narrow pages stack panels.
    fn layout(&self, model: &Self::Model, width: f64) -> Layout;

    /// Draws the current state with its handles; the focus ring is the page's.
    fn draw(&mut self, model: &Self::Model, layout: &Layout, canvas: &mut Canvas);

    /// Returns the photograph that a panel shows, for readers' code; `None` in other panels.
    fn photograph(&mut self, _model: &Self::Model, _panel: &str) -> Option<RgbImage> {
        None
    }

    /// Does a few milliseconds of work ahead of the first drawing, such as painting the textures of
    /// a scene; false when done. The pictures are the same without it.
    fn prepare(&mut self, _model: &Self::Model) -> bool {
        false
    }

    /// Does a few milliseconds of work that improves the next drawing, such as a slice of a sharper
    /// photograph; false when done.
    fn refine(&mut self, _model: &Self::Model) -> bool {
        false
    }
}
