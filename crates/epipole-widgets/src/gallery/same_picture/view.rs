//! Both photographs, and between them a top view of the table.

use super::model::{CENTER2_M, FOCALS_PX, RANGE_M, RIGHT, SIZE, SamePicture};
use crate::canvas::{Align, Canvas, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View, format_number};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::kit::photo::Photo;
use crate::kit::plan::{self, PlanCamera};
use crate::theme::Role;
use epipole::camera::PosedCamera;
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector2};

const ASPECT: f64 = grid::aspect(SIZE);
/// Ratio of the mug's radius to its height.
const ROUND: f64 = 0.41;
/// Distance of the drawn image planes from the centers, meters.
const IMAGE_M: f64 = 0.3;
/// Distances at which further mugs are outlined along the ray, meters.
const ECHOES_M: [f64; 5] = [0.5, 1.0, 1.5, 2.0, 2.5];

/// Draws [`SamePicture`].
#[derive(Default)]
pub(crate) struct SamePictureView {
    photos: [Photo; 2],
    /// Distance and height of the mug in the photographs, meters.
    rendered: Option<[f64; 3]>,
    /// Last sharp photograph 1, with the state for which it is valid and whether the mug grows.
    /// With a growing mug it is valid for every distance.
    sharp: Option<(bool, [f64; 3], RgbImage)>,
}

impl View for SamePictureView {
    type Model = SamePicture;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &SamePicture, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (top, photographs) = match grid::is_broad(width) {
            true => {
                let [first, top, second] = grid.row([ASPECT, 0.86, ASPECT], 420.0);
                (top, [first, second])
            }
            false => grid.beside_photographs(ASPECT, 390.0),
        };
        let mut panels = vec![plan::panel("top", top, (0.95, 1.3), 1.6)];
        for (id, rect) in ["first", "second"].into_iter().zip(photographs) {
            panels.push(Panel::photograph(id, rect, SIZE));
        }
        grid.layout(panels)
    }

    fn draw(&mut self, model: &SamePicture, layout: &Layout, canvas: &mut Canvas) {
        let [top, first, second] = layout.panels_named(["top", "first", "second"]);
        let titles = [
            (top, "From above"),
            (first, "Photograph 1"),
            (second, "Photograph 2"),
        ];
        for (panel, title) in titles {
            grid::open(canvas, panel, &[title]);
        }
        canvas.clipped(top.rect.inset(1.0), |canvas| draw_top(model, top, canvas));
        if let Err(sentence) = self.draw_photographs(model, [first, second], canvas) {
            grid::notice(canvas, first.rect, &sentence);
        }
    }

    fn prepare(&mut self, model: &SamePicture) -> bool {
        let (Ok(scene), Ok(cameras)) = (model.scene(), model.cameras()) else {
            return false;
        };
        let shown = self.shown(model);
        let mut photos = self.photos.iter_mut().zip(&cameras);
        photos.any(|(photo, camera)| photo.prepare(&scene, camera, shown, SIZE))
    }

    fn refine(&mut self, model: &SamePicture) -> bool {
        let (Ok(scene), Ok(cameras)) = (model.scene(), model.cameras()) else {
            return false;
        };
        let shown = self.shown(model);
        // The photograph that changes visibly is refined first.
        let [first, second] = &mut self.photos;
        if second.refine(&scene, &cameras[1], shown, SIZE)
            || first.refine(&scene, &cameras[0], shown, SIZE)
        {
            return true;
        }
        if let Ok(picture) = first.picture(&scene, &cameras[0], shown, SIZE)
            && self.sharp.as_ref().is_none_or(|(_, of, _)| *of != shown)
        {
            self.sharp = Some((model.grows(), shown, picture.clone()));
        }
        false
    }
}

impl SamePictureView {
    /// Returns the state in the photographs; discards photographs of another state.
    fn shown(&mut self, model: &SamePicture) -> [f64; 3] {
        let shown = [model.distance_m, model.height_m(), 0.0];
        if self.rendered != Some(shown) {
            self.photos.iter_mut().for_each(Photo::forget);
            self.rendered = Some(shown);
        }
        shown
    }

    fn draw_photographs(
        &mut self,
        model: &SamePicture,
        panels: [&Panel; 2],
        canvas: &mut Canvas,
    ) -> Result<(), String> {
        let sentence = |problem: &dyn std::fmt::Display| problem.to_string();
        let scene = model.scene().map_err(|problem| sentence(&problem))?;
        let cameras = model.cameras().map_err(|problem| sentence(&problem))?;
        let shown = self.shown(model);
        for (index, (panel, camera)) in panels.into_iter().zip(&cameras).enumerate() {
            let same = |(grows, of, _): &&(bool, [f64; 3], RgbImage)| {
                index == 0 && (*of == shown || *grows && model.grows())
            };
            match self.sharp.as_ref().filter(same) {
                Some((.., picture)) => canvas.photograph(panel.rect, picture),
                None => {
                    let picture = self.photos[index].picture(&scene, camera, shown, SIZE);
                    canvas.photograph(panel.rect, picture.map_err(|problem| sentence(&problem))?);
                }
            }
        }
        canvas.clipped(panels[0].rect, |canvas| {
            draw_height(model, &cameras[0], panels[0], canvas)
        });
        canvas.clipped(panels[1].rect, |canvas| {
            draw_ray(model, &cameras[1], panels[1], canvas)
        });
        Ok(())
    }
}

