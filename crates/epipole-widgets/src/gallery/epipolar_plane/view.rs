//! The 3D view with both photographs, the same photographs beside it, and below it the formula of
//! the highlighted element.

mod space;
mod style;

use self::space::{cloud, draw_space};
use self::style::{LINE, LIT, lines};
use super::model::{EpipolarPlane, Lit, SPACE_ASPECT};
use super::scenery::Scenery;
use super::words::{NO_BASELINE, ON_BASELINE};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, SMALL, TEXT, TITLE};
use crate::kit::labels::Labels;
use crate::kit::orbit::Orbit;
use crate::kit::pair::{CAMERAS, Photos, border_arrow, draw_epipole, draw_line};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE, in_picture};
use crate::theme::{Rgb, Role};
use nalgebra::{Point2, Point3};

/// Rows of photograph 1 whose lines are drawn to show that all pass through the epipole.
const PENCIL_ROWS: [f64; 7] = [0.0, 80.0, 160.0, 240.0, 320.0, 400.0, 479.0];
const FORMULA: f64 = 26.0;

/// Draws [`EpipolarPlane`].
#[derive(Default)]
pub(crate) struct EpipolarPlaneView {
    photos: Photos,
    cloud: Vec<(Point3<f64>, Rgb)>,
}

/// Lays out the 3D view and the two photographs.
fn cells(grid: &mut Grid, width: f64) -> (Rect, [Rect; 2]) {
    let aspect = PHOTO_ASPECT;
    if grid::is_narrow(width) {
        let [space] = grid.row([SPACE_ASPECT], 400.0);
        return (space, grid.row([aspect; 2], 106.0));
    }
    // Two photographs in a column are as tall as the 3D view.
    let between = GAP + TITLE;
    let room = width - GAP + between / (2.0 * aspect);
    let height = room / (1.0 / SPACE_ASPECT + 1.0 / (2.0 * aspect));
    let photo = (height - between) / 2.0 / aspect;
    let [space, column] = grid.shares([width - GAP - photo, photo], height);
    (space, grid::stack(column, [1.0; 2]))
}

impl View for EpipolarPlaneView {
    type Model = EpipolarPlane;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &EpipolarPlane, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (space, [first, second]) = cells(&mut grid, width);
        grid.strip(FORMULA);
        let photograph = |id, rect| Panel::photograph(id, rect, PHOTO_SIZE);
        let first = photograph("first", first).clickable();
        let panels = vec![Orbit::panel(space), first, photograph("second", second)];
        grid.layout(panels)
    }

    fn draw(&mut self, model: &EpipolarPlane, layout: &Layout, canvas: &mut Canvas) {
        let space_titles = [
            "Both cameras and what they see: drag to turn, or take P or a camera",
            "Drag to turn; take P or a camera",
        ];
        let titles: [(_, &[_]); 3] = [
            ("space", &space_titles),
            ("first", &["Photograph 1: drag p", "1: drag p"]),
            ("second", &["Photograph 2", "2"]),
        ];
        let [space, first, second] = grid::open_all(canvas, layout, titles);
        let Some(scenery) = model.scenery() else {
            return grid::notice(canvas, space.rect, "A camera cannot stand there.");
        };
        let Self { photos, cloud } = self;
        let pictures = match photos.pictures(&scenery.cameras) {
            Ok(pictures) => pictures,
            Err(error) => return grid::notice(canvas, space.rect, &error.to_string()),
        };
        for (panel, picture) in [first, second].into_iter().zip(pictures) {
            canvas.photograph(panel.rect, picture);
        }
        draw_space(model, scenery, cloud, pictures, space, canvas);
        canvas.clipped(first.rect, |canvas| {
            draw_first(model, scenery, first, canvas)
        });
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, scenery, second, canvas)
        });
        match (&scenery.geometry, &scenery.plane) {
            (None, _) => grid::notice(canvas, space.rect, NO_BASELINE),
            (_, None) => grid::notice(canvas, space.rect, ON_BASELINE),
            _ => draw_formula(model, layout, canvas),
        }
    }

    fn prepare(&mut self, model: &EpipolarPlane) -> bool {
        let scenery = model.scenery();
        scenery.is_some_and(|scenery| self.photos.prepare(&scenery.cameras))
    }

    fn refine(&mut self, model: &EpipolarPlane) -> bool {
        let Some(scenery) = model.scenery() else {
            return false;
        };
        if self.cloud.is_empty() {
            self.cloud = cloud();
            return true;
        }
        self.photos.refine(&scenery.cameras)
    }
}

