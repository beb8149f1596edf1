//! Drawing of `stereo-slider`: both photographs on top, the view from above below.

use super::model::{DEPTH_RANGE_M, Measured, NO_BASELINE, Sight, StereoSlider, reach};
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Layout, Panel, Rect, View, format_number};
use crate::labels::Labels;
use crate::photo::Photo;
use crate::scenes::{self, PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH};
use crate::theme::Role;

const TEXT: f64 = 13.0;
const SMALL: f64 = 12.0;
/// Height of a line of text above a panel.
const TITLE: f64 = 24.0;
const MARKER: f64 = 4.5;
/// Each camera has a hue and a shape, in its photograph and in the view from above.
const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
/// The table: left, right, near and far edge, meters.
const TABLE_M: [f64; 4] = [-0.95, 0.95, 0.35, 11.35];
/// What an uncertain pixel leaves open.
const UNCERTAIN: Role = Role::Series(3);

/// The two photographs, kept between drawings.
#[derive(Default)]
pub(crate) struct StereoSliderView {
    photos: [Photo; 2],
}

impl View for StereoSliderView {
    type Model = StereoSlider;

    fn layout(&self, _model: &StereoSlider, width: f64) -> Layout {
        // Side by side on every page: that both are on the same row is the point.
        let gap = if width < 500.0 { 6.0 } else { 12.0 };
        let photo_width = ((width - gap) / 2.0).max(1.0);
        let photo_height = photo_width * f64::from(PHOTO_HEIGHT) / f64::from(PHOTO_WIDTH);
        let photo = |id, x| {
            let rect = Rect::new(x, TITLE, photo_width, photo_height);
            Panel {
                clickable: true,
                ..Panel::photograph(id, rect, PHOTO_WIDTH, PHOTO_HEIGHT)
            }
        };
        let top_y = TITLE + photo_height + 10.0 + TITLE;
        let top_height = (width * 0.44).clamp(280.0, 340.0);
        let top = Panel {
            id: "top",
            rect: Rect::new(0.0, top_y, width, top_height),
            x_axis: Axis {
                start: -1.15,
                end: 1.15,
            },
            y_axis: Axis {
                start: DEPTH_RANGE_M[1] + 0.8,
                end: -1.3,
            },
            clickable: true,
        };
        Layout {
            width,
            height: top_y + top_height,
            panels: vec![photo("left", 0.0), photo("right", photo_width + gap), top],
        }
    }

    fn draw(&mut self, model: &StereoSlider, layout: &Layout, canvas: &mut Canvas) {
        self.draw_photographs(model, layout, canvas);
        draw_from_above(model, layout, canvas);
    }

    fn refine(&mut self, model: &StereoSlider) -> bool {
        let (Ok(cameras), Ok(scene)) = (model.cameras(), scenes::long_table(model.object_m()))
        else {
            return false;
        };
        let arrangement = model.object_in_world().coords.into();
        let mut photos = self.photos.iter_mut().zip(&cameras);
        photos.any(|(photo, camera)| photo.refine(&scene, camera, arrangement, PHOTO_SIZE))
    }
}

