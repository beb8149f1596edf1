//! Both photographs with the matches and their lines; below, the place where the lines meet, much
//! enlarged, and the singular values.

use super::estimate::{Estimate, line2};
use super::model::EightPoint;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Layout, Panel, Rect, View, format_number};
use crate::labels::Labels;
use crate::pair::{self, GAP, STACKED_BELOW, TEXT, TITLE, border_arrow, draw_line, draw_notice};
use crate::photo::Photo;
use crate::scenes::{PHOTO_SIZE, still_life};
use crate::theme::Role;
use epipole::epipolar::Epipole;
use nalgebra::Point2;

const SMALL: f64 = 12.0;
const MARKER: f64 = 5.0;
/// So many matches have their line drawn; more would hide the photograph.
const NUM_LINES: usize = 10;
/// The enlarged place shows so many pixels of photograph 2 to each side: the first that is enough.
const NEAR_PX: [f64; 6] = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0];
/// The decades that the singular values are plotted over, and their labels.
const DECADES: (f64, f64) = (-3.0, 7.0);
const DECADE_LABELS: [(f64, &str); 5] = [
    (-2.0, "0.01"),
    (0.0, "1"),
    (2.0, "100"),
    (4.0, "10⁴"),
    (6.0, "10⁶"),
];

/// The two photographs, kept between drawings.
#[derive(Default)]
pub struct EightPointView {
    photos: [Photo; 2],
}

impl View for EightPointView {
    type Model = EightPoint;

    fn layout(&self, model: &EightPoint, width: f64) -> Layout {
        let [first, second] = pair::panels(width, [PHOTO_SIZE; 2]);
        let first = Panel {
            clickable: true,
            ..first
        };
        let is_stacked = width < STACKED_BELOW;
        let top = second.rect.bottom() + GAP + TITLE;
        let room = (width - GAP).max(2.0);
        let height = if is_stacked { 190.0 } else { 230.0 };
        let left = room * if is_stacked { 0.45 } else { 0.5 };
        let meeting = Rect::new(0.0, top, left, height);
        let values = Rect::new(left + GAP, top, room - left, height);
        let (place, half_width) = enlarged(model);
        // As many pixels to a CSS pixel along the rows as along the columns.
        let half_height = half_width * meeting.height / meeting.width;
        let axis = |middle: f64, half: f64| Axis {
            start: middle - half,
            end: middle + half,
        };
        Layout {
            width,
            height: values.bottom() + 24.0,
            panels: vec![
                first,
                second,
                Panel {
                    id: "meeting",
                    rect: meeting,
                    x_axis: axis(place.x, half_width),
                    y_axis: axis(place.y, half_height),
                    clickable: false,
                },
                Panel {
                    id: "values",
                    rect: values,
                    x_axis: Axis {
                        start: if is_stacked { -1.4 } else { -0.4 },
                        end: 9.6,
                    },
                    y_axis: Axis {
                        start: DECADES.1,
                        end: DECADES.0,
                    },
                    clickable: false,
                },
            ],
        }
    }

    fn draw(&mut self, model: &EightPoint, layout: &Layout, canvas: &mut Canvas) {
        let (first, second) = (layout.panel("first"), layout.panel("second"));
        self.draw_photographs(model, [first, second], canvas);
        let (meeting, values) = (layout.panel("meeting"), layout.panel("values"));
        let is_narrow = layout.width < STACKED_BELOW;
        let titles = if is_narrow {
            ["At the epipole", "Singular values"]
        } else {
            [
                "Where the lines meet in photograph 2, enlarged",
                "Singular values of the stacked rows",
            ]
        };
        for (panel, title) in [(meeting, titles[0]), (values, titles[1])] {
            pair::draw_title(canvas, panel.rect, title);
            canvas.panel(panel.rect);
        }
        let estimate = match model.estimate() {
            Ok(estimate) => estimate,
            Err(sentence) => return draw_notice(canvas, second.rect, sentence),
        };
        canvas.clipped(first.rect, |canvas| {
            draw_first(model, estimate, first, canvas)
        });
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, estimate, second, canvas)
        });
        canvas.clipped(meeting.rect.inset(1.0), |canvas| {
            draw_meeting(model, estimate, meeting, canvas);
        });
        draw_values(model, estimate, values, canvas);
    }

    fn refine(&mut self, model: &EightPoint) -> bool {
        let (cameras, scene) = (model.cameras(), still_life());
        let mut photos = self.photos.iter_mut().zip(&cameras);
        photos.any(|(photo, camera)| photo.refine(&scene, camera, [0.0; 3], PHOTO_SIZE))
    }
}

