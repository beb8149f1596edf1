//! Both photographs with a magnified match, depth over disparity below them, and a top view beside
//! them.

mod from_above;
mod magnifier;
mod style;

use self::magnifier::Magnifier;
use self::style::UNCERTAIN;
use super::model::{DEPTH_RANGE_M, StereoSlider};
use super::rig::{ERROR_PX, Measured, Sight};
use super::words::NO_BASELINE;
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, TEXT, TITLE, fitting};
use crate::kit::guess::Reveal;
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::kit::photo::{Photo, Slice};
use crate::kit::plan::draw_span;
use crate::kit::plot::{self, Ruler};
use crate::kit::scenes::{self, PHOTO_ASPECT, PHOTO_SIZE};
use crate::theme::Role;

const MARKER: f64 = 4.5;
/// Titles of the hidden right photograph.
const HIDDEN: [&str; 2] = ["Right: mark where it shows the ball", "Right: your guess"];
/// Height of the top view on a phone, CSS pixels.
const LOW: f64 = 186.0;
/// Ends of the axes of disparity and depth.
const MOST_PX: f64 = 120.0;
const MOST_M: f64 = 11.0;

/// Draws [`StereoSlider`], with both photographs cached.
pub(crate) struct StereoSliderView {
    photos: [Photo; 2],
}

impl Default for StereoSliderView {
    fn default() -> Self {
        Self {
            photos: [(); 2].map(|()| Photo::following(scenes::moved_ball)),
        }
    }
}

fn rulers() -> (Ruler, Ruler) {
    let disparity = Ruler::linear(0.0, MOST_PX).named("disparity d, px");
    (disparity, Ruler::linear(0.0, MOST_M).shown(1.0, " m"))
}

impl View for StereoSliderView {
    type Model = StereoSlider;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _model: &StereoSlider, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let photo = |id, rect| Panel::photograph(id, rect, PHOTO_SIZE).clickable();
        // Side by side even on a phone, to show that both matches are in the same row.
        if grid::is_narrow(width) {
            let [left, right] = grid.row([PHOTO_ASPECT; 2], f64::INFINITY);
            let [top] = grid.shares([1.0], LOW);
            let panels = vec![
                photo("left", left),
                photo("right", right),
                from_above::panel(top),
            ];
            return grid.layout(panels);
        }
        let [whole] = grid.shares([1.0], (0.4 * width).clamp(330.0, 440.0));
        let [seen, top] = grid::columns(whole, [1.85, 1.0]);
        let [left, right] = grid::columns(seen, [1.0, 1.0]).map(|cell| Rect {
            height: cell.width * PHOTO_ASPECT,
            ..cell
        });
        let below = left.bottom() + grid::GAP + TITLE;
        let curve = Rect::new(seen.x, below, seen.width, (whole.bottom() - below).max(1.0));
        let (x, y) = rulers();
        let panels = vec![
            photo("left", left),
            photo("right", right),
            plot::panel("curve", curve, &x, &y),
            from_above::panel(top),
        ];
        grid.layout(panels)
    }

    fn draw(&mut self, model: &StereoSlider, layout: &Layout, canvas: &mut Canvas) {
        let rig = model.rig();
        self.draw_photographs(model, layout, canvas);
        from_above::draw(&rig, model.shown(), layout.panel("top"), canvas);
        let curve = layout.panels.iter().find(|panel| panel.id == "curve");
        if let Some(curve) = curve {
            draw_curve(model, curve, canvas);
        }
        if rig.measured().is_none() {
            let room = curve.unwrap_or(layout.panel("top"));
            grid::notice(canvas, room.rect, NO_BASELINE);
        }
    }

    fn prepare(&mut self, model: &StereoSlider) -> bool {
        self.slice(model, Photo::prepare)
    }

    fn refine(&mut self, model: &StereoSlider) -> bool {
        self.slice(model, Photo::refine)
    }
}