impl StereoSliderView {
    fn draw_photographs(&mut self, model: &StereoSlider, layout: &Layout, canvas: &mut Canvas) {
        let panels = [layout.panel("left"), layout.panel("right")];
        let made = (|| {
            let scene = scenes::long_table(model.object_m())?;
            Ok((model.cameras()?, model.pixels()?, model.sights()?, scene))
        })();
        let (cameras, pixels, sights, scene) = match made {
            Ok(made) => made,
            Err(error) => return draw_refusal(canvas, layout, &error),
        };
        let arrangement = model.object_in_world().coords.into();
        for index in 0..2 {
            let rect = panels[index].rect;
            let title = ["Left photograph", "Right photograph"][index];
            let (role, shape) = CAMERAS[index];
            canvas.marker((rect.x + 6.0, TITLE / 2.0), 5.0, shape, role, false);
            let place = (rect.x + 18.0, TITLE / 2.0);
            canvas.label(place, title, TextStyle::new(Role::Ink, TEXT));
            let picture =
                self.photos[index].picture(&scene, &cameras[index], arrangement, PHOTO_SIZE);
            match picture {
                Ok(picture) => canvas.photograph(rect, picture),
                Err(error) => return draw_refusal(canvas, layout, &error),
            }
        }
        // One row through both photographs, and through the gap between them.
        let row = panels[0].canvas_from_world((0.0, pixels[0].y)).1;
        let both = Rect::new(0.0, panels[0].rect.y, layout.width, panels[0].rect.height);
        let stroke = Stroke::solid(Role::Ink, 1.0).dashed().cased();
        canvas.clipped(both, |canvas| {
            canvas.line((both.x, row), (both.right(), row), stroke);
        });
        for index in 0..2 {
            let panel = panels[index];
            let (role, shape) = CAMERAS[index];
            let place = panel.canvas_from_world((pixels[index].x, pixels[index].y));
            let mut labels = Labels::new(panel.rect);
            let style = TextStyle::new(role, TEXT).cased();
            if sights[index] == Sight::Outside {
                let at = (panel.rect.center().0, place.1 - 16.0);
                let text = "the ball is outside";
                let style = TextStyle::new(Role::Ink, TEXT).cased();
                labels.draw(canvas, &[(at, Align::Middle)], text, style);
                continue;
            }
            canvas.clipped(panel.rect, |canvas| {
                if index == 1 {
                    let left = panel.canvas_from_world((pixels[0].x, pixels[0].y));
                    draw_disparity(canvas, &mut labels, left, place, model.measured());
                }
                match sights[index] {
                    Sight::Clear => canvas.marker(place, MARKER, shape, role, true),
                    _ => canvas.hollow_marker(place, MARKER, shape, role, true),
                }
            });
            labels.keep_free(place, 6.0);
            let text = match sights[index] {
                Sight::Hidden(by) => format!("hidden by {by}"),
                _ => format!("u = {}", format_number(pixels[index].x, 1)),
            };
            let above = ((place.0, place.1 - 19.0), Align::Middle);
            let higher = ((place.0, place.1 - 36.0), Align::Middle);
            labels.draw(canvas, &[above, higher], &text, style);
        }
    }
}

/// Why there are no photographs, in their place.
fn draw_refusal(canvas: &mut Canvas, layout: &Layout, error: &epipole::Error) {
    for id in ["left", "right"] {
        let rect = layout.panel(id).rect;
        canvas.panel(rect);
        let style = TextStyle::new(Role::Ink, TEXT);
        canvas.paragraph(rect.inset(10.0), &error.to_string(), style);
    }
}

/// In the right photograph: where the left one has the object, and how far it moved.
fn draw_disparity(
    canvas: &mut Canvas,
    labels: &mut Labels,
    left: Place,
    right: Place,
    measured: Option<Measured>,
) {
    let Some(measured) = measured else { return };
    let y = left.1 + 16.0;
    let stroke = Stroke::solid(Role::Ink, 1.5).cased();
    canvas.line((right.0, y), (left.0, y), stroke);
    for x in [right.0, left.0] {
        canvas.line((x, y - 5.0), (x, y + 5.0), stroke);
    }
    let (role, shape) = CAMERAS[0];
    canvas.hollow_marker(left, MARKER, shape, role, true);
    labels.keep_free(left, 6.0);
    let text = format!("d = {} px", format_number(measured.disparity_px, 1));
    let below = (((left.0 + right.0) / 2.0, y + 17.0), Align::Middle);
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &[below], &text, style);
}

