//! Uploads of an image strip by strip: a whole photograph would delay the frame that first shows
//! it.

use egui::{Color32, ColorImage, Painter, Rect, TextureHandle, TextureOptions, Ui, Vec2, pos2};
use std::ops::Range;

/// Number of pixels of an image uploaded per frame.
const MAX_PIXELS: usize = 500_000;

/// An image, divided into horizontal strips.
#[derive(Clone)]
pub(crate) struct Strips {
    width: usize,
    height: usize,
    /// Placeholder for missing strips.
    under: Option<TextureHandle>,
    /// Uploaded strips, from the top.
    textures: Vec<TextureHandle>,
}

impl Strips {
    /// Creates an image without strips.
    ///
    /// * `under`: its thumbnail, shown until all strips are uploaded
    pub(crate) fn new([width, height]: [usize; 2], under: Option<TextureHandle>) -> Self {
        Self {
            width,
            height,
            under,
            textures: Vec::new(),
        }
    }

    /// Width and height, pixels.
    pub(crate) fn size(&self) -> Vec2 {
        Vec2::new(self.width as f32, self.height as f32)
    }

    /// Whether all strips are uploaded.
    pub(crate) fn is_whole(&self) -> bool {
        self.rows(self.textures.len()).is_empty()
    }

    /// Rows that a strip shows.
    fn rows(&self, strip: usize) -> Range<usize> {
        let most = (MAX_PIXELS / self.width.max(1)).max(1);
        (strip * most).min(self.height)..((strip + 1) * most).min(self.height)
    }

    /// Rows of a strip's texture: one more at each side, so that interpolation has no seams.
    fn rows_of_texture(&self, strip: usize) -> Range<usize> {
        let Range { start, end } = self.rows(strip);
        start.saturating_sub(1)..(end + 1).min(self.height)
    }

    /// Uploads the next missing strip; the others follow in the next frames.
    ///
    /// * `image`: the pixels of these rows
    pub(crate) fn bring(
        &mut self,
        ui: &Ui,
        name: &str,
        image: impl FnOnce(Range<usize>) -> ColorImage,
    ) {
        if self.is_whole() {
            return;
        }
        let image = image(self.rows_of_texture(self.textures.len()));
        let texture = ui.ctx().load_texture(name, image, TextureOptions::LINEAR);
        self.textures.push(texture);
        if !self.is_whole() {
            ui.ctx().request_repaint();
        }
    }

    /// Paints the uploaded strips.
    ///
    /// * `place`: rectangle of the whole image
    pub(crate) fn paint(&self, painter: &Painter, place: Rect) {
        if let Some(under) = self.under.as_ref().filter(|_| !self.is_whole()) {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(under.id(), place, whole, Color32::WHITE);
        }
        for (strip, texture) in self.textures.iter().enumerate() {
            let (rows, of_texture) = (self.rows(strip), self.rows_of_texture(strip));
            let at = |row: usize| place.top() + place.height() * row as f32 / self.height as f32;
            let part = Rect::from_min_max(
                pos2(place.left(), at(rows.start)),
                pos2(place.right(), at(rows.end)),
            );
            let share = |row: usize| (row - of_texture.start) as f32 / of_texture.len() as f32;
            let shares =
                Rect::from_min_max(pos2(0.0, share(rows.start)), pos2(1.0, share(rows.end)));
            painter.image(texture.id(), part, shares, Color32::WHITE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_show_every_row_once_and_know_the_rows_beside_them() {
        for size in [[2000, 1500], [480, 360], [3, 1], [2_000_000, 2], [0, 0]] {
            let picture = Strips::new(size, None);
            let mut shown = 0;
            let mut strip = 0;
            while !picture.rows(strip).is_empty() {
                let (rows, known) = (picture.rows(strip), picture.rows_of_texture(strip));
                assert_eq!(rows.start, shown, "{size:?}");
                assert!(rows.len() == 1 || rows.len() * size[0] <= MAX_PIXELS);
                assert_eq!(known.start, rows.start.saturating_sub(1));
                assert_eq!(known.end, (rows.end + 1).min(size[1]));
                (shown, strip) = (rows.end, strip + 1);
            }
            assert_eq!(shown, size[1]);
        }
    }
}
