//! A photograph in a rectangle that can be zoomed and panned, with marks on it.

use super::look;
use super::strips::Strips;
use crate::project::Key as Name;
use crate::tasks::Photograph;
use egui::{
    Color32, ColorImage, Key, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, TextureHandle,
    TextureOptions, Ui, Vec2, vec2,
};
use epipole_canvas::theme::{Role, Theme};
use std::collections::BTreeMap;

/// Textures of images.
#[derive(Default)]
pub(crate) struct Pictures {
    full: BTreeMap<Name, Strips>,
    small: BTreeMap<Name, TextureHandle>,
}

/// Maximum number of full images kept as textures; at most two are visible.
const MAX_FULL: usize = 6;
/// The same for thumbnails.
const MAX_SMALL: usize = 200;

impl Pictures {
    /// Returns the photograph, as far as it is uploaded.
    pub(crate) fn full(&mut self, ui: &Ui, key: Name, photograph: &Photograph) -> Strips {
        let size = [photograph.width as usize, photograph.height as usize];
        if !self.full.contains_key(&key) {
            if self.full.len() >= MAX_FULL {
                self.full.clear();
            }
            let has_small = !photograph.small.rgb.is_empty();
            let small = has_small.then(|| self.small(ui, key, photograph).clone());
            self.full.insert(key, Strips::new(size, small));
        }
        let mut picture = self.full[&key].clone();
        if photograph.has_pixels() {
            picture.bring(ui, &key.to_string(), |rows| {
                let of_rows = 3 * size[0] * rows.start..3 * size[0] * rows.end;
                ColorImage::from_rgb([size[0], rows.len()], &photograph.rgb[of_rows])
            });
            self.full.insert(key, picture.clone());
        }
        picture
    }

    /// Returns its thumbnail.
    pub(crate) fn small(&mut self, ui: &Ui, key: Name, photograph: &Photograph) -> &TextureHandle {
        if !self.small.contains_key(&key) && self.small.len() >= MAX_SMALL {
            self.small.clear();
        }
        self.small.entry(key).or_insert_with(|| {
            let small = &photograph.small;
            let size = [small.width as usize, small.height as usize];
            let image = ColorImage::from_rgb(size, &small.rgb);
            let name = format!("small {key}");
            ui.ctx().load_texture(name, image, TextureOptions::LINEAR)
        })
    }
}

/// Viewing state of a photograph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lens {
    zoom: f32,
    /// Point of the photograph in the middle of the view, relative to its size.
    middle: Vec2,
    /// Crosshair, relative to the size.
    cross: Vec2,
}

impl Default for Lens {
    fn default() -> Self {
        Self {
            zoom: 1.0,
            middle: vec2(0.5, 0.5),
            cross: vec2(0.5, 0.5),
        }
    }
}

/// A photograph on the screen.
pub(crate) struct Shown {
    pub(crate) response: Response,
    painter: Painter,
    /// Rectangle of the whole photograph on the screen.
    place: Rect,
    size: Vec2,
    /// Point clicked by a key with the crosshair, relative to the size.
    keyed: Option<Vec2>,
}

impl Shown {
    /// Converts a pixel to a position on the screen.
    pub(crate) fn at(&self, u: f64, v: f64) -> Pos2 {
        let share = vec2(
            (u as f32 + 0.5) / self.size.x,
            (v as f32 + 0.5) / self.size.y,
        );
        self.place.min + share * self.place.size()
    }

    /// Returns the pixel clicked by pointer or key.
    pub(crate) fn clicked(&self) -> Option<[f64; 2]> {
        if !self.response.clicked() {
            return None;
        }
        let share = match self.keyed {
            Some(share) => share,
            None => (self.response.interact_pointer_pos()? - self.place.min) / self.place.size(),
        };
        let inside = (0.0..1.0).contains(&share.x) && (0.0..1.0).contains(&share.y);
        inside.then(|| {
            [
                f64::from(share.x * self.size.x) - 0.5,
                f64::from(share.y * self.size.y) - 0.5,
            ]
        })
    }

    /// Screen points per pixel.
    pub(crate) fn scale(&self) -> f32 {
        self.place.width() / self.size.x
    }

    /// Draws a circle with an outline that is visible on any background.
    pub(crate) fn ring(&self, center: Pos2, radius: f32, color: Color32) {
        self.painter.circle_stroke(
            center,
            radius,
            Stroke::new(3.0, Color32::from_black_alpha(140)),
        );
        self.painter
            .circle_stroke(center, radius, Stroke::new(1.5, color));
    }

    /// Draws a line in the same way.
    pub(crate) fn line(&self, from: Pos2, to: Pos2, color: Color32) {
        let casing = Stroke::new(3.5, Color32::from_black_alpha(120));
        self.painter.line_segment([from, to], casing);
        self.painter
            .line_segment([from, to], Stroke::new(1.6, color));
    }

