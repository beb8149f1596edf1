//! The photographs in a row, and below them the panorama.

use super::model::PanoramaFigure;
use super::question::MAX_PHOTOS;
use crate::canvas::Canvas;
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid};
use crate::kit::picture::Picture;
use crate::kit::scenes::PHOTO_ASPECT;
use image::RgbImage;

const PHOTOS: [&str; MAX_PHOTOS] = ["first", "second", "third"];

/// Draws [`PanoramaFigure`].
#[derive(Default)]
pub(crate) struct PanoramaView;

impl View for PanoramaView {
    type Model = PanoramaFigure;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &PanoramaFigure, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (tallest, height) = match grid::is_narrow(width) {
            true => (100.0, 180.0),
            false => (126.0, (0.39 * width).min(280.0)),
        };
        let photos = grid.row([PHOTO_ASPECT; MAX_PHOTOS], tallest);
        let [panorama] = grid.shares([1.0], height);
        let answer = model.shown();
        let size = answer.map(|answer| answer.panorama.size());
        let mut panels = vec![fitted("panorama", panorama, size)];
        for (index, rect) in photos.into_iter().enumerate() {
            let photograph = answer.and_then(|answer| answer.photographs.get(index));
            panels.push(fitted(PHOTOS[index], rect, photograph.map(Picture::size)));
        }
        grid.layout(panels)
    }

    fn photograph(&mut self, model: &PanoramaFigure, panel: &str) -> Option<RgbImage> {
        let answer = model.shown()?;
        let picture = match PHOTOS.iter().position(|&name| name == panel) {
            Some(index) => answer.photographs.get(index)?,
            None => &answer.panorama,
        };
        Some(picture.image().clone())
    }

    fn draw(&mut self, model: &PanoramaFigure, layout: &Layout, canvas: &mut Canvas) {
        let titles: [&[&str]; MAX_PHOTOS] = [
            &["Photograph 1", "1"],
            &["Photograph 2", "2"],
            &["Photograph 3", "3"],
        ];
        for (id, titles) in PHOTOS.into_iter().zip(titles) {
            grid::open(canvas, layout.panel(id), titles);
        }
        let panel = layout.panel("panorama");
        grid::open(canvas, panel, &["The panorama"]);
        let Some(answer) = model.shown() else {
            return grid::notice(canvas, panel.rect, model.asked.stand_in());
        };
        for (index, photograph) in answer.photographs.iter().enumerate() {
            let rect = layout.panel(PHOTOS[index]).rect;
            canvas.photograph(rect, photograph.image());
            if answer.turns_deg[index].is_none() {
                grid::notice(canvas, rect, "not joined");
            }
        }
        canvas.photograph(panel.rect, answer.panorama.image());
    }
}

/// Creates the panel of a picture, as large as fits, centered in a cell; the whole cell without a
/// picture.
fn fitted(id: &'static str, cell: Rect, size: Option<(u32, u32)>) -> Panel {
    let Some((columns, rows)) = size else {
        return Panel::photograph(id, cell, (1, 1));
    };
    let (width, height) = (f64::from(columns), f64::from(rows));
    let scale = (cell.width / width).min(cell.height / height);
    let (x, y) = cell.center();
    let (width, height) = (scale * width, scale * height);
    let rect = Rect::new(x - width / 2.0, y - height / 2.0, width, height);
    Panel::photograph(id, rect, (columns, rows))
}