impl StereoSliderView {
    /// Does the next slice of work on either photograph.
    fn slice(&mut self, model: &StereoSlider, work: Slice) -> bool {
        let rig = model.rig();
        let (Ok(cameras), Ok(scene)) = (rig.cameras(), scenes::long_table((rig.x_m, rig.z_m)))
        else {
            return false;
        };
        let arrangement = rig.ball_in_world().coords.into();
        let mut photos = self.photos.iter_mut().zip(&cameras);
        photos.any(|(photo, camera)| work(photo, &scene, camera, arrangement, PHOTO_SIZE))
    }

    fn draw_photographs(&mut self, model: &StereoSlider, layout: &Layout, canvas: &mut Canvas) {
        let rig = &model.rig();
        let is_hidden = !model.reveal().shows_answer();
        let panels = [layout.panel("left"), layout.panel("right")];
        let made = (|| {
            let scene = scenes::long_table((rig.x_m, rig.z_m))?;
            Ok((rig.cameras()?, rig.pixels()?, rig.sights()?, scene))
        })();
        let (cameras, pixels, sights, scene) = match made {
            Ok(made) => made,
            Err(error) => return refuse(canvas, panels, &error),
        };
        let arrangement = rig.ball_in_world().coords.into();
        let mut magnifier = None;
        for index in 0..2 {
            let rect = panels[index].rect;
            let said = match index == 1 && is_hidden {
                true => fitting(rect.width - 18.0, &HIDDEN).to_owned(),
                false => title(index, sights[index], pixels[index].x, rect.width),
            };
            let (role, shape) = CAMERAS[index];
            let middle = rect.y - TITLE / 2.0;
            canvas.marker((rect.x + 6.0, middle), 5.0, shape, role, false);
            let place = (rect.x + 18.0, middle);
            canvas.label(place, &said, TextStyle::new(Role::Ink, TEXT));
            if index == 1 && is_hidden {
                canvas.panel(rect);
                continue;
            }
            let photo = &mut self.photos[index];
            match photo.picture(&scene, &cameras[index], arrangement, PHOTO_SIZE) {
                Ok(picture) => {
                    canvas.photograph(rect, picture);
                    magnifier = Magnifier::over(picture, &pixels[index]);
                }
                Err(error) => return refuse(canvas, panels, &error),
            }
        }
        // One row through both photographs and the gap between them.
        let rect = panels[0].rect;
        let row = panels[0].canvas_from_world((0.0, pixels[0].y)).1;
        let both = Rect::new(rect.x, rect.y, panels[1].rect.right() - rect.x, rect.height);
        let stroke = Stroke::solid(Role::Ink, 1.0).dashed().cased();
        canvas.clipped(both, |canvas| {
            canvas.line((both.x, row), (both.right(), row), stroke);
        });
        for index in 0..2 {
            let panel = panels[index];
            if index == 1 && is_hidden {
                let (role, shape) = CAMERAS[0];
                let left = panel.place_of(&pixels[0]);
                canvas.hollow_marker(left, MARKER, shape, role, true);
                continue;
            }
            let (role, shape) = CAMERAS[index];
            let place = panel.place_of(&pixels[index]);
            canvas.clipped(panel.rect, |canvas| {
                if index == 1 && sights[1] != Sight::Outside {
                    let left = panel.place_of(&pixels[0]);
                    draw_disparity(canvas, panel.rect, left, place, rig.measured());
                }
                match sights[index] {
                    Sight::Outside => {}
                    Sight::Clear => canvas.marker(place, MARKER, shape, role, true),
                    Sight::Hidden(_) => canvas.hollow_marker(place, MARKER, shape, role, true),
                }
            });
        }
        if let Some(guess) = model.guess() {
            canvas.grip(panels[1].place_of(&guess), Role::Grip);
        }
        // Magnifies the right photograph, which is the last.
        if let Some(magnifier) =
            magnifier.filter(|_| model.reveal() == Reveal::Answer && model.shown().is_some())
        {
            let place = panels[1].place_of(&pixels[1]);
            magnifier.draw(panels[1].rect, place, canvas);
        }
    }
}

