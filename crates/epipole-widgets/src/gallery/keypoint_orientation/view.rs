//! The photograph with the window; the window after the rotation with its gradients; their
//! histogram; and the normalized patch before and after.

use super::gradients::{NUM_BINS, RADIUS_SIGMAS, SHOWN_PX, Surroundings, bin_of, options};
use super::model::KeypointOrientation;
use crate::canvas::{Canvas, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::features::SIZE;
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::Heat;
use crate::kit::labels::Labels;
use crate::kit::patch::{self, Spot};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;
use image::RgbImage;

/// Height over width of the photograph.
const ASPECT: f64 = grid::aspect(SIZE);
/// Height of the window's row, and of the row below it, CSS pixels: on a phone and on wider pages.
const ROWS: [[f64; 2]; 2] = [[150.0, 156.0], [250.0, 140.0]];
/// Total height on a wide page, CSS pixels.
const BROAD: f64 = 408.0;
/// Spacing of arrows in small panels and in others, CSS pixels.
const APART: [f64; 2] = [8.0, 15.0];
/// Width below which a panel is small, CSS pixels.
const SMALL_PANEL: f64 = 200.0;
/// Length of the longest arrow relative to their spacing.
const LONGEST: f64 = 1.6;
/// Length below which arrows are omitted, CSS pixels.
const SHORTEST: f64 = 3.0;
/// End of an orientation's hand, relative to the radius of the window.
const HAND: f64 = 1.28;
/// Height of the histogram relative to its highest bin.
const HEADROOM: f64 = 1.2;
/// Roles of the gradients of the first and of the second orientation.
const PEAKS: [Role; 2] = [Role::Best, Role::Outlier];
/// Names of a single peak, and of two.
const NAMES: [&[&str]; 2] = [&["orientation"], &["first", "second"]];

/// Draws [`KeypointOrientation`].
#[derive(Default)]
pub(crate) struct KeypointOrientationView {
    pictures: Heat<3>,
}

fn rulers() -> [Ruler; 2] {
    [
        Ruler::linear(-190.0, 180.0).named("direction (0° right, 90° down)"),
        Ruler::bare(0.0, HEADROOM),
    ]
}

impl View for KeypointOrientationView {
    type Model = KeypointOrientation;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &KeypointOrientation, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photograph, window, histogram, patches);
        if grid::is_broad(width) {
            // The photograph with both patches below it is as tall as the window.
            let [left, middle, right] = grid.row([1.36, 1.0, 1.1], BROAD);
            let above = left.width * ASPECT;
            photograph = Rect {
                height: above,
                ..left
            };
            let top = left.y + above + grid::GAP + grid::TITLE;
            patches = grid::columns(
                Rect::new(left.x, top, left.width, left.bottom() - top),
                [1.0; 2],
            );
            (window, histogram) = (middle, right);
        } else {
            let [above, below] = ROWS[usize::from(!grid::is_narrow(width))];
            [photograph, window] = grid.row([ASPECT, 1.0], above);
            let side = match grid::is_narrow(width) {
                true => (below - grid::GAP - grid::TITLE) / 2.0,
                false => 2.0 * below + grid::GAP,
            };
            let [left, right] = grid.shares([width - grid::GAP - side, side], below);
            histogram = left;
            patches = match grid::is_narrow(width) {
                true => grid::stack(right, [1.0; 2]),
                false => grid::columns(right, [1.0; 2]),
            };
        }
        let [direction, count] = rulers();
        let around = f64::from(SHOWN_PX) + 0.5;
        let square = |rect: Rect| {
            let side = rect.width.min(rect.height);
            Rect::new(rect.x, rect.y, side, side)
        };
        let mut panels = vec![
            Panel::photograph("photograph", photograph, SIZE).clickable(),
            Panel::new(
                "window",
                square(window),
                [-around, around],
                [-around, around],
            ),
            plot::panel("histogram", histogram, &direction, &count),
        ];
        for (id, rect) in ["before", "after"].into_iter().zip(patches) {
            panels.push(Panel::photograph(id, square(rect), (1, 1)));
        }
        grid.layout(panels)
    }

    fn photograph(&mut self, model: &KeypointOrientation, panel: &str) -> Option<RgbImage> {
        let picture = model.asked.answer().filter(|_| panel == "photograph")?;
        Some(picture.image().clone())
    }

    fn draw(&mut self, model: &KeypointOrientation, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 4] = [
            (
                "photograph",
                &["Photograph: drag the keypoint", "Drag the keypoint"],
            ),
            (
                "window",
                &["Turned: the gradients in its window", "Turned: gradients"],
            ),
            (
                "before",
                &["Patch before the turn", "Patch before", "Before"],
            ),
            ("after", &["Patch after the turn", "Patch after", "After"]),
        ];
        let [photograph, window, before, after] = grid::open_all(canvas, layout, titles);
        let titles = ["Histogram of the gradients' directions", "36 directions"];
        let histogram = plot::open(canvas, layout, "histogram", &titles, &rulers());
        let (Some(picture), Some(found)) = (model.asked.answer(), model.found()) else {
            return grid::notice(canvas, photograph.rect, model.asked.stand_in());
        };
        canvas.photograph(photograph.rect, picture.image());
        let angle_rad = found[0].peaks_rad.first().copied().unwrap_or(0.0);
        let (u, v) = model.keypoint.place();
        let spot = Spot {
            place: [u, v],
            ..found[0].spot(angle_rad)
        };
        let outline = Stroke::solid(Role::Grip, 2.0).cased();
        patch::draw_window(canvas, photograph, &spot, outline);
        canvas.grip(photograph.canvas_from_world((u, v)), Role::Grip);
        let pictures = (self.pictures).maps(model.version(), canvas.theme(), || {
            let [before, after] = found.each_ref().map(Surroundings::normalized);
            [found[1].picture(), before, after]
        });
        for (panel, picture) in [window, before, after].into_iter().zip(pictures) {
            canvas.photograph(panel.rect, picture);
        }
        draw_window(&found[1], window, canvas);
        draw_histogram(&found[1], histogram, canvas);
    }
}