fn draw_pencil(
    model: &EpipolarPlane,
    scenery: &Scenery,
    index: usize,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let is_lit = model.lit() == Lit::Epipole;
    let Some(geometry) = scenery.geometry.as_ref().filter(|_| is_lit) else {
        return;
    };
    for row in PENCIL_ROWS {
        let pixel = Point2::new(320.0, row);
        let line = match index {
            0 => geometry.line1(&pixel),
            _ => geometry.line2(&pixel),
        };
        if let Some(line) = line {
            draw_line(canvas, panel, &line, Stroke::solid(LINE, 1.0).cased());
        }
    }
}

fn draw_first(model: &EpipolarPlane, scenery: &Scenery, panel: &Panel, canvas: &mut Canvas) {
    let lit = model.lit();
    draw_pencil(model, scenery, 0, panel, canvas);
    let mut labels = Labels::new(panel.rect);
    if let Some(line) = &lines(scenery, lit)[0] {
        let is_lit = matches!(lit, Lit::Line | Lit::Plane);
        let (from, to) = draw_line(canvas, panel, line, line_stroke(is_lit).cased());
        labels.keep_line_free(from, to);
    }
    let Some(pixel) = scenery.pixels[0] else {
        return grid::notice(canvas, panel.rect, "P is behind camera 1.");
    };
    let place = panel.place_of(&pixel);
    canvas.grip(place, Role::Grip);
    labels.keep_free(place, 10.0);
    if let Some(geometry) = scenery.geometry.as_ref().filter(|_| lit == Lit::Epipole) {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole1, "e");
    }
    draw_name(canvas, &mut labels, place, "p", lit == Lit::Point);
}

fn draw_second(model: &EpipolarPlane, scenery: &Scenery, panel: &Panel, canvas: &mut Canvas) {
    let lit = model.lit();
    draw_pencil(model, scenery, 1, panel, canvas);
    let mut labels = Labels::new(panel.rect);
    if let Some(line) = &lines(scenery, lit)[1] {
        let is_lit = matches!(lit, Lit::Line | Lit::Plane);
        let (from, to) = draw_line(canvas, panel, line, line_stroke(is_lit).cased());
        labels.keep_line_free(from, to);
    }
    let off_surface = scenery.before_surface_m() != Some(0.0);
    let surface = scenery.surface.filter(|_| off_surface);
    let surface = surface.and_then(|surface| surface.pixel2);
    let mut ring = None;
    if let Some(pixel) = surface.filter(in_picture) {
        let place = panel.place_of(&pixel);
        canvas.marker(place, 6.0, Shape::Ring, Role::Ink, true);
        labels.keep_free(place, 8.0);
        ring = Some(place);
    }
    let image = scenery.pixels[1].map(|pixel| panel.place_of(&pixel));
    match image {
        Some(place) if panel.rect.contains(place) => {
            let radius = if lit == Lit::Point { 6.5 } else { 5.0 };
            canvas.marker(place, radius, CAMERAS[1].1, CAMERAS[1].0, true);
            labels.keep_free(place, 8.0);
        }
        Some(place) => {
            if let Some((from, to)) = border_arrow(panel.rect, place) {
                canvas.arrow(from, to, Stroke::solid(CAMERAS[1].0, 2.5).cased());
            }
        }
        None => grid::notice(canvas, panel.rect, "P is behind camera 2."),
    }
    if let Some(geometry) = scenery.geometry.as_ref().filter(|_| lit == Lit::Epipole) {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole2, "e′");
    }
    if let Some(place) = image {
        let room = panel.rect.inset(8.0);
        let x = place.0.min(room.right()).max(room.x);
        let inside = (x, place.1.min(room.bottom()).max(room.y));
        draw_name(canvas, &mut labels, inside, "p′", lit == Lit::Point);
    }
    // On a phone there is no room for text.
    if let Some(place) = ring.filter(|_| panel.rect.width > 200.0) {
        labels.name(
            canvas,
            (place, 9.0),
            "surface that p sees",
            (Role::Ink, SMALL),
        );
    }
}

