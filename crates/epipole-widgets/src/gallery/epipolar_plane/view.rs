//! The space with both photographs standing in it; beside it the same photographs flat; below, the
//! formula in which what is lit up is lit up, too.

use super::model::{EpipolarPlane, Lit, SPACE_ASPECT, SUBJECT};
use super::scenery::{Plane, Scenery};
use super::words::{NO_BASELINE, ON_BASELINE};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Model, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, SMALL, TEXT, TITLE};
use crate::kit::labels::Labels;
use crate::kit::orbit::Orbit;
use crate::kit::pair::{border_arrow, draw_epipole, draw_line};
use crate::kit::photo::Photo;
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, still_life};
use crate::kit::space::{Space, draw_handles};
use crate::theme::{Rgb, Role};
use epipole::camera::{Camera, look_at};
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use epipole::synthetic::{Sampling, still_life_camera};
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector3};

/// The photographs stand so far before their centers, meters.
const PICTURE_M: f64 = 0.58;
/// The sheet of the plane reaches so far from the baseline, and beyond its ends, meters.
const SHEET_M: f64 = 1.75;
const BEYOND_M: f64 = 0.12;
/// A line towards an epipole ends so far from its center, meters.
const TOWARDS_M: f64 = 3.0;
/// Columns and rows of the picture whose pixels become the cloud of the still life.
const CLOUD: (u32, u32) = (100, 75);
/// From where to where they look, and which way is up.
const CLOUD_SEEN: [[f64; 3]; 3] = [[0.0, -0.95, -1.1], [0.03, -0.12, 0.0], [0.0, -1.0, 0.0]];
/// Walls are left out: the cloud ends so far away.
const CLOUD_END_Z_M: f64 = 0.62;
const LIT: Role = Role::Series(3);
const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(2), Shape::Square),
];
/// Rows of photograph 1 whose lines are drawn to show that all pass through the epipole.
const PENCIL_ROWS: [f64; 7] = [0.0, 80.0, 160.0, 240.0, 320.0, 400.0, 479.0];
const FORMULA: f64 = 26.0;

/// Draws [`EpipolarPlane`].
#[derive(Default)]
pub(crate) struct EpipolarPlaneView {
    photos: [Photo; 2],
    cloud: Vec<(Point3<f64>, Rgb)>,
}

/// The space and the two photographs.
fn cells(grid: &mut Grid, width: f64) -> (Rect, [Rect; 2]) {
    let aspect = f64::from(PHOTO_HEIGHT) / f64::from(PHOTO_WIDTH);
    if grid::is_narrow(width) {
        let [space] = grid.row([SPACE_ASPECT], 400.0);
        return (space, grid.row([aspect; 2], 106.0));
    }
    // Two photographs below each other are as tall as the space.
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
        let photograph = |id, rect| Panel::photograph(id, rect, PHOTO_WIDTH, PHOTO_HEIGHT);
        let mut first = photograph("first", first);
        first.clickable = true;
        let panels = vec![Orbit::panel(space), first, photograph("second", second)];
        grid.layout(panels)
    }

    fn draw(&mut self, model: &EpipolarPlane, layout: &Layout, canvas: &mut Canvas) {
        let [space, first, second] = ["space", "first", "second"].map(|id| layout.panel(id));
        let titles: [(&Panel, &[&str]); 3] = [
            (
                space,
                &[
                    "Both cameras and what they see: drag to turn, or take P or a camera",
                    "Drag to turn; take P or a camera",
                ],
            ),
            (first, &["Photograph 1: drag p", "1: drag p"]),
            (second, &["Photograph 2", "2"]),
        ];
        for (panel, wordings) in titles {
            grid::fitting_title(canvas, panel.rect, wordings);
            canvas.panel(panel.rect);
        }
        let Some(scenery) = model.scenery() else {
            return grid::notice(canvas, space.rect, "A camera cannot stand there.");
        };
        let Self { photos, cloud } = self;
        let scene = still_life();
        let mut pictures: Vec<(&Camera, &RgbImage)> = Vec::new();
        for (photo, camera) in photos.iter_mut().zip(&scenery.cameras) {
            match photo.picture(&scene, camera, [0.0; 3], PHOTO_SIZE) {
                Ok(picture) => pictures.push((camera, picture)),
                Err(error) => return grid::notice(canvas, space.rect, &error.to_string()),
            }
        }
        for (panel, (_, picture)) in [first, second].into_iter().zip(&pictures) {
            canvas.photograph(panel.rect, picture);
        }
        draw_space(model, scenery, cloud, &pictures, space, canvas);
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

    fn refine(&mut self, model: &EpipolarPlane) -> bool {
        let Some(scenery) = model.scenery() else {
            return false;
        };
        if self.cloud.is_empty() {
            self.cloud = cloud();
            return true;
        }
        let scene = still_life();
        let mut photos = self.photos.iter_mut().zip(&scenery.cameras);
        photos.any(|(photo, camera)| photo.refine(&scene, camera, [0.0; 3], PHOTO_SIZE))
    }
}

