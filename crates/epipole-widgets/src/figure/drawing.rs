//! Drawing of a figure.

use super::Figure;
use crate::canvas::{BadSize, Canvas, Picture};
use crate::contract::{Aspect, Layout, Problem};
use crate::theme::Theme;

impl Figure {
    /// Returns the aspect of the picture on wide pages.
    pub fn aspect(&self) -> Aspect {
        self.stage.aspect()
    }

    /// Returns panels and height for a page width in CSS pixels.
    pub fn layout(&self, width: f64) -> Layout {
        self.stage.layout(width)
    }

    /// Draws the current state, `width` CSS pixels wide, at `scale` device pixels per CSS pixel.
    ///
    /// # Errors
    /// [`Problem::BadSize`] for an empty or too large picture.
    pub fn draw(&mut self, width: f64, scale: f64, theme: Theme) -> Result<&Picture, Problem> {
        if !(1.0..=Canvas::MAX_SIDE).contains(&width) {
            return Err(BadSize { width, height: 0.0 }.into());
        }
        let layout = self.stage.layout(width);
        let buffer = std::mem::take(&mut self.picture);
        let mut canvas = Canvas::new(layout.width, layout.height, scale, theme, buffer)?;
        self.stage.draw(&layout, &mut canvas);
        self.picture = canvas.finish();
        Ok(&self.picture)
    }

    /// Does a few milliseconds of work ahead of the first drawing; false when done. A page calls it
    /// before the first drawing to keep its main thread responsive.
    pub fn prepare(&mut self) -> bool {
        self.stage.prepare()
    }

    /// Does a few milliseconds of work that improves the next drawing; false when done. A page
    /// calls it while the reader is idle.
    pub fn refine(&mut self) -> bool {
        self.stage.refine()
    }

    /// Finishes the pending job and draws at full quality, for posters and tests.
    ///
    /// # Errors
    /// As [`Figure::draw`].
    pub fn draw_settled(
        &mut self,
        width: f64,
        scale: f64,
        theme: Theme,
    ) -> Result<&Picture, Problem> {
        self.finish_job();
        self.draw_sharp(width, scale, theme)
    }

    /// Draws the current state at full quality without finishing the pending job.
    ///
    /// # Errors
    /// As [`Figure::draw`].
    pub fn draw_sharp(
        &mut self,
        width: f64,
        scale: f64,
        theme: Theme,
    ) -> Result<&Picture, Problem> {
        self.draw(width, scale, theme)?;
        while self.refine() {}
        self.draw(width, scale, theme)
    }
}
