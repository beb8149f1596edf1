//! A frame with the points and their paths, and the error of each point over all frames.

use super::model::{TrackFigure, WRONG_PX};
use super::question::{Answer, Sighting};
use crate::canvas::{Canvas, Place, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::plot::{self, Ruler, decade};
use crate::kit::sequence::SIZE;
use crate::theme::Role;

/// Height over width of a frame.
const ASPECT: f64 = grid::aspect(SIZE);
/// Number of earlier frames whose positions are drawn.
const TAIL: usize = 6;
/// Minimum and maximum error of the axis, pixels.
const LEAST_PX: f64 = 0.01;
const MOST_PX: f64 = 60.0;
const MEDIAN: Stroke = Stroke::solid(Role::Ink, 2.25);
const LEGEND: [Entry; 3] = [
    (Swatch::Marker(Shape::Disk, Role::Inlier), "right"),
    (Swatch::Marker(Shape::Cross, Role::Outlier), "wrong"),
    (Swatch::Line(MEDIAN), "median"),
];

/// Draws [`TrackFigure`].
#[derive(Default)]
pub(crate) struct TrackView;

fn rulers(model: &TrackFigure) -> [Ruler; 2] {
    let last = model.last() as f64;
    [
        Ruler::linear(-0.03 * last, 1.03 * last).named("frame"),
        Ruler::decades(decade(LEAST_PX), decade(MOST_PX)),
    ]
}

impl View for TrackView {
    type Model = TrackFigure;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &TrackFigure, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photo, errors) = if grid::is_narrow(width) {
            let [photo] = grid.row([ASPECT], 168.0);
            let [errors] = grid.shares([1.0], 136.0);
            (photo, errors)
        } else {
            let [photo, errors] = grid.row([ASPECT, 0.86], 400.0);
            (photo, errors)
        };
        grid.strip(legend::height(&LEGEND, width, 0.0));
        let [x, y] = rulers(model);
        let [plot, track] = plot::panel_and_track("errors", errors, &x, &y);
        grid.layout(vec![Panel::photograph("photo", photo, SIZE), plot, track])
    }

    fn draw(&mut self, model: &TrackFigure, layout: &Layout, canvas: &mut Canvas) {
        let [photo, plot, track] = layout.panels_named(["photo", "errors", "track"]);
        let frame = model.frame();
        grid::open(canvas, photo, &[&format!("Frame {}", frame + 1)]);
        let [x, y] = rulers(model);
        plot::draw_axes(canvas, plot, &x, &y);
        plot::title_from_left(canvas, plot, &["Error of each point, px", "Error, px"]);
        let frames = model
            .asked
            .answer()
            .map_or(&[][..], |answer| &answer.frames);
        if let Some(picture) = frames.get(frame) {
            canvas.photograph(photo.rect, picture.image());
        }
        if let Some(answer) = model.answer() {
            canvas.clipped(photo.rect, |canvas| {
                for track in &answer.tracks {
                    draw_path(track, frame, photo, canvas);
                }
            });
            draw_errors(model, answer, plot, canvas);
        } else {
            grid::notice(canvas, photo.rect, model.asked.stand_in());
        }
        plot::draw_now(canvas, plot, model.place());
        plot::draw_track(canvas, track, [0.0, model.last() as f64], model.place());
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 0.0);
    }
}

/// Draws a point with its recent path, if it is still tracked.
fn draw_path(track: &[Sighting], frame: usize, panel: &Panel, canvas: &mut Canvas) {
    let Some(sighting) = track.get(frame) else {
        return;
    };
    let places: Vec<Place> = track[frame.saturating_sub(TAIL)..=frame]
        .iter()
        .map(|sighting| panel.canvas_from_world(sighting.place))
        .collect();
    let role = match sighting.is_wrong() {
        true => Role::Outlier,
        false => Role::Inlier,
    };
    canvas.polyline(&places, Stroke::solid(role, 1.5).cased());
    let place = panel.canvas_from_world(sighting.place);
    match sighting.is_wrong() {
        true => canvas.marker(place, 4.0, Shape::Cross, role, true),
        false => canvas.marker(place, 3.0, Shape::Disk, role, true),
    }
}

/// Draws the error of each point while it is visible, and the median.
fn draw_errors(model: &TrackFigure, answer: &Answer, panel: &Panel, canvas: &mut Canvas) {
    let world =
        |(frame, error): (usize, f64)| (frame as f64, decade(error.clamp(LEAST_PX, MOST_PX)));
    for track in &answer.tracks {
        let is_right = track.iter().filter_map(|sighting| sighting.error_px);
        let role = match is_right.fold(0.0, f64::max) > WRONG_PX {
            true => Role::Outlier,
            false => Role::Inlier,
        };
        let errors = track.iter().enumerate();
        // The first error is zero.
        let errors = errors
            .skip(1)
            .filter_map(|(frame, s)| Some((frame, s.error_px?)));
        plot::draw_curve(canvas, panel, errors.map(world), Stroke::solid(role, 0.75));
    }
    let medians = (1..answer.frames.len())
        .filter_map(|frame| Some((frame, model.tally(answer, frame).median_px?)));
    plot::draw_curve(canvas, panel, medians.map(world), MEDIAN);
}