fn draw_from_above(model: &StereoSlider, layout: &Layout, canvas: &mut Canvas) {
    let panel = layout.panel("top");
    let rect = panel.rect;
    let narrow = layout.width < 500.0;
    let title = if narrow {
        "From above, stretched sideways"
    } else {
        "From above, stretched sideways so that the baseline can be seen"
    };
    let place = (rect.x, rect.y - TITLE / 2.0);
    canvas.label(place, title, TextStyle::new(Role::Ink, TEXT));
    canvas.panel(rect);
    let at = |x: f64, z: f64| panel.canvas_from_world((x, z));
    let inner = rect.inset(1.0);
    let mut labels = Labels::new(rect.inset(2.0));
    canvas.clipped(inner, |canvas| draw_grid(canvas, panel, &mut labels));

    let (x_m, z_m) = model.object_m();
    let baseline_m = model.baseline_m();
    let measured = model.measured();
    canvas.clipped(inner, |canvas| {
        if let Some(measured) = measured {
            draw_uncertainty(canvas, panel, model, measured);
        }
        // Field of view of both cameras.
        let half = f64::from(PHOTO_WIDTH) / 2.0 / model.focal_px();
        for camera_x in [0.0, baseline_m] {
            for side in [-1.0, 1.0] {
                let far = panel.y_axis.start;
                let edge = at(camera_x + side * half * far, far);
                canvas.line(at(camera_x, 0.0), edge, Stroke::solid(Role::Edge, 1.0));
            }
        }
        for (index, camera_x) in [0.0, baseline_m].into_iter().enumerate() {
            let (role, _) = CAMERAS[index];
            let stroke = Stroke::solid(role, 1.75);
            canvas.line(at(camera_x, 0.0), at(x_m, z_m), stroke);
            let beyond = panel.y_axis.start / z_m;
            let end = at(camera_x + (x_m - camera_x) * beyond, panel.y_axis.start);
            canvas.line(at(x_m, z_m), end, Stroke::solid(role, 1.0).dotted());
        }
        draw_cameras(canvas, panel, &mut labels, baseline_m);
        canvas.grip(at(x_m, z_m), Role::Grip);
    });
    match measured {
        Some(measured) => draw_numbers(canvas, panel, &mut labels, model, measured),
        None => {
            let text_rect = Rect::new(rect.x + 44.0, rect.y + 14.0, rect.width - 60.0, 90.0);
            let style = TextStyle::new(Role::Ink, TEXT).cased();
            canvas.paragraph(text_rect, NO_BASELINE, style);
        }
    }
}

fn draw_grid(canvas: &mut Canvas, panel: &Panel, labels: &mut Labels) {
    let rect = panel.rect;
    let (left, far) = panel.canvas_from_world((TABLE_M[0], TABLE_M[3]));
    let (right, near) = panel.canvas_from_world((TABLE_M[1], TABLE_M[2]));
    let table = Rect::new(left, far, right - left, near - far);
    canvas.fill_rect(table, Role::Background, 1.0);
    for x in [left, right] {
        canvas.line((x, far), (x, near), Stroke::solid(Role::Grid, 1.0));
    }
    canvas.line((left, near), (right, near), Stroke::solid(Role::Grid, 1.0));
    let style = TextStyle::new(Role::Muted, SMALL);
    let place = ((right - 6.0, near - 10.0), Align::End);
    labels.draw(canvas, &[place], "table", style);
    for meters in 0..=10 {
        let z = f64::from(meters);
        let y = panel.canvas_from_world((0.0, z)).1;
        canvas.line(
            (rect.x, y),
            (rect.right(), y),
            Stroke::solid(Role::Grid, 1.0),
        );
        if meters % 2 == 0 && meters > 0 {
            canvas.label((rect.x + 8.0, y), &format!("{meters} m"), style.cased());
        }
    }
}

