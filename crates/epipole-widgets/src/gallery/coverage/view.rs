//! The image with the outlines of the boards; the distortion curve with its band; and the focal
//! length with its interval.

use super::boards::{FOCAL_PX, MIDDLE_PX, SIZE, board};
use super::model::Coverage;
use super::question::{Found, farthest_px, radii_px, true_curve};
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Swatch};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

const FOUND: Role = Role::Best;
const TRUTH: Stroke = Stroke::solid(Role::Truth, 2.0).dashed();
/// Range of the displacement by the lens, pixels.
const MOVED_PX: [f64; 2] = [-100.0, 20.0];
/// Half ranges of the focal length, pixels; the first one that suffices is used.
const AROUND_PX: [f64; 6] = [3.0, 6.0, 15.0, 30.0, 60.0, 120.0];
/// Sides of the polygon drawn as a circle.
const NUM_SIDES: u32 = 120;
/// Width of the panel of the focal length, CSS pixels.
const SLIM: f64 = 112.0;

/// Draws [`Coverage`].
#[derive(Default)]
pub(crate) struct CoverageView;

impl View for CoverageView {
    type Model = Coverage;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &Coverage, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let (image, curve, focal) = if grid::is_narrow(width) {
            let height = 156.0;
            let beside = width - GAP - height / aspect;
            let [image, focal] = grid.shares([height / aspect, beside], height);
            let [curve] = grid.shares([1.0], 132.0);
            (image, curve, focal)
        } else {
            let height = (0.345 * width).min(360.0);
            let rest = width - 2.0 * GAP - height / aspect - SLIM;
            let [image, curve, focal] = grid.shares([height / aspect, rest, SLIM], height);
            (image, curve, focal)
        };
        grid.strip(legend::height(&legend_entries(), width, 0.0) + 4.0);
        let ([x, y], [across, up]) = (lens_rulers(), focal_rulers(model));
        grid.layout(vec![
            Panel::photograph("image", image, SIZE).clickable(),
            plot::panel("curve", curve, &x, &y),
            plot::panel("focal", focal, &across, &up),
        ])
    }

    fn draw(&mut self, model: &Coverage, layout: &Layout, canvas: &mut Canvas) {
        let image = layout.panel("image");
        grid::open(
            canvas,
            image,
            &["Boards in the image: drag", "Boards: drag"],
        );
        canvas.clipped(image.rect.inset(1.0), |canvas| {
            draw_boards(model, image, canvas)
        });
        let titles = ["Displacement by the lens, px", "Displacement, px"];
        let curve = plot::open(canvas, layout, "curve", &titles, &lens_rulers());
        let focal = layout.panel("focal");
        plot::title_from_left(canvas, focal, &["Focal length, px", "f, px"]);
        let [across, up] = focal_rulers(model);
        plot::draw_axes(canvas, focal, &across, &up);
        draw_uncovered(model, curve, canvas);
        match model.found() {
            Some(Ok(found)) => {
                draw_curves(Some(found), curve, canvas);
                draw_focal(Some(found), focal, canvas);
            }
            other => {
                draw_curves(None, curve, canvas);
                draw_focal(None, focal, canvas);
                // The description gives the reason, which has no room here on a phone.
                let text = match other {
                    Some(Err(_)) => "These boards give no camera.",
                    _ => model.asked.stand_in(),
                };
                grid::notice(canvas, curve.rect, text);
            }
        }
        legend::draw_last(canvas, &legend_entries(), layout, 0.0, 4.0);
    }
}

fn legend_entries() -> [legend::Entry; 2] {
    [
        (Swatch::Line(TRUTH), "true"),
        (Swatch::Line(Stroke::solid(FOUND, 2.5)), "found, with ± 1 σ"),
    ]
}

fn lens_rulers() -> [Ruler; 2] {
    let radius = Ruler::linear(0.0, farthest_px()).named("distance from the middle, px");
    [radius, Ruler::linear(MOVED_PX[0], MOVED_PX[1])]
}

fn focal_rulers(model: &Coverage) -> [Ruler; 2] {
    let reach_px = model.found().and_then(Result::ok).map_or(0.0, |found| {
        (found.focal_px - FOCAL_PX).abs() + 1.2 * found.focal_std_px
    });
    let half_px = AROUND_PX.into_iter().find(|half_px| *half_px >= reach_px);
    let half_px = half_px.unwrap_or(AROUND_PX[AROUND_PX.len() - 1]);
    let focal = Ruler::linear(FOCAL_PX - half_px, FOCAL_PX + half_px);
    [Ruler::bare(0.0, 1.0), focal]
}

