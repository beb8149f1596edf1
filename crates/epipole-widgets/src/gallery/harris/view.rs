//! The picture with its corners, and the response as a map.

use super::answer::Answer;
use super::model::Harris;
use crate::canvas::{Canvas, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect, View};
use crate::theme::{Role, Theme, mix};
use image::RgbImage;

const GAP: f64 = 12.0;
const TITLE: f64 = 24.0;
const LEGEND: f64 = 34.0;
/// Below this width the panels stand below each other.
const STACKED_BELOW: f64 = 520.0;
/// Negative responses are striped, so that the sign can be seen without color.
const STRIPE_PX: u32 = 6;

/// Draws [`Harris`].
#[derive(Default)]
pub struct HarrisView {
    map: Option<(u64, Theme, RgbImage)>,
}

impl View for HarrisView {
    type Model = Harris;

    fn layout(&self, model: &Harris, width: f64) -> Layout {
        let (picture_width, picture_height) = model.size();
        let stacked = width < STACKED_BELOW;
        let panel_width = if stacked { width } else { (width - GAP) / 2.0 };
        let shape = f64::from(picture_height) / f64::from(picture_width);
        // A tall photograph must not push everything else off the screen.
        let panel_height = (panel_width * shape).min(480.0);
        let panel_width = panel_height / shape;
        let panel = |id, x, y| {
            let rect = Rect::new(x, y, panel_width, panel_height);
            Panel::photograph(id, rect, picture_width, picture_height)
        };
        let mut picture = panel("picture", 0.0, TITLE);
        picture.clickable = true;
        let (x, y) = match stacked {
            true => (0.0, 2.0 * TITLE + panel_height + GAP),
            false => ((width + GAP) / 2.0, TITLE),
        };
        let response = panel("response", x, y);
        let height = response.rect.bottom() + LEGEND;
        Layout {
            width,
            height,
            panels: vec![picture, response],
        }
    }

    fn draw(&mut self, model: &Harris, layout: &Layout, canvas: &mut Canvas) {
        let (picture, response) = (layout.panel("picture"), layout.panel("response"));
        let title = TextStyle::new(Role::Ink, 13.0);
        for (panel, text) in [(picture, "Picture"), (response, "Response R")] {
            canvas.text((panel.rect.x, panel.rect.y - 8.0), text, title);
            canvas.panel(panel.rect);
        }
        legend(canvas, response.rect);
        let Some(answer) = model.answer() else {
            let words = model.problem().unwrap_or("Looking for corners …");
            for panel in [picture, response] {
                let style = TextStyle::new(Role::Muted, 13.0).middle();
                canvas.label(panel.rect.center(), words, style);
            }
            return;
        };
        canvas.photograph(picture.rect, &answer.picture);
        canvas.photograph(
            response.rect,
            self.map(model.version(), canvas.theme(), answer),
        );
        for panel in [picture, response] {
            canvas.clipped(panel.rect, |canvas| corners(canvas, panel, model));
            let place = panel.canvas_from_world(model.probe_place());
            canvas.clipped(panel.rect, |canvas| {
                let half = (answer.window_px as f64 / 2.0) * panel.scale_x();
                let window = Rect::new(place.0 - half, place.1 - half, 2.0 * half, 2.0 * half);
                canvas.stroke_rect(window, Stroke::solid(Role::Grip, 1.5).cased());
            });
            canvas.clipped(panel.rect, |canvas| canvas.grip(place, Role::Grip));
        }
        if model.is_waiting() {
            let place = (response.rect.x + 8.0, response.rect.y + 18.0);
            canvas.text(
                place,
                "computing …",
                TextStyle::new(Role::Ink, 13.0).cased(),
            );
        }
    }
}

impl HarrisView {
    fn map(&mut self, version: u64, theme: Theme, answer: &Answer) -> &RgbImage {
        let fresh = self
            .map
            .take()
            .filter(|(v, t, _)| (*v, *t) == (version, theme));
        let (_, _, map) = self
            .map
            .insert(fresh.unwrap_or_else(|| (version, theme, colored(answer, theme))));
        map
    }
}

fn corners(canvas: &mut Canvas, panel: &Panel, model: &Harris) {
    let corners = model.corners();
    let radius = if corners.len() > 60 { 3.5 } else { 7.0 };
    for &(u, v) in corners {
        let place = panel.canvas_from_world((f64::from(u), f64::from(v)));
        canvas.circle(place, radius, Stroke::solid(Role::Inlier, 2.0).cased());
    }
}

/// Warm where R is positive, cool and striped where it is negative.
fn colored(answer: &Answer, theme: Theme) -> RgbImage {
    let [zero, warm, cool] =
        [Role::Surface, Role::Outlier, Role::Candidate].map(|role| theme.color(role));
    let strongest = answer.strongest();
    RgbImage::from_fn(answer.response.width(), answer.response.height(), |u, v| {
        let relative = answer.response.get_pixel(u, v).0[0] / strongest;
        // The fourth root shows weak responses beside strong ones.
        let strength = relative.abs().min(1.0).sqrt().sqrt();
        let stripe = relative < 0.0 && (u + v) % STRIPE_PX < STRIPE_PX / 2;
        let share = if stripe { strength * 0.45 } else { strength };
        image::Rgb(mix(zero, if relative < 0.0 { cool } else { warm }, share))
    })
}

fn legend(canvas: &mut Canvas, rect: Rect) {
    let y = rect.bottom() + 12.0;
    let style = TextStyle::new(Role::Ink, 12.0);
    let [zero, warm, cool] = [Role::Surface, Role::Outlier, Role::Candidate];
    let mut x = rect.x;
    for (role, opacity, label) in [
        (cool, 0.7, "R < 0: edge (striped)"),
        (zero, 1.0, "flat"),
        (warm, 0.9, "R > 0: corner"),
    ] {
        let swatch = Rect::new(x, y, 14.0, 14.0);
        canvas.fill_rect(swatch, role, opacity);
        canvas.stroke_rect(swatch, Stroke::solid(Role::Edge, 1.0));
        canvas.label((x + 19.0, y + 7.0), label, style);
        x += 32.0 + crate::canvas::text_width(label, 12.0);
    }
}