/// The still life as colored points, seen from above, where things hide little of each other.
fn cloud() -> Vec<(Point3<f64>, Rgb)> {
    let [eye, target, up] = CLOUD_SEEN.map(Vector3::from);
    let Ok(cam_from_world) = look_at(&eye.into(), &target.into(), &up) else {
        return Vec::new();
    };
    let camera = Camera {
        cam_from_world,
        ..still_life_camera(CLOUD.0, CLOUD.1)
    };
    let Ok(photograph) = still_life().render(&camera, CLOUD.0, CLOUD.1, Sampling::Draft) else {
        return Vec::new();
    };
    let center = camera.center_in_world();
    let pixels = photograph
        .image
        .enumerate_pixels()
        .zip(photograph.depth_m.pixels());
    let points = pixels.map(|((u, v, color), depth)| {
        let ray = camera.ray_in_world(&Point2::new(f64::from(u), f64::from(v)));
        (center + ray * f64::from(depth.0[0]), color.0)
    });
    points
        .filter(|(point, _)| point.z < CLOUD_END_Z_M)
        .collect()
}

/// A line that is lit up, or not.
fn stroke(is_lit: bool) -> Stroke {
    if is_lit {
        Stroke::solid(LIT, 3.0)
    } else {
        Stroke::solid(Role::Ink, 1.5)
    }
}

fn draw_space(
    model: &EpipolarPlane,
    scenery: &Scenery,
    cloud: &[(Point3<f64>, Rgb)],
    pictures: &[(&Camera, &RgbImage)],
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let Some(mut space) = Space::new(panel, model.orbit(), model.zoom(), &SUBJECT) else {
        return;
    };
    let lit = model.lit();
    space.ground(&SUBJECT.middle, 0.0, 0.25, 6);
    space.stand(pictures.iter().copied(), PICTURE_M);
    for (point, color) in cloud {
        space.dot(point, 2.1, *color);
    }
    let [one, two] = scenery.cameras.map(|camera| camera.center_in_world());
    if let Some(plane) = &scenery.plane {
        draw_plane(&mut space, scenery, plane, lit == Lit::Plane);
    }
    space.line(&one, &two, stroke(lit == Lit::Baseline));
    for (index, camera) in scenery.cameras.iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        space.frustum(camera, PHOTO_SIZE, PICTURE_M, role, shape);
        let center = camera.center_in_world();
        space.label(&center, ["O", "O′"][index], role);
        if let Some(pixel) = scenery.pixels[index].filter(crate::kit::scenes::in_picture) {
            let image = space.on_picture(camera, &pixel, PICTURE_M);
            let is_lit = lit == Lit::Point;
            space.line(
                &center,
                &scenery.point,
                Stroke::solid(role, if is_lit { 2.5 } else { 1.5 }),
            );
            space.marker(&image, if is_lit { 5.5 } else { 4.0 }, Shape::Disk, LIT);
            space.label(&image, ["p", "p′"][index], Role::Ink);
        }
        if let Some([from, to]) = scenery.lines()[index].and_then(|line| across(&line)) {
            let ends = [from, to].map(|pixel| space.on_picture(camera, &pixel, PICTURE_M));
            let is_lit = matches!(lit, Lit::Line | Lit::Plane);
            space.line(
                &ends[0],
                &ends[1],
                Stroke::solid(LIT, if is_lit { 3.0 } else { 1.5 }),
            );
        }
    }
    if lit == Lit::Epipole {
        draw_epipoles(&mut space, scenery);
    }
    // Where P could be: its whole ray.
    let ray = scenery.point - one;
    if ray.norm() > 1e-9 {
        let far = one + ray.normalize() * (SHEET_M + 0.4);
        space.line(&one, &far, Stroke::solid(CAMERAS[0].0, 1.25).dotted());
    }
    if let Some(surface) = scenery
        .surface
        .filter(|_| scenery.before_surface_m() != Some(0.0))
    {
        space.marker(&surface.point, 5.0, Shape::Ring, Role::Ink);
    }
    space.label(&scenery.point, "P", LIT);
    space.draw(canvas, panel);
    draw_handles(canvas, panel, model.orbit());
    let handles = model.handles();
    let things = handles
        .iter()
        .filter(|handle| handle.panel == panel.id)
        .skip(2);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        for handle in things {
            canvas.grip(panel.canvas_from_world((handle.x, handle.y)), Role::Grip);
        }
    });
}