    /// Draws many marks at once.
    pub(crate) fn add(&self, shapes: Vec<Shape>) {
        self.painter.extend(shapes);
    }

    /// Whether a position on the screen is within the rectangle.
    pub(crate) fn shows(&self, at: Pos2) -> bool {
        self.response.rect.expand(20.0).contains(at)
    }
}

/// Shows a photograph in a rectangle, with an accessible name.
pub(crate) fn show(
    ui: &mut Ui,
    rect: Rect,
    picture: &Strips,
    lens: &mut Lens,
    name: &str,
) -> Shown {
    let id = ui.make_persistent_id(("photograph", name, rect.min.x as i32, rect.min.y as i32));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let size = picture.size();
    let keyed = crosshair(ui, &response, lens, size);
    let label = match response.has_focus() {
        true => {
            let at = lens.cross * size;
            format!(
                "Photograph {name}, crosshair at ({:.0}, {:.0}). Arrow keys move it, with Shift pixel by pixel; Enter clicks.",
                at.x, at.y
            )
        }
        false => format!("Photograph {name}"),
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
    let fit = (rect.width() / size.x)
        .min(rect.height() / size.y)
        .max(1e-3);
    if response.hovered() {
        let scrolled = ui.input(|input| input.smooth_scroll_delta().y);
        let pinched = ui.input(egui::InputState::zoom_delta);
        let factor = pinched * libm::expf(scrolled * 0.004);
        if factor != 1.0
            && let Some(pointer) = response.hover_pos()
        {
            let before = fit * lens.zoom;
            lens.zoom = (lens.zoom * factor).clamp(1.0, 16.0);
            // Keeps the point under the pointer fixed.
            let from_middle = (pointer - rect.center()) / size;
            lens.middle += from_middle * (1.0 / before - 1.0 / (fit * lens.zoom));
        }
    }
    if response.has_focus() {
        let presses = |key| ui.input(|input| input.num_presses(key) as f32);
        let nearer = presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus);
        if nearer != 0.0 {
            lens.zoom = (lens.zoom * libm::expf(0.3 * nearer)).clamp(1.0, 16.0);
            lens.middle = lens.cross;
        }
        // The crosshair stays visible.
        let half = 0.45 * rect.size() / (size * fit * lens.zoom);
        lens.middle = lens.middle.clamp(lens.cross - half, lens.cross + half);
    }
    lens.middle -= response.drag_delta() / (size * fit * lens.zoom);
    if response.double_clicked() {
        *lens = Lens::default();
    }
    let shown = size * fit * lens.zoom;
    for axis in 0..2 {
        // The photograph stays visible.
        let half = (0.5 * rect.size()[axis] / shown[axis]).min(0.5);
        lens.middle[axis] = lens.middle[axis].clamp(half, 1.0 - half);
    }
    let place = Rect::from_min_size(rect.center() - lens.middle * shown, shown);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0.0, look::color(ui, Role::Surface));
    picture.paint(&painter, place);
    if response.clicked()
        && keyed.is_none()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let share = (pointer - place.min) / place.size();
        lens.cross = share.clamp(Vec2::ZERO, Vec2::splat(1.0));
        response.request_focus();
    }
    let shown = Shown {
        response,
        painter,
        place,
        size,
        keyed,
    };
    if shown.response.has_focus() {
        let stroke = Stroke::new(2.0, look::color(ui, Role::Best));
        let inner = rect.shrink(1.0);
        (shown.painter).rect_stroke(inner, 0.0, stroke, egui::StrokeKind::Inside);
        let at = place.min + lens.cross * place.size();
        let grip = look::of(Theme::Dark, Role::Grip);
        for arm in [
            vec2(1.0, 0.0),
            vec2(-1.0, 0.0),
            vec2(0.0, 1.0),
            vec2(0.0, -1.0),
        ] {
            shown.line(at + 4.0 * arm, at + 13.0 * arm, grip);
        }
    }
    shown
}

/// Moves the crosshair by the arrow keys while the photograph has the focus. Returns its position
/// when a key clicks.
fn crosshair(ui: &Ui, response: &Response, lens: &mut Lens, size: Vec2) -> Option<Vec2> {
    if !response.has_focus() {
        return None;
    }
    let presses = |key| ui.input(|input| input.num_presses(key) as f32);
    let right = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
    let down = presses(Key::ArrowDown) - presses(Key::ArrowUp);
    let step = match ui.input(|input| input.modifiers.shift) {
        true => Vec2::splat(1.0) / size,
        false => Vec2::splat(0.02 / lens.zoom),
    };
    lens.cross = (lens.cross + vec2(right, down) * step).clamp(Vec2::ZERO, Vec2::splat(0.999_9));
    // While the photograph has the focus, the arrow keys must not move the focus.
    let filter = egui::EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..egui::EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    (presses(Key::Enter) + presses(Key::Space) > 0.0).then_some(lens.cross)
}
