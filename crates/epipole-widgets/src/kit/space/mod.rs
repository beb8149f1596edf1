//! Drawing in 3D: colored points, cameras, a ground and axes, far to near. Lines hidden by points
//! are dashed.
//!
//! Coordinates are as in the chapters and in camera 1: x right, y **down**, z forward.

use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::Panel;
use crate::kit::grid::SMALL;
use crate::kit::labels::Labels;
use crate::kit::lens::Lens;
pub(crate) use crate::kit::lens::Subject;
use crate::kit::orbit::Orbit;
use crate::kit::standing::{Screen, Standing, half};
use crate::theme::{Rgb, Role};
use epipole::camera::PosedCamera;
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector3};

mod depths;
mod order;

use self::order::{Mark, Placed, arrange};

/// Minimum panel width for the pan handle, CSS pixels.
const SMALLEST: f64 = 300.0;
/// Size of labels, CSS pixels.
const TEXT: f64 = 13.0;

/// A scene in the reader's view: marks are collected, then drawn.
pub(crate) struct Space<'a> {
    lens: Lens,
    zoom: f64,
    /// Lines of the ground, drawn first.
    ground: Vec<(Place, Place, Stroke)>,
    /// Photographs, far to near.
    photographs: Vec<Standing<'a>>,
    marks: Vec<Placed>,
    labels: Vec<(Place, &'static str, Role)>,
}

impl<'a> Space<'a> {
    /// Creates an empty scene in a panel of [`Orbit::panel`]; `None` if the panel has no size, or
    /// the subject is not finite.
    pub(crate) fn new(panel: &Panel, orbit: &Orbit, subject: &Subject) -> Option<Self> {
        let size = (panel.rect.width, panel.rect.height);
        let middle = panel.canvas_from_world(orbit.middle());
        Some(Self {
            lens: Lens::new(size, (1.0, 1.0), middle, orbit, subject)?,
            zoom: orbit.zoom(),
            ground: Vec::new(),
            photographs: Vec::new(),
            marks: Vec::new(),
            labels: Vec::new(),
        })
    }

    /// Adds photographs that hide the marks behind them, each `depth` in front of its camera. Must
    /// precede all marks except for the ground.
    pub(crate) fn stand<'b: 'a>(
        &mut self,
        photographs: impl IntoIterator<Item = (&'b PosedCamera, &'a RgbImage)>,
        depth: f64,
    ) {
        let standing = photographs
            .into_iter()
            .filter_map(|(camera, image)| Standing::new(&self.lens, camera, image, depth));
        self.photographs = standing.collect();
        self.photographs.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    }

    /// Collects a mark with its center and its corners on the page.
    fn push(&mut self, in_eye: &Point3<f64>, places: &[Place], mark: Mark) {
        let behind = (self.photographs.iter()).position(|photo| photo.hides(in_eye, places));
        let layer = behind.unwrap_or(self.photographs.len());
        self.marks.push(Placed {
            layer,
            in_eye: *in_eye,
            mark,
        });
    }

    fn in_eye(&self, point: &Point3<f64>) -> Point3<f64> {
        self.lens.eye.cam_from_world * point
    }

    /// Returns the CSS pixels per scene unit, perpendicular to the viewing direction at the center
    /// of the scene.
    pub(crate) fn scale(&self) -> f64 {
        self.lens.eye.camera.intrinsics.fu_px() / self.lens.distance
    }

    /// Projects a point. Returns its position and depth; `None` behind the reader.
    pub(crate) fn place(&self, point: &Point3<f64>) -> Option<(Place, f64)> {
        self.lens.shown(&self.in_eye(point))
    }

    /// Clips a segment to the part in front of the reader, in the eye's frame.
    fn segment(&self, from: &Point3<f64>, to: &Point3<f64>) -> Option<[Point3<f64>; 2]> {
        let (mut a, mut b) = (self.in_eye(from), self.in_eye(to));
        let nearest = self.lens.nearest;
        if a.z.is_nan() || b.z.is_nan() || a.z.max(b.z) <= nearest {
            return None;
        }
        // Moves the nearer end along the segment to the near plane.
        let (nearer, farther) = if a.z < b.z { (&mut a, b) } else { (&mut b, a) };
        if nearer.z < nearest {
            let share = (nearest - nearer.z) / (farther.z - nearer.z);
            *nearer += (farther - *nearer) * share;
            nearer.z = nearest;
        }
        Some([a, b])
    }

    fn places(&self, [a, b]: &[Point3<f64>; 2]) -> Option<(Place, Place)> {
        Some((self.lens.shown(a)?.0, self.lens.shown(b)?.0))
    }