/// The plane as a sheet that hinges on the baseline, and the triangle of both centers and P in it.
fn draw_plane(space: &mut Space<'_>, scenery: &Scenery, plane: &Plane, is_lit: bool) {
    let [one, two] = scenery.cameras.map(|camera| camera.center_in_world());
    let (back, on) = (plane.along * -BEYOND_M, plane.along * BEYOND_M);
    let out = plane.towards * SHEET_M;
    let sheet = [one + back, two + on, two + on + out, one + back + out];
    let (role, opacity) = if is_lit {
        (LIT, 0.2)
    } else {
        (Role::Muted, 0.12)
    };
    space.face(&sheet, role, opacity);
    space.face(&[one, two, scenery.point], role, opacity);
    for index in 0..4 {
        let edge = Stroke::solid(role, if is_lit { 1.5 } else { 1.0 });
        space.line(&sheet[index], &sheet[(index + 1) % 4], edge);
    }
}

/// From each center to where the baseline meets the picture's plane, as far as that is near.
fn draw_epipoles(space: &mut Space<'_>, scenery: &Scenery) {
    let Some(geometry) = &scenery.geometry else {
        return;
    };
    let epipoles = [geometry.epipole1, geometry.epipole2];
    for (index, camera) in scenery.cameras.iter().enumerate() {
        let Epipole::Finite(pixel) = epipoles[index] else {
            continue;
        };
        let center = camera.center_in_world();
        let towards = camera.ray_in_world(&pixel) * PICTURE_M;
        let reach = towards.norm();
        let end = center + towards * (TOWARDS_M / reach).min(1.0);
        space.line(&center, &end, Stroke::solid(LIT, 2.0).dashed());
        if reach <= TOWARDS_M {
            space.marker(&end, 5.5, Shape::Ring, LIT);
            space.label(&end, ["e", "e′"][index], LIT);
        }
    }
}

/// Where a line enters and leaves the photograph.
fn across(line: &Line2) -> Option<[Point2<f64>; 2]> {
    let (right, bottom) = (f64::from(PHOTO_WIDTH) - 0.5, f64::from(PHOTO_HEIGHT) - 0.5);
    let at_u = |u: f64| Point2::new(u, -(line.a * u + line.c) / line.b);
    let at_v = |v: f64| Point2::new(-(line.b * v + line.c) / line.a, v);
    let inside = |pixel: &Point2<f64>| {
        let slack = 1e-6;
        (-0.5 - slack..=right + slack).contains(&pixel.x)
            && (-0.5 - slack..=bottom + slack).contains(&pixel.y)
    };
    let border = [at_u(-0.5), at_u(right), at_v(-0.5), at_v(bottom)];
    let mut found = border.into_iter().filter(inside);
    let first = found.next()?;
    let far = |other: &Point2<f64>| (other - first).norm();
    let other = found.max_by(|a, b| far(a).total_cmp(&far(b)))?;
    Some([first, other])
}

fn draw_pencil(
    model: &EpipolarPlane,
    scenery: &Scenery,
    index: usize,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let Some(geometry) = scenery
        .geometry
        .as_ref()
        .filter(|_| model.lit() == Lit::Epipole)
    else {
        return;
    };
    for row in PENCIL_ROWS {
        let pixel = Point2::new(320.0, row);
        let line = match index {
            0 => geometry.line1(&pixel),
            _ => geometry.line2(&pixel),
        };
        if let Some(line) = line {
            draw_line(canvas, panel, &line, Stroke::solid(LIT, 1.0).cased());
        }
    }
}