fn line_stroke(is_lit: bool) -> Stroke {
    Stroke::solid(LINE, if is_lit { 3.0 } else { 1.5 })
}

fn draw_name(canvas: &mut Canvas, labels: &mut Labels, place: Place, name: &str, is_lit: bool) {
    let role = if is_lit { LIT } else { Role::Ink };
    labels.name(canvas, (place, 10.0), name, (role, TEXT + 1.0));
}

/// Vertical position of a piece of a formula.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Level {
    Base,
    Raised,
    Lowered,
}

/// A piece of a formula: its text, its level, and the elements that highlight it.
type Piece = (&'static str, Level, &'static [Lit]);

/// Returns the formula of the highlighted element.
fn formula(lit: Lit) -> &'static [Piece] {
    use Level::{Base, Lowered, Raised};
    const T: Piece = ("T", Raised, &[]);
    const C: Piece = ("c", Lowered, &[]);
    match lit {
        Lit::Point => &[
            ("p", Base, &[Lit::Point]),
            (" ~ K P,  ", Base, &[]),
            ("p′", Base, &[Lit::Point]),
            (" ~ K (R P + t)", Base, &[]),
        ],
        Lit::Baseline => &[
            ("x′", Base, &[]),
            C,
            T,
            (" · (", Base, &[]),
            ("t", Base, &[Lit::Baseline]),
            (" × R x", Base, &[]),
            C,
            (") = 0", Base, &[]),
        ],
        Lit::Plane => &[
            ("x′", Base, &[]),
            C,
            T,
            (" · ", Base, &[]),
            ("(t × R x", Base, &[Lit::Plane]),
            ("c", Lowered, &[Lit::Plane]),
            (")", Base, &[Lit::Plane]),
            (" = 0", Base, &[]),
        ],
        Lit::Line => &[("l′", Base, &[Lit::Line]), (" = F x", Base, &[])],
        Lit::Epipole => &[
            ("F ", Base, &[]),
            ("e", Base, &[Lit::Epipole]),
            (" = 0,  F", Base, &[]),
            T,
            (" ", Base, &[]),
            ("e′", Base, &[Lit::Epipole]),
            (" = 0", Base, &[]),
        ],
    }
}

fn draw_formula(model: &EpipolarPlane, layout: &Layout, canvas: &mut Canvas) {
    const SIZE: f64 = 16.0;
    const SMALLER: f64 = 11.0;
    let lit = model.lit();
    let (mut x, y) = (0.0, layout.height - FORMULA / 2.0 + 1.0);
    for (text, level, lights) in formula(lit) {
        let (size, down) = match level {
            Level::Base => (SIZE, 0.0),
            Level::Raised => (SMALLER, -5.0),
            Level::Lowered => (SMALLER, 4.0),
        };
        let is_lit = lights.contains(&lit);
        let role = if is_lit { LIT } else { Role::Ink };
        let gap = if *level == Level::Base { 0.0 } else { 1.0 };
        let width = text_width(text, size) + gap;
        canvas.label((x, y + down), text, TextStyle::new(role, size));
        if is_lit {
            canvas.fill_rect(Rect::new(x, y + 10.0, width, 2.0), LIT, 1.0);
        }
        x += width;
    }
    let words = match lit {
        Lit::Point => "the images of P",
        Lit::Baseline => "t leads from camera to camera",
        Lit::Plane => "the normal of the plane",
        Lit::Line => "where the plane cuts photograph 2",
        Lit::Epipole => "where the baseline meets each image",
    };
    let meaning = format!("{words}: {}", model.meaning());
    let place = x + 18.0;
    let room = layout.width - place;
    let fits = |text: &str| text_width(text, TEXT) <= room;
    let text = if fits(&meaning) {
        meaning
    } else {
        model.meaning()
    };
    let text = if fits(&text) { text } else { words.to_owned() };
    canvas.label((place, y), &text, TextStyle::new(Role::Muted, TEXT));
}