fn draw_cameras(canvas: &mut Canvas, panel: &Panel, labels: &mut Labels, baseline_m: f64) {
    let (left, y) = panel.canvas_from_world((0.0, 0.0));
    let right = panel.canvas_from_world((baseline_m, 0.0)).0;
    let stroke = Stroke::solid(Role::Ink, 1.5);
    canvas.line((left, y + 14.0), (right, y + 14.0), stroke);
    for (index, x) in [left, right].into_iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        canvas.line((x, y + 10.0), (x, y + 18.0), stroke);
        canvas.marker((x, y), 5.5, shape, role, true);
        let style = TextStyle::new(role, TEXT).cased();
        let (place, text) = if index == 0 {
            (((x - 12.0, y), Align::End), "left camera")
        } else {
            (((x + 12.0, y), Align::Start), "right camera")
        };
        labels.draw(canvas, &[place], text, style);
    }
    labels.keep_rect_free(Rect::new(left - 6.0, y - 6.0, right - left + 12.0, 24.0));
    let text = format!("B = {} m", format_number(baseline_m, 2));
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    let place = ((right + 12.0, y + 19.0), Align::Start);
    labels.draw(canvas, &[place], &text, style);
}

/// The depths that one pixel more or less leaves open: a band, and the part of the left ray in it.
fn draw_uncertainty(canvas: &mut Canvas, panel: &Panel, model: &StereoSlider, measured: Measured) {
    let (x_m, z_m) = model.object_m();
    let near_m = measured.interval.near_m;
    let far_m = measured.interval.far_m.unwrap_or(f64::INFINITY);
    let shown_far_m = far_m.min(panel.y_axis.start);
    let along_left = |z: f64| panel.canvas_from_world((x_m / z_m * z, z));
    let (near, far) = (along_left(near_m), along_left(shown_far_m));
    let rect = panel.rect;
    let band = Rect::new(rect.x, far.1, rect.width, near.1 - far.1);
    canvas.fill_rect(band, UNCERTAIN, 0.14);
    for (y, is_edge) in [(near.1, true), (far.1, far_m < panel.y_axis.start)] {
        if is_edge {
            let stroke = Stroke::solid(UNCERTAIN, 1.0);
            canvas.line((rect.x, y), (rect.right(), y), stroke);
        }
    }
    // All places that the right camera allows: between the rays through the columns one pixel
    // to either side.
    let right = panel.canvas_from_world((model.baseline_m(), 0.0));
    canvas.polygon(&[right, near, far], UNCERTAIN, 0.35);
    canvas.line(near, far, Stroke::solid(UNCERTAIN, 5.0));
}

fn draw_numbers(
    canvas: &mut Canvas,
    panel: &Panel,
    labels: &mut Labels,
    model: &StereoSlider,
    measured: Measured,
) {
    let (x_m, z_m) = model.object_m();
    let rect = panel.rect;
    let near_m = measured.interval.near_m;
    let far_m = measured.interval.far_m.unwrap_or(f64::INFINITY);
    let far_y = panel
        .canvas_from_world((0.0, far_m.min(panel.y_axis.start)))
        .1;
    let near_y = panel.canvas_from_world((0.0, near_m)).1;
    let object = panel.canvas_from_world((x_m, z_m));
    labels.keep_free(object, 10.0);
    // Nothing is written across the edges of the band.
    for y in [near_y, far_y] {
        for index in 0..=(rect.width / 8.0) as usize {
            labels.keep_free((rect.x + 8.0 * index as f64, y), 2.0);
        }
    }
    let reach = reach(&measured.interval);
    let text = if rect.width < 500.0 {
        format!("±1 px: {reach}")
    } else {
        format!("±1 px of disparity: {reach}")
    };
    // On the side away from the object.
    let (x, align) = if x_m < 0.0 {
        (rect.right() - 8.0, Align::End)
    } else {
        (rect.x + 44.0, Align::Start)
    };
    let places = [far_y - 12.0, near_y + 12.0, (near_y + far_y) / 2.0].map(|y| ((x, y), align));
    let style = TextStyle::new(UNCERTAIN, TEXT).cased();
    labels.draw(canvas, &places, &text, style);
    let text = format!("Z = {} m", format_number(measured.depth_m, 2));
    let (x, y) = object;
    let places = [
        ((x + 15.0, y + 18.0), Align::Start),
        ((x + 17.0, y), Align::Start),
        ((x + 15.0, y - 18.0), Align::Start),
        ((x - 17.0, y), Align::End),
        ((x - 15.0, y - 18.0), Align::End),
    ];
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &places, &text, style);
}