impl EightPointView {
    fn draw_photographs(&mut self, model: &EightPoint, panels: [&Panel; 2], canvas: &mut Canvas) {
        let (cameras, scene) = (model.cameras(), still_life());
        let titles = [
            "Photograph 1: drag the probe",
            "Photograph 2: lines by the F found",
        ];
        for index in 0..2 {
            let rect = panels[index].rect;
            pair::draw_title(canvas, rect, titles[index]);
            match self.photos[index].picture(&scene, &cameras[index], [0.0; 3], PHOTO_SIZE) {
                Ok(picture) => canvas.photograph(rect, picture),
                Err(error) => {
                    canvas.panel(rect);
                    draw_notice(canvas, rect, &error.to_string());
                }
            }
        }
    }
}

/// The place of photograph 2 that is enlarged, and how far it reaches to each side, pixels.
fn enlarged(model: &EightPoint) -> (Point2<f64>, f64) {
    let estimate = model.estimate().ok();
    let Some(meeting) = estimate.and_then(|estimate| estimate.meeting) else {
        return (Point2::origin(), NEAR_PX[0]);
    };
    let enough = NEAR_PX.iter().find(|&&near| near >= 3.0 * meeting.miss_px);
    (
        meeting.place,
        *enough.unwrap_or(&NEAR_PX[NEAR_PX.len() - 1]),
    )
}

fn series(index: usize) -> (Role, Shape) {
    (Role::Series(index as u8), Shape::of_series(index))
}

fn draw_first(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    for (index, (pixel1, _)) in estimate.used.iter().enumerate().rev() {
        draw_match(canvas, panel.canvas_from_world((pixel1.x, pixel1.y)), index);
    }
    let probe = model.probe();
    canvas.grip(panel.canvas_from_world((probe.x, probe.y)), Role::Grip);
}

/// Matches without a line of their own are small.
fn draw_match(canvas: &mut Canvas, place: Place, index: usize) {
    if index < NUM_LINES {
        let (role, shape) = series(index);
        canvas.marker(place, MARKER, shape, role, true);
    } else {
        canvas.marker(place, 2.5, Shape::Disk, Role::Ink, true);
    }
}

fn draw_second(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    draw_lines(estimate, panel, canvas, true);
    for (index, (_, pixel2)) in estimate.used.iter().enumerate().rev() {
        draw_match(canvas, panel.canvas_from_world((pixel2.x, pixel2.y)), index);
    }
    let probe = model.probe();
    if let Some(line) = line2(&estimate.fundamental, &probe) {
        draw_line(canvas, panel, &line, Stroke::solid(Role::Grip, 3.0).cased());
    }
    if let Some(pixel2) = model.probe_match() {
        let place = panel.canvas_from_world((pixel2.x, pixel2.y));
        canvas.marker(place, 6.5, Shape::Ring, Role::Grip, true);
        canvas.marker(place, 2.0, Shape::Disk, Role::Grip, true);
        let mut labels = Labels::new(panel.rect);
        labels.keep_free(place, 9.0);
        let style = TextStyle::new(Role::Ink, TEXT).cased();
        labels.draw(canvas, &Labels::around(place, 11.0), "true match", style);
    }
}

fn draw_lines(estimate: &Estimate, panel: &Panel, canvas: &mut Canvas, cased: bool) {
    for (index, (pixel1, _)) in estimate.used.iter().take(NUM_LINES).enumerate() {
        if let Some(line) = line2(&estimate.fundamental, pixel1) {
            let stroke = Stroke {
                cased,
                ..Stroke::solid(series(index).0, 1.5)
            };
            draw_line(canvas, panel, &line, stroke);
        }
    }
}

