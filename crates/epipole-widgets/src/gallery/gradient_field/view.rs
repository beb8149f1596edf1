//! The image with an arrow per pixel or cell; beside it the same image as a surface, or slope and
//! noise of the edge over the smoothing.

use super::field::{Arrow, Field, GRID};
use super::model::{Beside, GradientField, SIGMA};
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Swatch};
use crate::kit::orbit::Orbit;
use crate::kit::plot::{self, Ruler};
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::{Role, mix};
use nalgebra::Point3;

/// Maximum height of image and surface, CSS pixels.
const TALLEST: f64 = 328.0;
/// Height of image and surface on a phone, CSS pixels.
const PHONE: [f64; 2] = [168.0, 122.0];
/// Gradient drawn about one cell long, gray levels per pixel: on the edge, and in a photograph.
const FULL: [f64; 2] = [22.0, 60.0];
/// Fraction of [`FULL`] below which a gradient is drawn as a dot.
const FAINT: f64 = 0.12;
/// Height of 255 gray levels on the surface, in pixels of the image.
const HIGH: f64 = 11.0;
const ARROW: Role = Role::Series(0);
const NOISE: Role = Role::Series(1);
const SLOPE: Role = Role::Series(2);
/// Range of the plot, powers of ten.
const DECADES: [f64; 2] = [-1.0, 1.5];

fn rulers() -> [Ruler; 2] {
    [
        Ruler::linear(0.0, SIGMA.max).named("smoothing σ, pixels"),
        Ruler::decades(DECADES[0], DECADES[1]),
    ]
}

/// Draws [`GradientField`].
#[derive(Default)]
pub(crate) struct GradientFieldView;

impl View for GradientFieldView {
    type Model = GradientField;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &GradientField, width: f64) -> Layout {
        let (columns, rows) = model.size();
        let aspect = f64::from(rows) / f64::from(columns);
        let mut grid = Grid::new(width);
        let (image, beside);
        if grid::is_narrow(width) {
            [image] = grid.row([aspect], PHONE[0]);
            [beside] = grid.shares([1.0], PHONE[1]);
        } else {
            // On a wide page both fill the width and leave room for a caption.
            let of_beside = if grid::is_broad(width) { 0.515 } else { 0.75 };
            [image, beside] = grid.row([aspect, of_beside], TALLEST);
        }
        grid.strip(legend::height(&entries(), width, 0.0) + 4.0);
        let image = Panel::photograph("image", image, (columns, rows)).clickable();
        let [x, y] = rulers();
        let beside = match model.beside() {
            Beside::Surface => Orbit::panel(beside),
            Beside::Curve => plot::panel("plot", beside, &x, &y),
        };
        grid.layout(vec![image, beside])
    }

    fn draw(&mut self, model: &GradientField, layout: &Layout, canvas: &mut Canvas) {
        let (image, beside) = (&layout.panels[0], &layout.panels[1]);
        let narrow = grid::is_narrow(layout.width);
        grid::open(canvas, image, &["Image and gradient"]);
        legend::draw_last(canvas, &entries(), layout, 0.0, 0.0);
        let field = model.field();
        if let Ok(field) = field {
            match model.edge() {
                Some(_) => draw_pixels(field, image, canvas),
                None => canvas.photograph(image.rect, field.picture()),
            }
            canvas.clipped(image.rect, |canvas| {
                draw_arrows(model, field, image, canvas)
            });
        }
        match model.beside() {
            Beside::Surface => {
                let wordings = [
                    "The same as a surface: bright is high, drag to turn",
                    "As a surface",
                ];
                grid::open(canvas, beside, &wordings[usize::from(narrow)..]);
                if let Ok(field) = field {
                    draw_surface(model, field, beside, canvas);
                }
            }
            Beside::Curve => {
                let wordings = [
                    "Slope of the edge and noise of a slope, gray levels a pixel",
                    "Gray levels a pixel",
                ];
                let from_left = Rect::new(image_free(beside), beside.rect.y, layout.width, 1.0);
                grid::fitting_title(canvas, from_left, &wordings[usize::from(narrow)..]);
                draw_curves(model, beside, canvas);
            }
        }
        if let Some(sentence) = field.err().or(model.problem()) {
            grid::notice(canvas, image.rect, sentence);
        }
    }
}

/// Returns the left end of a plot's axis labels, CSS pixels.
fn image_free(plot: &Panel) -> f64 {
    plot.rect.x - plot::LEFT
}