/// Returns the title of a photograph.
fn title(index: usize, sight: Sight, column_px: f64, width: f64) -> String {
    let name = match width < 220.0 {
        true => ["Left: ", "Right: "][index],
        false => ["Left photograph, ", "Right photograph, "][index],
    };
    match sight {
        Sight::Clear => format!("{name}u = {}", format_number(column_px, 1)),
        Sight::Hidden(by) => format!("{name}{by} hides it"),
        Sight::Outside => format!("{name}it is outside"),
    }
}

/// Draws the error message in place of the photographs.
fn refuse(canvas: &mut Canvas, panels: [&Panel; 2], error: &epipole::Error) {
    for panel in panels {
        canvas.panel(panel.rect);
        grid::notice(canvas, panel.rect, &error.to_string());
    }
}

/// Draws, in the right photograph, the ball's column in the left one and the disparity.
fn draw_disparity(
    canvas: &mut Canvas,
    rect: Rect,
    left: Place,
    right: Place,
    measured: Option<Measured>,
) {
    let Some(measured) = measured else { return };
    let y = left.1 + 15.0;
    let stroke = Stroke::solid(Role::Ink, 1.5).cased();
    draw_span(canvas, (right.0, y), (left.0, y), stroke);
    let (role, shape) = CAMERAS[0];
    canvas.hollow_marker(left, MARKER, shape, role, true);
    let text = match rect.width < 220.0 {
        true => "d".to_owned(),
        false => format!("d = {} px", format_number(measured.disparity_px, 1)),
    };
    let below = (((left.0 + right.0) / 2.0, y + 14.0), Align::Middle);
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    Labels::new(rect.inset(2.0)).draw(canvas, &[below], &text, style);
}

/// Draws depth over disparity for this rig, and the effect of a pixel of error; only the axes while
/// the disparity is hidden.
fn draw_curve(model: &StereoSlider, panel: &Panel, canvas: &mut Canvas) {
    let (x, y) = rulers();
    grid::title(canvas, panel.rect, "Depth Z over disparity d: Z = f B / d");
    plot::draw_axes(canvas, panel, &x, &y);
    let Some(measured) = model.shown() else {
        return;
    };
    let rig = model.rig();
    let (d, near_m) = (measured.disparity_px, measured.interval.near_m);
    let far_m = measured.interval.far_m.unwrap_or(1e3);
    let at = |d: f64, z: f64| panel.canvas_from_world((d, z.min(1e3)));
    let bands = [
        [
            (d - ERROR_PX, 0.0),
            (d - ERROR_PX, far_m),
            (d + ERROR_PX, near_m),
            (d + ERROR_PX, 0.0),
        ],
        [
            (0.0, far_m),
            (d - ERROR_PX, far_m),
            (d + ERROR_PX, near_m),
            (0.0, near_m),
        ],
    ];
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        for band in bands {
            canvas.polygon(&band.map(|(d, z)| at(d.max(0.0), z)), UNCERTAIN, 0.25);
        }
    });
    let product = rig.focal_px * rig.baseline_m;
    // Evenly spaced along the curve, as it has both steep and flat parts.
    let [nearest, farthest] = [0.5 * DEPTH_RANGE_M[0], MOST_M];
    let places = (0..=96).map(|step| {
        let share = f64::from(step) / 96.0;
        let depth_m = nearest * libm::pow(farthest / nearest, share);
        (product / depth_m, depth_m)
    });
    plot::draw_curve(canvas, panel, places, Stroke::solid(Role::Ink, 2.0));
    if d <= MOST_PX {
        let place = at(d, measured.depth_m);
        canvas.marker(place, MARKER, Shape::Disk, Role::Grip, true);
    }
}