/// Draws outlines and marks of the boards, and the circle that the farthest mark reaches.
fn draw_boards(model: &Coverage, panel: &Panel, canvas: &mut Canvas) {
    let (Ok(boards), Ok(board)) = (model.marks(), board()) else {
        return;
    };
    let (columns, num_marks) = (board.columns(), board.num_marks());
    let corners = [0, columns - 1, num_marks - 1, num_marks - columns];
    for marks in boards {
        let outline = corners.map(|corner| panel.place_of(&marks[corner]));
        canvas.polygon(&outline, Role::Series(0), 0.12);
        canvas.polygon_outline(&outline, Stroke::solid(Role::Series(0), 1.5));
        for mark in marks {
            canvas.disk(panel.place_of(mark), 1.0, Role::Ink, 0.7);
        }
    }
    let reach_px = model.covered_px();
    let around = (0..=NUM_SIDES).map(|side| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(NUM_SIDES);
        let [u, v] = MIDDLE_PX;
        panel.canvas_from_world((
            u + reach_px * libm::cos(angle),
            v + reach_px * libm::sin(angle),
        ))
    });
    let circle: Vec<Place> = around.collect();
    canvas.polyline(&circle, Stroke::solid(Role::Muted, 1.25).dashed());
    canvas.grip(panel.canvas_from_world(model.place()), Role::Grip);
}

/// Shades the radii beyond the farthest mark.
fn draw_uncovered(model: &Coverage, panel: &Panel, canvas: &mut Canvas) {
    let reach_px = model.covered_px();
    let from = panel.canvas_from_world((reach_px, 0.0)).0;
    let rect = panel.rect.inset(1.0);
    let beyond = Rect::new(from, rect.y, (rect.right() - from).max(0.0), rect.height);
    canvas.fill_rect(beyond, Role::Muted, 0.16);

    let style = TextStyle::new(Role::Muted, SMALL).cased();
    let y = rect.bottom() - 12.0;
    let places = [
        ((from + 5.0, y), Align::Start),
        ((from - 5.0, y), Align::End),
    ];
    Labels::new(rect).draw(canvas, &places, "boards end", style);
}

/// Draws the true displacement, and the estimated one with its band.
fn draw_curves(found: Option<&Found>, panel: &Panel, canvas: &mut Canvas) {
    let radii = radii_px();
    if let Some(found) = found {
        let edge = |sign: f64| {
            radii.iter().zip(&found.curve).map(move |(x, [px, sigma])| {
                // Far outside of the panel, coordinates of any size have the same picture.
                panel.canvas_from_world((*x, (px + sign * sigma).clamp(-2e3, 2e3)))
            })
        };
        let band: Vec<Place> = edge(1.0).chain(edge(-1.0).rev()).collect();
        canvas.clipped(panel.rect.inset(1.0), |canvas| {
            canvas.polygon(&band, FOUND, 0.25)
        });
        let curve = radii.into_iter().zip(found.curve.iter().map(|[px, _]| *px));
        plot::draw_curve(canvas, panel, curve, Stroke::solid(FOUND, 2.5));
    }
    plot::draw_curve(canvas, panel, radii.into_iter().zip(true_curve()), TRUTH);
}

/// Draws the true focal length, and the estimated one with its interval.
fn draw_focal(found: Option<&Found>, panel: &Panel, canvas: &mut Canvas) {
    plot::draw_curve(canvas, panel, [(0.0, FOCAL_PX), (1.0, FOCAL_PX)], TRUTH);
    let Some(found) = found else { return };
    let at = |focal_px: f64| panel.canvas_from_world((0.5, focal_px));
    let ends = [-1.0, 1.0].map(|sign| at(found.focal_px + sign * found.focal_std_px));
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        let stroke = Stroke::solid(FOUND, 2.5);
        canvas.line(ends[0], ends[1], stroke);
        for (x, y) in ends {
            canvas.line((x - 7.0, y), (x + 7.0, y), stroke);
        }
        canvas.marker(at(found.focal_px), 4.5, Shape::Disk, FOUND, true);
    });
}