fn entries() -> [legend::Entry; 2] {
    let edge = Stroke::solid(Role::Truth, 2.0).dashed();
    [
        (Swatch::Line(Stroke::solid(ARROW, 2.0)), "gradient"),
        (Swatch::Line(edge), "edge through the probe"),
    ]
}

/// Draws each pixel of the edge as a square.
fn draw_pixels(field: &Field, panel: &Panel, canvas: &mut Canvas) {
    let side = panel.scale_x();
    canvas.clipped(panel.rect, |canvas| {
        for (u, v, color) in field.picture().enumerate_pixels() {
            let (x, y) = panel.canvas_from_world((f64::from(u) - 0.5, f64::from(v) - 0.5));
            // Squares overlap slightly, to avoid visible seams.
            let square = Rect::new(x, y, side + 0.5, side + 0.5);
            canvas.fill_color(square, color.0);
        }
    });
}

/// Draws an arrow per pixel or cell, and the probe's own with the edge across it.
fn draw_arrows(model: &GradientField, field: &Field, panel: &Panel, canvas: &mut Canvas) {
    let is_edge = model.edge().is_some();
    let cell = panel.rect.width / f64::from(GRID.0);
    let full = FULL[usize::from(!is_edge)];
    let stroke = Stroke::solid(ARROW, if cell > 14.0 { 1.5 } else { 1.0 });
    let casing = Stroke::solid(Role::Halo, stroke.width + 2.0);
    let ends = |arrow: &Arrow, longer: f64| {
        let from = panel.canvas_from_world(arrow.at);
        let share = longer * cell / full;
        (from, (from.0 + share * arrow.du, from.1 + share * arrow.dv))
    };
    for arrow in field.arrows() {
        let (from, to) = ends(arrow, 0.95);
        if arrow.magnitude() < FAINT * full {
            canvas.disk(from, 1.0, ARROW, 0.8);
            continue;
        }
        canvas.line(from, to, casing);
        canvas.arrow(from, to, stroke);
    }
    if !is_edge {
        let (left, top) = model.surface_from();
        let corner =
            |u: u32, v: u32| panel.canvas_from_world((f64::from(u) - 0.5, f64::from(v) - 0.5));
        let (a, b) = (corner(left, top), corner(left + GRID.0, top + GRID.1));
        let frame = Rect::new(a.0, a.1, b.0 - a.0, b.1 - a.1);
        canvas.stroke_rect(frame, Stroke::solid(Role::Grip, 1.5).cased());
    }
    let place = panel.canvas_from_world(model.probe.place());
    if let Some(arrow) = model.probed() {
        let (_, to) = ends(&arrow, if is_edge { 2.6 } else { 3.5 });
        let (du, dv) = (to.0 - place.0, to.1 - place.1);
        let length = libm::hypot(du, dv);
        if length > 4.0 {
            let across = (-dv / length * 3.2 * cell, du / length * 3.2 * cell);
            let edge = Stroke::solid(Role::Truth, 2.0).dashed().cased();
            let end = |sign: f64| (place.0 + sign * across.0, place.1 + sign * across.1);
            canvas.line(end(-1.0), end(1.0), edge);
            canvas.arrow(place, to, Stroke::solid(Role::Grip, 3.0).cased());
        }
    }
    canvas.grip(place, Role::Grip);
}

