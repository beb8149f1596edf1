//! Cameras and points in 3D: rotation, panning and zoom by mouse, touch and keys.

use super::camera_view::Through;
use super::ground::{edges, scale_bar};
use super::look;
use super::marks::{has_dense, rays};
use super::pick::{Click, crosshair, pick};
use super::scene_inputs::{Coloring, Made};
use super::selection::{Selection, Tool};
use super::steer::steer;
use crate::project::{Blob, CropBox, Project};
use crate::tasks::{Query, ReconstructionOfAll};
use egui::{ColorImage, Rect, Sense, TextureHandle, TextureOptions, Ui, Vec2};
use epipole_canvas::cloud::{Frame, Look, Orbit, Scene};
use epipole_canvas::theme::Role;
use std::time::Duration;

/// Inputs of the last frame; it is redrawn when they change.
#[derive(Clone, PartialEq)]
pub(super) struct Drawn {
    orbit: Orbit,
    size: (usize, usize),
    point: Option<usize>,
    crop: Option<CropBox>,
    point_size: f64,
    coarse: bool,
}

/// View state of a reconstruction.
pub(crate) struct CloudView {
    pub(crate) coloring: Coloring,
    /// Whether frusta show their photographs.
    pub(crate) photographs: bool,
    /// Whether sparse points are shown beside dense ones.
    pub(crate) sparse: bool,
    /// Whether the surface of all views is shown in place of their points.
    pub(crate) surface: bool,
    /// Whether dense points or the surface are shown.
    pub(crate) dense: bool,
    /// Whether cameras are shown.
    pub(crate) cameras: bool,
    /// Whether the grid of the floor is shown.
    pub(crate) grid: bool,
    /// Size of points, relative to the proposed one.
    pub(crate) point_size: f64,
    /// Selected tool.
    pub(crate) tool: Tool,
    /// Whether the controls of the tools are shown.
    pub(crate) has_tools: bool,
    /// Selected points.
    pub(crate) selection: Selection,
    /// Box while one of its sides is dragged.
    pub(crate) draft: Option<CropBox>,
    /// View through a camera.
    pub(crate) through: Option<Through>,
    /// Selected point.
    pub(crate) point: Option<usize>,
    pub(super) made: Option<Made>,
    pub(super) orbit: Option<Orbit>,
    /// Length of a frustum.
    pub(super) reach: f64,
    pub(super) scene: Scene,
    /// Number of sparse points of the scene; dense ones follow.
    pub(super) num_shared: usize,
    pub(super) num_fixed_lines: usize,
    frame: Frame,
    texture: Option<TextureHandle>,
    /// Time until which it counts as moving, seconds.
    moves_until: f64,
    pub(super) drawn: Option<Drawn>,
}

impl Default for CloudView {
    fn default() -> Self {
        Self {
            coloring: Coloring::default(),
            photographs: true,
            sparse: true,
            surface: false,
            dense: true,
            cameras: true,
            grid: true,
            point_size: 1.0,
            tool: Tool::Look,
            has_tools: false,
            selection: Selection::default(),
            draft: None,
            through: None,
            point: None,
            made: None,
            orbit: None,
            reach: 1.0,
            scene: Scene::default(),
            num_shared: 0,
            num_fixed_lines: 0,
            frame: Frame::default(),
            texture: None,
            moves_until: 0.0,
            drawn: None,
        }
    }
}

/// Maximum number of points drawn during motion, then of pixels: a frame must be ready for the next
/// refresh of the screen.
const MAX_MOVING: usize = 100_000;
const MAX_MOVING_PIXELS: usize = 200_000;

/// Time without change after which motion counts as ended, seconds. A dragging hand sometimes
/// pauses between frames, and each pause would otherwise draw all points.
const REST_S: f64 = 0.15;

/// Divisor of the frame's width and height during motion.
fn coarseness((width, height): (usize, usize)) -> usize {
    let over = (width * height) as f64 / MAX_MOVING_PIXELS as f64;
    (libm::ceil(libm::sqrt(over)) as usize).clamp(1, 4)
}

/// Returns the side of a point on the screen, larger for fewer points.
fn size_of(num_points: usize) -> f64 {
    match num_points {
        0..10_000 => 3.0,
        10_000..100_000 => 2.5,
        _ => 2.0,
    }
}

