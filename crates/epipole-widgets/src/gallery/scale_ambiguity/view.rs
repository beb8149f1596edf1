//! The house and its cameras in 3D, unscaled and scaled, and the two photographs.

use super::model::{ScaleAmbiguity, World};
use crate::canvas::{Canvas, Place, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::house::{House, SIZE};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::orbit::Orbit;
use crate::kit::pair::CAMERAS;
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use nalgebra::Point3;

const PHOTOS: [&str; 2] = ["first", "second"];
/// Distance of the image plane from its camera in the 3D view, in widths of the house.
const PICTURE_DEPTH: f64 = 0.55;

const BEFORE: Stroke = Stroke::solid(Role::Reference, 1.5).dashed();
const NOW: Stroke = Stroke::solid(Role::Best, 2.0);
const LEGEND: [Entry; 2] = [(Swatch::Line(BEFORE), "before"), (Swatch::Line(NOW), "now")];

/// Draws [`ScaleAmbiguity`].
#[derive(Default)]
pub(crate) struct ScaleAmbiguityView;

impl View for ScaleAmbiguityView {
    type Model = ScaleAmbiguity;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &ScaleAmbiguity, width: f64) -> Layout {
        let aspect = grid::aspect(SIZE);
        let mut grid = Grid::new(width);
        let (space, photos) = if grid::is_broad(width) {
            let [space, first, second] = grid.row([0.84, aspect, aspect], 400.0);
            (space, [first, second])
        } else {
            let height = if grid::is_narrow(width) { 160.0 } else { 210.0 };
            let [space] = grid.shares([1.0], height);
            (space, grid.row([aspect; 2], 160.0))
        };
        grid.strip(legend::height(&LEGEND, width, 0.0) + 4.0);
        let photograph = |(id, rect)| Panel::photograph(id, rect, SIZE);
        let mut panels = vec![Orbit::panel(space)];
        panels.extend(PHOTOS.into_iter().zip(photos).map(photograph));
        grid.layout(panels)
    }

    fn draw(&mut self, model: &ScaleAmbiguity, layout: &Layout, canvas: &mut Canvas) {
        let space = layout.panel("space");
        grid::open(canvas, space, &["House and cameras"]);
        for (id, title) in PHOTOS.into_iter().zip(["Photograph 1", "Photograph 2"]) {
            grid::open(canvas, layout.panel(id), &[title]);
        }
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 4.0);
        let worlds = (
            model.house(),
            model.world([1.0, 1.0]),
            model.world(model.times()),
        );
        let (Some(house), Some(was), Some(is)) = worlds else {
            return grid::notice(canvas, space.rect, "Part of the house is behind a camera.");
        };
        draw_space(model, house, [&was, &is], space, canvas);
        for (index, id) in PHOTOS.into_iter().enumerate() {
            let panel = layout.panel(id);
            canvas.clipped(panel.rect.inset(1.0), |canvas| {
                for (world, stroke) in [(&was, BEFORE), (&is, NOW)] {
                    draw_photograph(house, world, index, panel, stroke, canvas);
                }
            });
        }
    }
}

fn draw_space(
    model: &ScaleAmbiguity,
    house: &House,
    [was, is]: [&World; 2],
    panel: &Panel,
    canvas: &mut Canvas,
) {
    // A fixed subject, large enough for all slider values, makes growth visible.
    let subject = Subject {
        middle: Point3::new(0.7, -0.5, 1.2),
        radius: 3.4,
    };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    space.ground(&subject.middle, 0.4, 1.0, 8);
    for (world, stroke) in [(was, BEFORE), (is, NOW)] {
        for [from, to] in house.pieces() {
            space.line(&world.points[from], &world.points[to], stroke);
        }
    }
    for (index, camera) in is.cameras.iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        space.frustum(camera, SIZE, PICTURE_DEPTH, role, shape);
        let name = ["camera 1", "camera 2"][index];
        space.label(&camera.center_in_world(), name, role);
    }
    let [one, two] = is.cameras.map(|camera| camera.center_in_world());
    space.line(&one, &two, Stroke::solid(Role::Ink, 2.0));
    // One ray per camera, to show that both houses lie on it.
    let ridge = house
        .wires
        .iter()
        .flatten()
        .copied()
        .max_by(|&a, &b| was.points[b].y.total_cmp(&was.points[a].y));
    if let Some(ridge) = ridge {
        for (index, center) in [one, two].iter().enumerate() {
            let thin = Stroke::solid(CAMERAS[index].0, 1.25);
            space.line(center, &is.points[ridge], thin);
        }
    }
    space.draw(canvas, panel);
    draw_handles(canvas, panel, &model.orbit);
}

fn draw_photograph(
    house: &House,
    world: &World,
    camera: usize,
    panel: &Panel,
    stroke: Stroke,
    canvas: &mut Canvas,
) {
    let places: Vec<Place> = (world.pixels[camera].iter())
        .map(|pixel| panel.place_of(pixel))
        .collect();
    for wire in &house.wires {
        let wire: Vec<Place> = wire.iter().map(|&index| places[index]).collect();
        canvas.polyline(&wire, stroke);
    }
}