    /// Adds a colored point; `radius` is that of its disk at the center of the scene, CSS pixels.
    pub(crate) fn dot(&mut self, point: &Point3<f64>, radius: f64, color: Rgb) {
        let in_eye = self.in_eye(point);
        if let Some((place, depth)) = self.lens.shown(&in_eye) {
            let scale = (self.lens.distance / depth).clamp(0.6, 2.5);
            self.push(&in_eye, &[place], Mark::Dot(place, radius * scale, color));
        }
    }

    /// Adds a point of a surface, without a rim, so that neighbors merge at any zoom; `side` is
    /// that of its square at the scene's center without zoom, CSS pixels.
    pub(crate) fn speck(&mut self, point: &Point3<f64>, side: f64, color: Rgb) {
        let in_eye = self.in_eye(point);
        if let Some((place, depth)) = self.lens.shown(&in_eye) {
            let scale = (self.lens.distance / depth).clamp(0.6, 2.5);
            let side = side * scale * self.zoom.max(1.0);
            self.push(&in_eye, &[place], Mark::Speck(place, side, color));
        }
    }

    /// Adds a marker of fixed size.
    pub(crate) fn marker(&mut self, point: &Point3<f64>, radius: f64, shape: Shape, role: Role) {
        let in_eye = self.in_eye(point);
        if let Some((place, _)) = self.lens.shown(&in_eye) {
            self.push(&in_eye, &[place], Mark::Marker(place, radius, shape, role));
        }
    }

    /// Adds a straight line.
    pub(crate) fn line(&mut self, from: &Point3<f64>, to: &Point3<f64>, stroke: Stroke) {
        let Some([a, b]) = self.segment(from, to) else {
            return;
        };
        let mut cuts: Vec<f64> = (self.photographs.iter())
            .filter_map(|photograph| photograph.crossing(&a, &b))
            .collect();
        cuts.sort_by(f64::total_cmp);
        let at = |share: f64| a + (b - a) * share;
        let ends = [0.0].into_iter().chain(cuts.iter().copied());
        for (start, end) in ends.zip(cuts.iter().copied().chain([1.0])) {
            let ends = [at(start), at(end)];
            if let Some((from, to)) = self.places(&ends) {
                let middle = at(0.5 * (start + end));
                self.push(&middle, &[from, to], Mark::Line(ends, [from, to], stroke));
            }
        }
    }

    /// Adds a flat, convex, translucent face.
    pub(crate) fn face(&mut self, corners: &[Point3<f64>], role: Role, opacity: f64) {
        let corners: Vec<_> = corners.iter().map(|corner| self.in_eye(corner)).collect();
        if corners
            .iter()
            .any(|corner| !corner.coords.iter().all(|x| x.is_finite()))
        {
            return;
        }
        let mut pieces = vec![half(&corners, |corner| corner.z - self.lens.nearest)];
        for photograph in &self.photographs {
            pieces = (pieces.iter())
                .flat_map(|piece| photograph.halves(piece))
                .collect();
        }
        for piece in pieces.iter().filter(|piece| piece.len() > 2) {
            let places = piece.iter().filter_map(|corner| self.lens.shown(corner));
            let places: Vec<Place> = places.map(|(place, _)| place).collect();
            let sum = piece
                .iter()
                .fold(Vector3::zeros(), |sum, corner| sum + corner.coords);
            let middle = Point3::from(sum / piece.len() as f64);
            if let Some(screen) = Screen::new(piece, places.clone()) {
                self.push(&middle, &places, Mark::Face(screen, role, opacity));
            }
        }
    }