/// Draws the pixel of the mug's center, and the mug's height.
fn draw_height(model: &SamePicture, camera: &PosedCamera, panel: &Panel, canvas: &mut Canvas) {
    let at = |share: f64| {
        let pixel = camera.project(&model.on_axis(share)).unwrap_or_default();
        panel.place_of(&pixel)
    };
    let (foot, middle, rim) = (at(0.0), at(0.5), at(1.0));
    let x = foot.0 - ROUND * (foot.1 - rim.1) - 12.0;
    let stroke = Stroke::solid(Role::Ink, 1.5).cased();
    canvas.line((x, foot.1), (x, rim.1), stroke);
    for y in [foot.1, rim.1] {
        canvas.line((x - 4.0, y), (x + 4.0, y), stroke);
    }
    let text = format!("{} px", format_number(model.picture_px().unwrap_or(0.0), 0));
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let ink = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &[((x - 8.0, middle.1), Align::End)], &text, ink);
    draw_pixel(canvas, &mut labels, middle, 0, "p");
}

/// Draws the ray of that pixel in photograph 2, and the mug on it.
fn draw_ray(model: &SamePicture, camera: &PosedCamera, panel: &Panel, canvas: &mut Canvas) {
    let along = model.on_axis(0.5).coords / model.distance_m;
    let at = |z: f64| {
        let pixel = camera.project(&Point3::from(along * z)).unwrap_or_default();
        panel.place_of(&pixel)
    };
    let role = CAMERAS[0].0;
    let stroke = Stroke::solid(role, 1.75).dashed().cased();
    canvas.line(at(0.0), at(RANGE_M[1] + 0.9), stroke);
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let style = TextStyle::new(role, TEXT).cased();
    let end = (panel.rect.right() - 6.0, at(RANGE_M[1] + 0.2).1 - 14.0);
    labels.draw(canvas, &[(end, Align::End)], "the ray of p", style);
    draw_pixel(canvas, &mut labels, at(model.distance_m), 1, "p′");
}

fn draw_pixel(
    canvas: &mut Canvas,
    labels: &mut Labels,
    place: (f64, f64),
    camera: usize,
    name: &str,
) {
    let (role, shape) = CAMERAS[camera];
    match camera {
        0 => canvas.marker(place, 4.5, shape, role, true),
        _ => canvas.hollow_marker(place, 4.5, shape, role, true),
    }
    labels.keep_free(place, 6.0);
    labels.name(canvas, (place, 8.0), name, (role, TEXT));
}

fn draw_top(model: &SamePicture, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let at = |x: f64, z: f64| panel.canvas_from_world((x, z));
    let z = model.distance_m;
    let mug = at(RIGHT * z, z);
    let radius = ROUND * model.height_m() * panel.scale_x();
    let half_widths = FOCALS_PX.map(|focal_px| f64::from(SIZE.0) / 2.0 / focal_px);
    let centers = [Point2::origin(), Point2::new(CENTER2_M[0], CENTER2_M[2])];
    for index in 0..2 {
        let center = centers[index];
        let camera = PlanCamera {
            center,
            // Camera 2 points to the left.
            heading_rad: [0.0, -std::f64::consts::FRAC_PI_2][index],
            half_width: half_widths[index],
            mark: CAMERAS[index],
        };
        if index == 0 {
            draw_cone(model, panel, canvas);
        }
        let name = [("camera 1", Align::Start), ("camera 2", Align::Middle)][index];
        let towards = Point2::new(RIGHT * z, z) - center;
        camera.draw_sight(canvas, panel, &mut labels, name, IMAGE_M, &towards);
    }
    // The ray of camera 2 crosses one of the numbers, so they are drawn again.
    plan::draw_numbers(canvas, panel, "m");
    canvas.disk(mug, radius, Role::Candidate, 0.55);
    canvas.grip(mug, Role::Grip);
    labels.keep_free(mug, radius.max(9.0));
    let ink = TextStyle::new(Role::Ink, TEXT).cased();
    let text = format!("{} m tall", format_number(model.height_m(), 2));
    let right = mug.0 + radius + 9.0;
    let beside = [15.0, -15.0].map(|up| ((right, mug.1 - up), Align::Start));
    labels.draw(canvas, &beside, &text, ink);
}

/// Draws all mugs with the same image, as circles between two rays; for a mug of fixed size, the
/// possible circles.
fn draw_cone(model: &SamePicture, panel: &Panel, canvas: &mut Canvas) {
    if !model.grows() {
        for z in ECHOES_M {
            let place = panel.canvas_from_world((RIGHT * z, z));
            let radius = ROUND * model.height_m() * panel.scale_x();
            canvas.disk(place, radius, Role::Candidate, 0.14);
        }
        return;
    }
    let share = ROUND * model.height_m() / model.distance_m;
    let axis = Vector2::new(RIGHT, 1.0);
    let tilt = libm::asin((share / axis.norm()).min(1.0));
    for side in [-1.0, 1.0] {
        let heading = libm::atan2(axis.x, axis.y) + side * tilt;
        let edge = Vector2::new(libm::sin(heading), libm::cos(heading));
        let stroke = Stroke::solid(CAMERAS[0].0, 1.0).dotted();
        plan::draw_ray(canvas, panel, &Point2::origin(), &edge, stroke);
    }
    for z in ECHOES_M {
        let place = panel.canvas_from_world((RIGHT * z, z));
        let radius = share * z * panel.scale_x();
        canvas.disk(place, radius, Role::Candidate, 0.14);
    }
}
