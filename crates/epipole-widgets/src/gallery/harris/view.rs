//! The picture with its corners, and the response as a map.

use super::model::Harris;
use super::question::Answer;
use crate::canvas::{Canvas, Stroke};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid};
use crate::kit::heat::{self, Fill, Heat, Signed};
use crate::theme::{Role, Theme};
use image::RgbImage;

/// Maximum height of a photograph, CSS pixels, to leave room for the rest.
const TALLEST: f64 = 404.0;
const LEGEND: f64 = 30.0;

/// Draws [`Harris`].
#[derive(Default)]
pub struct HarrisView {
    map: Heat,
}

impl View for HarrisView {
    type Model = Harris;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &Harris, width: f64) -> Layout {
        let (columns, rows) = model.size();
        let mut grid = Grid::new(width);
        let [left, right] = grid.row([f64::from(rows) / f64::from(columns); 2], TALLEST);
        grid.strip(LEGEND);
        let picture = Panel::photograph("picture", left, (columns, rows)).clickable();
        let response = Panel::photograph("response", right, (columns, rows));
        grid.layout(vec![picture, response])
    }

    fn draw(&mut self, model: &Harris, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 2] = [("picture", &["Image"]), ("response", &["Response R"])];
        let [picture, response] = grid::open_all(canvas, layout, titles);
        draw_legend(canvas, layout.width, response.rect);
        let asked = &model.asked;
        let Some((question, answer)) = asked.answered() else {
            return grid::notice(canvas, picture.rect, asked.stand_in());
        };
        canvas.photograph(picture.rect, answer.picture.image());
        let theme = canvas.theme();
        let color = || [colored(answer, theme)];
        let [map] = self.map.maps(asked.version(), theme, color);
        canvas.photograph(response.rect, map);
        for panel in [picture, response] {
            canvas.clipped(panel.rect, |canvas| {
                draw_corners(canvas, panel, model);
                let place = panel.canvas_from_world(model.probe.place());
                let half = question.window_px as f64 / 2.0 * panel.scale_x();
                let window = Rect::around(place, half);
                canvas.stroke_rect(window, Stroke::solid(Role::Grip, 1.5).cased());
                canvas.grip(place, Role::Grip);
            });
        }
        if let Some(problem) = asked.problem() {
            grid::notice(canvas, response.rect, problem);
        }
    }
}

fn draw_corners(canvas: &mut Canvas, panel: &Panel, model: &Harris) {
    let corners = model.corners();
    let (is_crowded, is_small) = (corners.len() > 60, panel.rect.width < 300.0);
    // On a phone, large circles around many corners would hide the corners.
    let (radius, width) = match (is_crowded, is_small) {
        (true, true) => (1.75, 1.25),
        (false, false) => (7.0, 2.0),
        _ => (3.5, 2.0),
    };
    for &(u, v) in corners {
        let place = panel.canvas_from_world((f64::from(u), f64::from(v)));
        canvas.circle(place, radius, Stroke::solid(Role::Inlier, width).cased());
    }
}

/// Returns the response in colors: warm where R > 0, cool and striped where R < 0.
fn colored(answer: &Answer, theme: Theme) -> RgbImage {
    let (colors, strongest) = (Signed::of(theme), answer.strongest());
    RgbImage::from_fn(answer.response.width(), answer.response.height(), |u, v| {
        let relative = answer.response.get_pixel(u, v).0[0] / strongest;
        // The fourth root makes weak responses visible beside strong ones.
        let strength = relative.abs().min(1.0).sqrt().sqrt();
        image::Rgb(colors.at((u, v), relative < 0.0, strength, 0.45))
    })
}

/// Draws the legend below the map, or below both panels on a phone.
fn draw_legend(canvas: &mut Canvas, width: f64, map: Rect) {
    let narrow = grid::is_narrow(width);
    let y = map.bottom() + LEGEND / 2.0 + 2.0;
    let x = if narrow { 0.0 } else { map.x };
    let entries = [
        (Fill::Role(Role::Candidate, 0.7), "R < 0: edge (striped)"),
        (Fill::Role(Role::Surface, 1.0), "flat"),
        (Fill::Role(Role::Outlier, 0.9), "R > 0: corner"),
    ];
    heat::swatches(canvas, (x, y), 18.0, &entries);
}