    /// Adds a quadrilateral, such as a piece of a surface, with an outline along the two sides at
    /// its first corner; nothing if a corner is behind the reader.
    pub(crate) fn facet(&mut self, corners: [Point3<f64>; 4], color: Rgb, outline: Stroke) {
        let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|corner| self.place(&corner)) else {
            return;
        };
        let places = [a.0, b.0, c.0, d.0];
        let sum: Vector3<f64> = corners.iter().map(|corner| corner.coords).sum();
        let middle = self.in_eye(&Point3::from(sum / 4.0));
        self.push(&middle, &places, Mark::Facet(places, color, outline));
    }

    /// Adds a camera: its center, and the outline of its image at distance `depth`, with a thicker
    /// upper edge.
    pub(crate) fn frustum(
        &mut self,
        camera: &PosedCamera,
        (width, height): (u32, u32),
        depth: f64,
        role: Role,
        shape: Shape,
    ) {
        let center = camera.center_in_world();
        let (right, bottom) = (f64::from(width) - 0.5, f64::from(height) - 0.5);
        let corners = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)]
            .map(|(u, v)| self.on_picture(camera, &Point2::new(u, v), depth));
        for index in 0..4 {
            let (corner, next) = (&corners[index], &corners[(index + 1) % 4]);
            let top = if index == 0 { 3.0 } else { 1.5 };
            self.line(corner, next, Stroke::solid(role, top));
            self.line(&center, corner, Stroke::solid(role, 1.25));
        }
        self.marker(&center, 4.5, shape, role);
    }

    /// Returns the world position of a pixel on a camera's image at distance `depth`.
    pub(crate) fn on_picture(
        &self,
        camera: &PosedCamera,
        pixel: &Point2<f64>,
        depth: f64,
    ) -> Point3<f64> {
        camera.center_in_world() + camera.ray_in_world(pixel) * depth
    }

    /// Adds a grid on the horizontal plane at height `y`, with `lines` lines to each side of its
    /// middle.
    pub(crate) fn ground(&mut self, middle: &Point3<f64>, y: f64, spacing: f64, lines: i32) {
        let snap = |value: f64| (value / spacing).round() * spacing;
        let (x, z) = (snap(middle.x), snap(middle.z));
        let reach = spacing * f64::from(lines);
        for index in -lines..=lines {
            let offset = spacing * f64::from(index);
            let ends = [
                (
                    Point3::new(x + offset, y, z - reach),
                    Point3::new(x + offset, y, z + reach),
                ),
                (
                    Point3::new(x - reach, y, z + offset),
                    Point3::new(x + reach, y, z + offset),
                ),
            ];
            for (from, to) in ends {
                let ends = self.segment(&from, &to);
                if let Some((a, b)) = ends.and_then(|ends| self.places(&ends)) {
                    self.ground.push((a, b, Stroke::solid(Role::Grid, 1.0)));
                }
            }
        }
    }

    /// Adds the three axes of a camera, `length` long: x solid, y dashed, z dotted.
    pub(crate) fn axes(&mut self, camera: &PosedCamera, length: f64) {
        let world_from_cam = camera.cam_from_world.inverse();
        let origin = camera.center_in_world();
        let strokes = [
            Stroke::solid(Role::Ink, 1.5),
            Stroke::solid(Role::Ink, 1.5).dashed(),
            Stroke::solid(Role::Ink, 1.5).dotted(),
        ];
        for (axis, stroke) in strokes.into_iter().enumerate() {
            let mut direction = Vector3::zeros();
            direction[axis] = length;
            let end = origin + world_from_cam.rotation * direction;
            self.line(&origin, &end, stroke);
            self.label(&end, ["x", "y", "z"][axis], Role::Ink);
        }
    }

    /// Adds a name beside a point, drawn above all marks.
    pub(crate) fn label(&mut self, point: &Point3<f64>, text: &'static str, role: Role) {
        if let Some((place, _)) = self.place(point) {
            self.labels.push((place, text, role));
        }
    }

    /// Draws everything, far to near.
    pub(crate) fn draw(self, canvas: &mut Canvas, panel: &Panel) {
        let marks = arrange(self.marks, &self.photographs, panel.rect);
        canvas.clipped(panel.rect.inset(1.0), |canvas| {
            for (from, to, stroke) in self.ground {
                canvas.line(from, to, stroke);
            }
            let mut photographs = self.photographs.iter().enumerate().peekable();
            let put_up = |canvas: &mut Canvas, photo: &Standing<'_>| {
                canvas.warped_photograph(&photo.corners, &photo.photo_from_page, photo.image);
            };
            for Placed { layer, mark, .. } in marks {
                while let Some((_, photo)) = photographs.next_if(|(index, _)| *index < layer) {
                    put_up(canvas, photo);
                }
                match mark {
                    Mark::Face(screen, role, opacity) => {
                        canvas.polygon(screen.corners(), role, opacity);
                    }
                    Mark::Dot(place, radius, color) => canvas.dot(place, radius, color),
                    Mark::Speck(place, side, color) => canvas.speck(place, side, color),
                    Mark::Marker(place, radius, shape, role) => {
                        canvas.marker(place, radius, shape, role, true);
                    }
                    Mark::Line(_, [from, to], stroke) => canvas.line(from, to, stroke),
                    Mark::Facet(places, color, outline) => {
                        canvas.polygon_color(&places, color);
                        let [corner, next, _, last] = places;
                        canvas.polyline(&[last, corner, next], outline);
                    }
                }
            }
            for (_, photo) in photographs {
                put_up(canvas, photo);
            }
        });
        let mut labels = Labels::new(panel.rect.inset(4.0));
        for (place, ..) in &self.labels {
            labels.keep_free(*place, 5.0);
        }
        for (place, text, role) in self.labels {
            if panel.rect.contains(place) {
                let mut around = Labels::around(place, 7.0);
                // Objects extend upwards from the labeled point, so positions below it are tried
                // first.
                around.swap(0, 3);
                let style = TextStyle::new(role, TEXT).cased();
                labels.draw(canvas, &around, text, style);
            }
        }
    }
}

