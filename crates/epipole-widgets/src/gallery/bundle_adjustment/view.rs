//! House and cameras in space, one of the photographs with its errors, and the curves of the loop.

use super::answer::State;
use super::model::BundleAdjustment;
use super::plots;
use super::scene::{MARK, SHOWN, SIZE, Scene};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect, View};
use crate::legend::{self, Entry, Swatch};
use crate::orbit::Orbit;
use crate::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use nalgebra::{Point2, Point3};

const TITLE: f64 = 24.0;
const TEXT: f64 = 13.0;
const NARROW: f64 = 560.0;
const GAP: f64 = 12.0;
/// Height of the plots with their titles and axes.
const PLOTS: f64 = 172.0;
/// Between the photograph and the legend below it.
const LEGEND_GAP: f64 = 8.0;
/// Share of a wide page that the space takes.
const SPACE_SHARE: f64 = 0.56;
/// What the reader looks at: the house and the cameras before it.
const SUBJECT: Subject = Subject {
    middle: Point3::new(0.1, -0.15, -0.75),
    radius: 1.85,
};
/// How far before its camera a picture is put up.
const PICTURE_DEPTH: f64 = 0.42;
/// The ground below the house.
const GROUND: f64 = 0.4;
const CAMERA_NAMES: [&str; 4] = ["camera 1", "camera 2", "camera 3", "camera 4"];

const START: Stroke = Stroke {
    role: Role::Reference,
    width: 1.25,
    dash: crate::canvas::Dash::Dashed,
    cased: false,
};

/// Draws [`BundleAdjustment`].
#[derive(Default)]
pub(crate) struct BundleAdjustmentView;

fn legend_entries() -> [Entry; 4] {
    [
        (Swatch::Line(START), "at the start"),
        (Swatch::Line(Stroke::solid(Role::Best, 2.0)), "now"),
        (
            Swatch::Line(Stroke::solid(Role::Truth, 1.5).dotted()),
            "truth",
        ),
        (
            Swatch::Line(error_stroke()),
            "reprojection error, to the feature",
        ),
    ]
}

fn error_stroke() -> Stroke {
    Stroke::solid(Role::Series(1), 2.0)
}

impl View for BundleAdjustmentView {
    type Model = BundleAdjustment;

    fn layout(&self, model: &BundleAdjustment, width: f64) -> Layout {
        let aspect = f64::from(SIZE.1) / f64::from(SIZE.0);
        let legend_height = |width| LEGEND_GAP + legend::height(&legend_entries(), width, 0.0);
        let (space, photo, top) = if width < NARROW {
            let space = Rect::new(0.0, TITLE, width, (width * 0.8).max(220.0));
            let photo = Rect::new(0.0, space.bottom() + TITLE + 6.0, width, width * aspect);
            (space, photo, photo.bottom() + legend_height(width))
        } else {
            let left = SPACE_SHARE * width;
            let photo_width = width - left - GAP;
            let photo = Rect::new(left + GAP, TITLE, photo_width, photo_width * aspect);
            let height = photo.height + legend_height(photo_width);
            let space = Rect::new(0.0, TITLE, left, height);
            (space, photo, space.bottom() + 8.0)
        };
        let plots = Rect::new(0.0, top, width, PLOTS);
        let [cost, damping] = plots::panels(model, plots, GAP);
        Layout {
            width,
            height: plots.bottom(),
            panels: vec![
                Orbit::panel(space),
                Panel::photograph("photo", photo, SIZE.0, SIZE.1),
                cost,
                damping,
            ],
        }
    }

    fn draw(&mut self, model: &BundleAdjustment, layout: &Layout, canvas: &mut Canvas) {
        let [space, photo] = ["space", "photo"].map(|id| layout.panel(id));
        let ink = TextStyle::new(Role::Ink, TEXT);
        for (panel, title) in [
            (space, "Space: a house and four cameras"),
            (photo, "Photograph of camera 3"),
        ] {
            canvas.panel(panel.rect);
            let place = (panel.rect.x + 2.0, panel.rect.y - TITLE / 2.0);
            canvas.label(place, title, ink);
        }
        if let Some(scene) = model.scene() {
            draw_space(model, scene, space, canvas);
            draw_photo(model, scene, photo, canvas);
        }
        draw_handles(canvas, space, model.orbit());
        let Rect { x, width, .. } = photo.rect;
        let top = photo.rect.bottom() + LEGEND_GAP;
        // As much margin on the right as on the left: the legend is as wide as the photograph.
        legend::draw(canvas, &legend_entries(), width + 2.0 * x, x, top);
        plots::draw(
            model,
            ["cost", "damping"].map(|id| layout.panel(id)),
            canvas,
        );
        if let Some(problem) = model.problem() {
            let style = TextStyle::new(Role::Ink, 14.0).cased();
            canvas.paragraph(space.rect.inset(12.0), problem, style);
        }
    }
}

