//! From a figure to pixels.

use super::Figure;
use crate::canvas::{BadSize, Canvas, Picture};
use crate::contract::{Aspect, Layout, Problem};
use crate::theme::Theme;

impl Figure {
    /// The shape of the picture where there is room.
    pub fn aspect(&self) -> Aspect {
        self.stage.aspect()
    }

    /// Panels and height for a width of the page, CSS pixels.
    pub fn layout(&self, width: f64) -> Layout {
        self.stage.layout(width)
    }

    /// Draws the present state, `width` CSS pixels wide with `scale` device pixels each.
    ///
    /// # Errors
    /// [`Problem::BadSize`] for a picture without pixels, or too large.
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

    /// Does a few milliseconds of what the first drawing would do all at once; false when there is
    /// nothing left to do. A page calls it before the first drawing, so that no other work waits long.
    pub fn prepare(&mut self) -> bool {
        self.stage.prepare()
    }

    /// Does a few milliseconds of work that makes the next drawing better; false when there is
    /// nothing left to do. A page calls it while the reader rests.
    pub fn refine(&mut self) -> bool {
        self.stage.refine()
    }

    /// Finishes the job and draws at full quality: what a poster and the tests show.
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

    /// Draws at full quality what is known now: the job that the figure may wait for is not done.
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