impl CloudView {
    /// Shows the current component. Returns the clicked point, if any; a key clicks in the middle.
    pub(crate) fn show(&mut self, project: &Project, ui: &mut Ui, rect: Rect) -> Option<Click> {
        let shown = project.component().or(project.growing());
        let (Some(component), Some(key)) = (shown, ReconstructionOfAll.key(project)) else {
            return None;
        };
        self.make(project, component, key, look::theme(ui));
        let id = ui.make_persistent_id("space");
        let response = ui.interact(rect, id, Sense::click_and_drag());
        let words = format!(
            "Space with {} points and {} cameras. Drag or arrow keys turn it, Shift moves it, \
             plus and minus enlarge it, Enter chooses the point at the center.",
            component.points.len(),
            component.num_registered()
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &words));
        let pixels = ui.ctx().pixels_per_point();
        let size = (
            (rect.width() * pixels).max(1.0) as usize,
            (rect.height() * pixels).max(1.0) as usize,
        );
        let mut orbit = self.orbit?;
        let now = ui.input(|input| input.time);
        // Without the controls of the tools, a drag turns the view.
        let is_selecting = std::mem::take(&mut self.has_tools) && self.tool == Tool::Select;
        if let Some(through) = &self.through {
            through.focus(&mut orbit, size);
        }
        if steer(&mut orbit, ui, &response, size, pixels, is_selecting) {
            self.moves_until = now + REST_S;
        }
        let rest = (self.scene.points.len() > MAX_MOVING).then_some(self.moves_until - now);
        let coarse = rest.filter(|rest| *rest > 0.0);
        if let Some(rest) = coarse {
            let rest = Duration::from_secs_f64(rest);
            ui.ctx().request_repaint_after(rest);
        }
        self.orbit = Some(orbit);
        self.draw(project, ui, orbit, size, coarse.is_some());
        if let Some(texture) = &self.texture {
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter_at(rect)
                .image(texture.id(), rect, whole, egui::Color32::WHITE);
        }
        scale_bar(project, ui, rect, (&orbit, size));
        if is_selecting {
            self.lasso(project, ui, &response, rect, (&orbit, size));
        }
        if response.has_focus() {
            let stroke = egui::Stroke::new(2.0, look::color(ui, Role::Best));
            let inner = rect.shrink(1.0);
            ui.painter()
                .rect_stroke(inner, 0.0, stroke, egui::StrokeKind::Inside);
            crosshair(ui, rect);
        }
        if !response.clicked() {
            return None;
        }
        let clicked = pick(
            &response,
            rect,
            &self.frame,
            &self.scene,
            &orbit,
            self.num_shared,
        );
        self.point = match clicked {
            Click::Point(point) => Some(point),
            Click::Missed | Click::Dense(_) | Click::Vertex(_) => None,
        };
        Some(clicked)
    }

    /// Returns the position on the screen of a point of the reconstruction.
    pub(crate) fn place_of(&self, place: nalgebra::Point3<f64>, rect: Rect) -> Option<egui::Pos2> {
        let (width, height) = self.frame.size();
        let place = place.map(|x| x as f32).into();
        let ([u, v], _) = self.orbit?.project(place, (width, height))?;
        let share = Vec2::new(u as f32 / width as f32, v as f32 / height as f32);
        Some(rect.min + share * rect.size())
    }

    /// Pixels of the last frame: width, and red, green, blue, opacity, row by row.
    pub(crate) fn pixels(&self) -> Option<(u32, Blob)> {
        let (width, height) = self.frame.size();
        let rgba = self.frame.rgba();
        let is_drawn = self.drawn.is_some() && rgba.len() == 4 * width * height;
        is_drawn.then(|| (width as u32, rgba.to_vec().into()))
    }

    /// Resets the view to show everything.
    pub(crate) fn look_at_all(&mut self) {
        self.made = None;
        self.orbit = None;
        self.through = None;
    }

    /// Whether sparse points are shown: always, if there are no others.
    pub(super) fn shows_sparse(&self, project: &Project) -> bool {
        self.sparse || !has_dense(project)
    }

    fn draw(
        &mut self,
        project: &Project,
        ui: &Ui,
        orbit: Orbit,
        size: (usize, usize),
        coarse: bool,
    ) {
        let crop = self.draft.or(project.crop().copied());
        let now = Drawn {
            orbit,
            size,
            point: self.point,
            crop,
            point_size: self.point_size,
            coarse,
        };
        if self.drawn.as_ref() == Some(&now) {
            return;
        }
        self.drawn = Some(now);
        self.scene.lines.truncate(self.num_fixed_lines);
        if let (Some(component), Some(point)) = (project.component(), self.point) {
            rays(
                &mut self.scene.lines,
                component,
                point,
                look::theme(ui).color(Role::Grip),
            );
        }
        if let Some(crop) = crop {
            let color = look::theme(ui).color(Role::Grip);
            edges(&mut self.scene.lines, &crop, color);
        }
        let every = match coarse {
            true => self.scene.points.len().div_ceil(MAX_MOVING),
            false => 1,
        };
        let by = if coarse { coarseness(size) } else { 1 };
        let size = ((size.0 / by).max(1), (size.1 / by).max(1));
        let point_px = size_of(self.scene.points.len()) * self.point_size;
        let point_px = point_px * f64::from(ui.ctx().pixels_per_point()) / by as f64;
        let look = Look {
            point_px,
            every,
            background: look::theme(ui).color(Role::Surface),
        };
        self.frame.draw(&self.scene, &orbit, size, &look);
        let image = ColorImage::from_rgba_premultiplied([size.0, size.1], self.frame.rgba());
        match &mut self.texture {
            Some(texture) => texture.set(image, TextureOptions::NEAREST),
            None => {
                let texture = ui
                    .ctx()
                    .load_texture("space", image, TextureOptions::NEAREST);
                self.texture = Some(texture);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_that_moves_has_few_pixels_on_any_screen() {
        assert_eq!(coarseness((390, 330)), 1);
        assert_eq!(coarseness((790, 620)), 2);
        for size in [(790, 620), (1560, 1300), (0, 0)] {
            let by = coarseness(size);
            assert!(
                (size.0 / by) * (size.1 / by) <= MAX_MOVING_PIXELS,
                "{size:?}"
            );
        }
    }
}