fn draw_space(model: &BundleAdjustment, scene: &Scene, panel: &Panel, canvas: &mut Canvas) {
    // The cameras stand side by side, so a narrow panel shows them from farther off.
    let narrowness = 1.5 * panel.rect.height / panel.rect.width.max(1.0);
    let subject = Subject {
        radius: SUBJECT.radius * narrowness.max(1.0),
        ..SUBJECT
    };
    let Some(mut space) = Space::new(panel, model.orbit(), model.zoom(), &subject) else {
        return;
    };
    space.ground(&SUBJECT.middle, GROUND, 0.6, 6);
    let wires = |space: &mut Space, points: &[Point3<f64>], stroke: Stroke| {
        for wire in &scene.wires {
            for pair in wire.windows(2) {
                space.line(&points[pair[0]], &points[pair[1]], stroke);
            }
        }
    };
    if let Some([start, now]) = model.states() {
        wires(&mut space, &start.points, START);
        wires(&mut space, &now.points, Stroke::solid(Role::Best, 2.0));
        for (index, camera) in now.cameras.iter().enumerate() {
            let (role, shape) = camera_mark(index);
            space.frustum(camera, SIZE, PICTURE_DEPTH, role, shape);
            let center = camera.center_in_world();
            let was = start.cameras[index].center_in_world();
            space.line(&was, &center, START);
            space.marker(&was, 4.0, Shape::Cross, Role::Reference);
            space.label(&center, CAMERA_NAMES[index], role);
        }
    } else {
        for (index, camera) in scene.cameras.iter().enumerate() {
            let (role, shape) = camera_mark(index);
            space.frustum(camera, SIZE, PICTURE_DEPTH, role, shape);
        }
    }
    let truth = Stroke::solid(Role::Truth, 1.5).dotted();
    wires(&mut space, &scene.points, truth);
    space.draw(canvas, panel);
}

/// The camera whose photograph is shown has a hue and a shape of its own.
fn camera_mark(index: usize) -> (Role, Shape) {
    match index == SHOWN {
        true => (Role::Series(3), Shape::Square),
        false => (Role::Series(0), Shape::Disk),
    }
}

fn draw_photo(model: &BundleAdjustment, scene: &Scene, panel: &Panel, canvas: &mut Canvas) {
    let on_page = |pixel: &Point2<f64>| panel.canvas_from_world((pixel.x, pixel.y));
    let mark = panel.canvas_from_world(model.mark());
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        if let (Some([start, now]), Some(answer)) = (model.states(), model.answer()) {
            let places = |state: &State| -> Vec<Option<Place>> {
                let shown = state.shown(SHOWN);
                shown
                    .iter()
                    .map(|pixel| pixel.as_ref().map(on_page))
                    .collect()
            };
            let mut features: Vec<Place> = answer.features.iter().map(on_page).collect();
            features[MARK] = mark;
            draw_wires(scene, &places(start), START, canvas);
            let now = places(now);
            draw_wires(scene, &now, Stroke::solid(Role::Best, 1.5), canvas);
            for (feature, shown) in features.iter().zip(&now) {
                if let Some(shown) = shown {
                    canvas.line(*shown, *feature, error_stroke());
                }
                canvas.circle(*feature, 2.5, Stroke::solid(Role::Ink, 1.0));
            }
        } else {
            let shown = |point| scene.cameras[SHOWN].project(point).ok();
            let shown = scene.points.iter().map(shown);
            let places: Vec<_> = shown.map(|p| p.as_ref().map(on_page)).collect();
            let truth = Stroke::solid(Role::Truth, 1.5).dotted();
            draw_wires(scene, &places, truth, canvas);
        }
        canvas.grip(mark, Role::Grip);
        let style = TextStyle::new(Role::Muted, 12.0).cased();
        let place = (panel.rect.x + 10.0, panel.rect.bottom() - 12.0);
        canvas.label(place, "drag the marked feature", style);
    });
}

fn draw_wires(scene: &Scene, places: &[Option<Place>], stroke: Stroke, canvas: &mut Canvas) {
    for wire in &scene.wires {
        for pair in wire.windows(2) {
            if let (Some(a), Some(b)) = (places[pair[0]], places[pair[1]]) {
                canvas.line(a, b, stroke);
            }
        }
    }
}