fn draw_first(model: &EpipolarPlane, scenery: &Scenery, panel: &Panel, canvas: &mut Canvas) {
    let lit = model.lit();
    draw_pencil(model, scenery, 0, panel, canvas);
    let mut labels = Labels::new(panel.rect);
    if let Some(line) = &scenery.lines()[0] {
        let is_lit = matches!(lit, Lit::Line | Lit::Plane);
        let (from, to) = draw_line(canvas, panel, line, stroke(is_lit).cased());
        labels.keep_line_free(from, to);
    }
    let Some(pixel) = scenery.pixels[0] else {
        return grid::notice(canvas, panel.rect, "P is behind camera 1.");
    };
    let place = panel.canvas_from_world((pixel.x, pixel.y));
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
    if let Some(line) = &scenery.lines()[1] {
        let is_lit = matches!(lit, Lit::Line | Lit::Plane);
        let (from, to) = draw_line(canvas, panel, line, stroke(is_lit).cased());
        labels.keep_line_free(from, to);
    }
    let off_surface = scenery.before_surface_m() != Some(0.0);
    let surface = scenery
        .surface
        .filter(|_| off_surface)
        .and_then(|surface| surface.pixel2);
    let mut ring = None;
    if let Some(pixel) = surface.filter(crate::kit::scenes::in_picture) {
        let place = panel.canvas_from_world((pixel.x, pixel.y));
        canvas.marker(place, 6.0, Shape::Ring, Role::Ink, true);
        labels.keep_free(place, 8.0);
        ring = Some(place);
    }
    let image = scenery.pixels[1].map(|pixel| panel.canvas_from_world((pixel.x, pixel.y)));
    match image {
        Some(place) if panel.rect.contains(place) => {
            let radius = if lit == Lit::Point { 6.5 } else { 5.0 };
            canvas.marker(place, radius, Shape::Disk, LIT, true);
            labels.keep_free(place, 8.0);
        }
        Some(place) => {
            if let Some((from, to)) = border_arrow(panel.rect, place) {
                canvas.arrow(from, to, Stroke::solid(LIT, 2.5).cased());
            }
        }
        None => grid::notice(canvas, panel.rect, "P is behind camera 2."),
    }
    if let Some(geometry) = scenery.geometry.as_ref().filter(|_| lit == Lit::Epipole) {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole2, "e′");
    }
    if let Some(place) = image {
        let inside = (
            place
                .0
                .min(panel.rect.right() - 8.0)
                .max(panel.rect.x + 8.0),
            place
                .1
                .min(panel.rect.bottom() - 8.0)
                .max(panel.rect.y + 8.0),
        );
        draw_name(canvas, &mut labels, inside, "p′", lit == Lit::Point);
    }
    // On a phone there is no room for words.
    if let Some(place) = ring.filter(|_| panel.rect.width > 200.0) {
        let style = TextStyle::new(Role::Ink, SMALL).cased();
        labels.draw(canvas, &Labels::around(place, 9.0), "what p shows", style);
    }
}

fn draw_name(canvas: &mut Canvas, labels: &mut Labels, place: Place, name: &str, is_lit: bool) {
    let role = if is_lit { LIT } else { Role::Ink };
    let style = TextStyle::new(role, TEXT + 1.0).cased();
    labels.draw(canvas, &Labels::around(place, 10.0), name, style);
}

/// A piece of a formula: its letters, whether they are raised, and what lights it up.
type Piece = (&'static str, bool, &'static [Lit]);

/// The formula that speaks of what is lit up.
fn formula(lit: Lit) -> &'static [Piece] {
    const T: Piece = ("T", true, &[]);
    match lit {
        Lit::Point => &[
            ("x′", false, &[Lit::Point]),
            T,
            (" F ", false, &[]),
            ("x", false, &[Lit::Point]),
            (" = 0", false, &[]),
        ],
        Lit::Baseline => &[
            ("x′", false, &[]),
            T,
            (" · (", false, &[]),
            ("t", false, &[Lit::Baseline]),
            (" × R x) = 0", false, &[]),
        ],
        Lit::Plane => &[
            ("x′", false, &[]),
            T,
            (" · ", false, &[]),
            ("(t × R x)", false, &[Lit::Plane]),
            (" = 0", false, &[]),
        ],
        Lit::Line => &[("l′", false, &[Lit::Line]), (" = F x", false, &[])],
        Lit::Epipole => &[
            ("F ", false, &[]),
            ("e", false, &[Lit::Epipole]),
            (" = 0,  F", false, &[]),
            T,
            (" ", false, &[]),
            ("e′", false, &[Lit::Epipole]),
            (" = 0", false, &[]),
        ],
    }
}

fn draw_formula(model: &EpipolarPlane, layout: &Layout, canvas: &mut Canvas) {
    const SIZE: f64 = 16.0;
    const RAISED: f64 = 11.0;
    let lit = model.lit();
    let (mut x, y) = (0.0, layout.height - FORMULA / 2.0 + 1.0);
    for (text, is_raised, lights) in formula(lit) {
        let (size, up) = if *is_raised {
            (RAISED, 5.0)
        } else {
            (SIZE, 0.0)
        };
        let is_lit = lights.contains(&lit);
        let role = if is_lit { LIT } else { Role::Ink };
        let width = text_width(text, size);
        canvas.label((x, y - up), text, TextStyle::new(role, size));
        if is_lit {
            canvas.fill_rect(Rect::new(x, y + 10.0, width, 2.0), LIT, 1.0);
        }
        x += width + if *is_raised { 1.0 } else { 0.0 };
    }
    let words = match lit {
        Lit::Point => "x and x′ are the images of P",
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