/// The lines around the place where they meet, and where they should have met.
fn draw_meeting(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    if estimate.meeting.is_none() {
        return draw_notice(canvas, panel.rect, "The lines are nearly parallel.");
    }
    draw_lines(estimate, panel, canvas, false);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    // A bar, so that the enlargement can be read off.
    let bar_px = (panel.x_axis.end - panel.x_axis.start) / 10.0;
    let length = bar_px * panel.scale_x();
    let (x, y) = (panel.rect.x + 10.0, panel.rect.bottom() - 12.0);
    let text = format!("{} px", format_number(bar_px, 0));
    canvas.line(
        (x, y),
        (x + length, y),
        Stroke::solid(Role::Ink, 2.0).cased(),
    );
    let style = TextStyle::new(Role::Ink, SMALL).cased();
    canvas.label((x + length + 6.0, y), &text, style);
    labels.keep_rect_free(Rect::new(x, y - 8.0, length + 50.0, 16.0));
    if let Some(Epipole::Finite(truth)) = model.true_epipole2() {
        let place = panel.canvas_from_world((truth.x, truth.y));
        if panel.rect.contains(place) {
            canvas.marker(place, 6.0, Shape::Plus, Role::Truth, true);
            labels.keep_free(place, 8.0);
            labels.draw(canvas, &Labels::around(place, 9.0), "true epipole", style);
        } else if let Some((from, to)) = border_arrow(panel.rect, place) {
            canvas.arrow(from, to, Stroke::solid(Role::Truth, 2.5).cased());
            let away_px = libm::hypot(place.0 - to.0, place.1 - to.1) / panel.scale_x();
            let text = format!("truth: {} px", format_number(away_px, 0));
            labels.keep_free(from, 6.0);
            labels.draw(canvas, &Labels::around(from, 9.0), &text, style);
        }
    }
}

/// Both lists of singular values over a logarithmic scale.
fn draw_values(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    let style = TextStyle::new(Role::Muted, SMALL);
    let (low, _) = DECADES;
    for (decade, text) in DECADE_LABELS {
        let (from, y) = panel.canvas_from_world((0.6, decade));
        let to = panel.rect.right() - 1.0;
        canvas.line((from, y), (to, y), Stroke::solid(Role::Grid, 1.0));
        canvas.label((panel.rect.x + 5.0, y), text, style);
    }
    for k in 1..=9 {
        let x = panel.canvas_from_world((f64::from(k), low)).0;
        let text = format!(
            "σ{}",
            ['₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][k as usize - 1]
        );
        canvas.label((x, panel.rect.bottom() + 12.0), &text, style.middle());
    }
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let scale_width = panel.canvas_from_world((0.5, low)).0 - panel.rect.x;
    labels.keep_rect_free(Rect {
        width: scale_width,
        ..panel.rect
    });
    let [raw, normalized] = estimate.singular_values();
    let lists = [
        (raw, Role::Outlier, Shape::Square, "raw pixels", false),
        (normalized, Role::Inlier, Shape::Disk, "normalized", true),
    ];
    let mut texts = Vec::new();
    for (values, role, shape, name, is_normalized) in lists {
        let places: Vec<Place> = values
            .iter()
            .enumerate()
            .map(|(k, value)| {
                let decade = libm::log10(value.max(f64::MIN_POSITIVE)).max(low);
                panel.canvas_from_world((k as f64 + 1.0, decade))
            })
            .collect();
        let is_chosen = is_normalized == model.is_normalized();
        let stroke = Stroke::solid(role, if is_chosen { 2.5 } else { 1.25 });
        let stroke = if is_normalized {
            stroke
        } else {
            stroke.dashed()
        };
        canvas.clipped(panel.rect.inset(1.0), |canvas| {
            canvas.polyline(&places, stroke)
        });
        for &(x, y) in &places {
            let place = (x, y.clamp(panel.rect.y + 5.0, panel.rect.bottom() - 5.0));
            canvas.marker(place, if is_chosen { 4.5 } else { 3.5 }, shape, role, false);
            labels.keep_free(place, 7.0);
        }
        // A phone has no room for more than the name; the stroke says which one is in use.
        let is_wide = panel.rect.width > 250.0;
        let text = if is_chosen && is_wide {
            format!("{name}, in use")
        } else {
            name.to_owned()
        };
        let anchor = if is_normalized { places[4] } else { places[2] };
        texts.push((anchor, text, role));
    }
    for (anchor, text, role) in texts {
        let style = TextStyle::new(role, SMALL).cased();
        labels.draw(canvas, &Labels::around(anchor, 8.0), &text, style);
    }
}