/// Returns the role of the peak that a bin belongs to, itself or a neighbor.
fn role_of(found: &Surroundings, bin: usize) -> Option<Role> {
    let is_near = |peak_rad: &f64| {
        let apart = bin_of(*peak_rad).abs_diff(bin);
        apart.min(NUM_BINS - apart) <= 1
    };
    let index = found.peaks_rad.iter().position(is_near)?;
    PEAKS.get(index).copied()
}

/// Draws the gradients in their window, and a hand for each orientation.
fn draw_window(found: &Surroundings, panel: &Panel, canvas: &mut Canvas) {
    let scale = panel.scale_x();
    let apart = APART[usize::from(panel.rect.width >= SMALL_PANEL)];
    let step = (apart / scale).round().max(1.0);
    let gradients = found.gradients(step as u32);
    let longest = gradients.iter().map(|g| g.length()).fold(1e-9, f64::max);
    let per_level = LONGEST * step * scale / longest;
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        let middle = panel.canvas_from_world((0.0, 0.0));
        let radius = RADIUS_SIGMAS * found.scale_px() * scale;
        canvas.circle(middle, radius, Stroke::solid(Role::Grip, 2.0).cased());
        for gradient in &gradients {
            let length = per_level * gradient.length();
            if length < SHORTEST {
                continue;
            }
            let from = panel.canvas_from_world(gradient.offset);
            let (du, dv) = gradient.weighted;
            let to = (from.0 + per_level * du, from.1 + per_level * dv);
            let role = role_of(found, gradient.bin()).unwrap_or(Role::Ink);
            canvas.arrow(from, to, Stroke::solid(role, 1.25).cased());
        }
        for (&angle_rad, role) in found.peaks_rad.iter().zip(PEAKS) {
            let at = |distance: f64| {
                let (sin, cos) = (libm::sin(angle_rad), libm::cos(angle_rad));
                (middle.0 + distance * cos, middle.1 + distance * sin)
            };
            canvas.arrow(
                at(radius),
                at(HAND * radius),
                Stroke::solid(role, 3.0).cased(),
            );
        }
    });
}

/// Draws the bins, the line at 80% of the highest, and the names of the peaks.
fn draw_histogram(found: &Surroundings, panel: &Panel, canvas: &mut Canvas) {
    let highest = found.histogram.iter().copied().fold(1e-9, f32::max);
    let share = |bin: usize| f64::from(found.histogram[bin] / highest);
    let degrees = |bin: usize| 10.0 * bin as f64 - 180.0;
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for bin in 0..NUM_BINS {
        let [low, high] = [-4.2, 4.2].map(|aside| degrees(bin) + aside);
        let bar = panel.rect_between((low, share(bin)), (high, 0.0));
        canvas.fill_rect(bar, role_of(found, bin).unwrap_or(Role::Reference), 0.9);
        labels.keep_rect_free(bar);
    }
    let ratio = f64::from(options().orientation_peak_ratio);
    let [from, to] = [-190.0, 180.0].map(|x| panel.canvas_from_world((x, ratio)));
    let line = Stroke::solid(Role::Ink, 1.25).dashed();
    canvas.line(from, to, line);
    labels.keep_line_free(from, to);
    let names = NAMES[usize::from(found.peaks_rad.len() > 1)];
    for ((&angle_rad, role), name) in found.peaks_rad.iter().zip(PEAKS).zip(names) {
        let top = share(bin_of(angle_rad));
        let place = panel.canvas_from_world((angle_rad.to_degrees(), top));
        labels.name(canvas, (place, 2.0), name, (role, SMALL));
    }
    let style = TextStyle::new(Role::Muted, SMALL).end();
    canvas.label((panel.rect.x - 4.0, from.1), "80%", style);
}