/// Draws the two handles of a 3D view: a grip to rotate it, and a small cross at its center to pan
/// it.
pub(crate) fn draw_handles(canvas: &mut Canvas, panel: &Panel, orbit: &Orbit) {
    let middle = panel.canvas_from_world(orbit.middle());
    let grip = panel.canvas_from_world((orbit.turn_deg(), orbit.rise_deg()));
    let mut labels = Labels::new(panel.rect.inset(4.0));
    labels.keep_free(middle, 6.0);
    labels.keep_free(grip, 9.0);
    // Small panels, such as on phones, are panned with two fingers, and the cross would only be in
    // the way.
    let is_small = panel.rect.width < SMALLEST;
    let marks = [(grip, 9.0, "turn"), (middle, 5.0, "move")];
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        if !is_small {
            canvas.marker(middle, 4.5, Shape::Plus, Role::Grip, true);
        }
        canvas.grip(grip, Role::Grip);
        for (place, distance, text) in marks.into_iter().take(if is_small { 1 } else { 2 }) {
            let beside = [
                ((place.0 + distance + 3.0, place.1), Align::Start),
                ((place.0 - distance - 3.0, place.1), Align::End),
            ];
            let style = TextStyle::new(Role::Grip, SMALL).cased();
            labels.draw(canvas, &beside, text, style);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Rect;

    fn space(orbit: Orbit) -> Space<'static> {
        let panel = Orbit::panel(Rect::new(0.0, 0.0, 400.0, 300.0));
        let subject = Subject {
            middle: Point3::new(0.0, 0.0, 5.0),
            radius: 2.0,
        };
        Space::new(&panel, &orbit, &subject).unwrap()
    }

    #[test]
    fn the_middle_is_in_the_middle_and_a_drag_moves_the_front_along() {
        let middle = Point3::new(0.0, 0.0, 5.0);
        let front = Point3::new(0.0, 0.0, 4.0);
        for (turn, rise) in [(0.0, 0.0), (40.0, 0.0), (0.0, 30.0), (-170.0, -80.0)] {
            let seen = space(Orbit::new(turn, rise));
            let (place, depth) = seen.place(&middle).unwrap();
            assert!((place.0 - 200.0).abs() < 1e-9 && (place.1 - 150.0).abs() < 1e-9);
            assert!((depth - seen.lens.distance).abs() < 1e-9);
        }
        let (place, _) = space(Orbit::new(30.0, 0.0)).place(&front).unwrap();
        assert!(place.0 > 210.0);
        let (place, _) = space(Orbit::new(0.0, 30.0)).place(&front).unwrap();
        assert!(place.1 > 160.0);
        // y is down, and a larger zoom enlarges.
        let low = Point3::new(0.0, 1.0, 5.0);
        let at = |zoom| {
            space(Orbit::new(0.0, 0.0).zoomed(zoom))
                .place(&low)
                .unwrap()
                .0
                .1
        };
        assert!(at(1.0) > 160.0 && at(2.0) > at(1.0) + 20.0);
    }

    #[test]
    fn lines_are_cut_where_the_reader_stands() {
        let seen = space(Orbit::new(0.0, 0.0).zoomed(6.0));
        let (behind, ahead) = (Point3::new(0.5, 0.2, -50.0), Point3::new(0.5, 0.2, 6.0));
        assert!(seen.place(&behind).is_none());
        let ends = seen.segment(&behind, &ahead).unwrap();
        let (a, b) = seen.places(&ends).unwrap();
        assert!([a.0, a.1, b.0, b.1].iter().all(|x| x.is_finite()));
        assert!(
            seen.segment(&behind, &Point3::new(0.0, 0.0, -40.0))
                .is_none()
        );
        let nowhere = Point3::new(f64::NAN, 0.0, 0.0);
        assert!(seen.segment(&nowhere, &ahead).is_none() && seen.place(&nowhere).is_none());
    }
}