/// Draws gray levels as heights, with the steepest ascent at the probe.
fn draw_surface(model: &GradientField, field: &Field, panel: &Panel, canvas: &mut Canvas) {
    let (left, top) = model.surface_from();
    let (width, height) = field.size();
    let (columns, rows) = (GRID.0.min(width), GRID.1.min(height));
    let middle = (f64::from(columns - 1) / 2.0, f64::from(rows - 1) / 2.0);
    // Down in the image is toward the reader.
    let point = |u: f64, v: f64, level: f64| {
        let up = (level - 128.0) * HIGH / 255.0;
        Point3::new(
            u - f64::from(left) - middle.0,
            -up,
            middle.1 - (v - f64::from(top)),
        )
    };
    let subject = Subject {
        // Below the surface, so that the handle that moves the scene does not cover the probe.
        middle: Point3::new(0.0, 3.0, 0.0),
        radius: 0.29 * f64::from(columns + rows),
    };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    let corner = |u: u32, v: u32| point(f64::from(u), f64::from(v), field.level((u, v)));
    let [dark, bright] = [[16, 18, 24], [250, 248, 240]];
    let outline = Stroke::solid(Role::Reference, 0.5);
    for v in top..top + rows - 1 {
        for u in left..left + columns - 1 {
            let pixels = [(u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)];
            let mean = pixels.map(|pixel| field.level(pixel)).iter().sum::<f64>() / 4.0;
            let share = (mean / 255.0).clamp(0.0, 1.0) as f32;
            let corners = pixels.map(|(u, v)| corner(u, v));
            space.facet(corners, mix(dark, bright, share), outline);
        }
    }
    let mut marks = None;
    let mut axes = Vec::new();
    if let Some(arrow) = model.probed() {
        let (u, v) = arrow.at;
        let level = field.level((u as u32, v as u32));
        let magnitude = arrow.magnitude();
        let from = space.place(&point(u, v, level));
        let reach = 3.5 / magnitude.max(1e-9);
        let rise = 3.5 * magnitude;
        let to = space.place(&point(
            u + reach * arrow.du,
            v + reach * arrow.dv,
            level + rise,
        ));
        marks = from
            .zip(to)
            .map(|(from, to)| (from.0, to.0, magnitude > 1.0));
    }
    let (far_u, far_v) = (f64::from(left + columns), f64::from(top + rows));
    let (near_u, near_v) = (f64::from(left), f64::from(top));
    for (name, from, to) in [
        ("u", (near_u, far_v), (near_u + 6.0, far_v)),
        ("v", (far_u, near_v), (far_u, near_v + 6.0)),
    ] {
        let ends = [from, to].map(|(u, v)| space.place(&point(u, v, 80.0)));
        if let [Some((from, _)), Some((to, _))] = ends {
            axes.push((name, from, to));
        }
    }
    space.draw(canvas, panel);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        if let Some((from, to, is_steep)) = marks {
            if is_steep {
                canvas.arrow(from, to, Stroke::solid(Role::Grip, 3.0).cased());
            }
            canvas.marker(from, 4.5, Shape::Disk, Role::Grip, true);
        }
        for (name, from, to) in axes {
            canvas.arrow(from, to, Stroke::solid(Role::Ink, 1.5));
            let beyond = (to.0 + 0.25 * (to.0 - from.0), to.1 + 0.25 * (to.1 - from.1));
            canvas.label(
                beyond,
                name,
                TextStyle::new(Role::Ink, SMALL).middle().cased(),
            );
        }
    });
    draw_handles(canvas, panel, &model.orbit);
}

/// Draws slope and noise over the smoothing, and marks the current smoothing.
fn draw_curves(model: &GradientField, panel: &Panel, canvas: &mut Canvas) {
    let [x, y] = rulers();
    plot::draw_axes(canvas, panel, &x, &y);
    let sigmas = (0..=45).map(|step| SIGMA.min + f64::from(step) * 0.1);
    let start = std::iter::once((0.0, model.quality(None)));
    let curve: Vec<_> = start
        .chain(sigmas.map(|sigma| (sigma, model.quality(Some(sigma)))))
        .collect();
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let now = model.smooth_px().unwrap_or(0.0);
    plot::draw_now(canvas, panel, now);
    let height = |value: f64| plot::decade(value).clamp(-9.0, 9.0);
    let kinds = [
        ("slope", Stroke::solid(SLOPE, 2.5), Shape::Disk),
        ("noise", Stroke::solid(NOISE, 2.5).dotted(), Shape::Square),
    ];
    for (value, (_, stroke, _)) in kinds.iter().enumerate() {
        let places = curve.iter().filter_map(|(sigma, quality)| {
            let quality = (*quality)?;
            Some((*sigma, height([quality.slope, quality.noise][value])))
        });
        let places: Vec<_> = places.collect();
        for pair in places.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|place| panel.canvas_from_world(place));
            labels.keep_line_free(from, to);
        }
        plot::draw_curve(canvas, panel, places, *stroke);
    }
    let Some(quality) = model.quality(model.smooth_px()) else {
        return;
    };
    for ((name, stroke, shape), value) in kinds.into_iter().zip([quality.slope, quality.noise]) {
        let at = height(value);
        if (DECADES[0]..=DECADES[1]).contains(&at) {
            let place = panel.canvas_from_world((now, at));
            canvas.marker(place, 5.0, shape, stroke.role, true);
            labels.name(canvas, (place, 7.0), name, (stroke.role, SMALL));
        }
    }
}
