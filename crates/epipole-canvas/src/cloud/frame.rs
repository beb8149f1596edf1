//! Rendered view of a scene, with the depth and the point index of each pixel.

use super::picture::ProjectedPicture;
use super::{Line, Orbit, Scene, surface};

/// Options for drawing a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Side of a point at the orbit's distance, pixels.
    pub point_px: f64,
    /// Stride over the points; above 1 for coarse pictures during motion, without triangles.
    pub every: usize,
    /// Color of the background.
    pub background: [u8; 3],
}

impl Default for Look {
    fn default() -> Self {
        Self {
            point_px: 2.0,
            every: 1,
            background: [255; 3],
        }
    }
}

/// Index for no point.
const NONE: u32 = u32::MAX;

/// A rendered view. Its memory is reused for the next one.
#[derive(Debug, Clone, Default)]
pub struct Frame {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
    depth: Vec<f32>,
    point: Vec<u32>,
}

impl Frame {
    /// Returns width and height, pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Returns the pixels: red, green, blue, opaque, row by row.
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// Draws the scene, replacing the previous picture.
    pub fn draw(&mut self, scene: &Scene, orbit: &Orbit, size: (usize, usize), look: &Look) {
        (self.width, self.height) = size;
        let pixels = size.0 * size.1;
        let [r, g, b] = look.background;
        self.rgba.clear();
        self.rgba.resize(4 * pixels, 255);
        for pixel in self.rgba.chunks_exact_mut(4) {
            pixel.copy_from_slice(&[r, g, b, 255]);
        }
        self.depth.clear();
        self.depth.resize(pixels, f32::INFINITY);
        self.point.clear();
        self.point.resize(pixels, NONE);
        if pixels == 0 {
            return;
        }
        self.points(scene, orbit, look);
        if look.every <= 1 {
            surface::draw(scene, orbit, size, |fragment| {
                let surface::Fragment {
                    pixel,
                    depth,
                    point,
                    color,
                } = fragment;
                self.plot(pixel, depth, point, color);
            });
        }
        for picture in &scene.pictures {
            if let Some(projected) = ProjectedPicture::new(picture, orbit, size) {
                self.picture(&projected);
            }
        }
        for line in &scene.lines {
            self.line(line, orbit);
        }
    }

    fn points(&mut self, scene: &Scene, orbit: &Orbit, look: &Look) {
        let size = (self.width, self.height);
        let rotation = orbit.rotation().cast::<f32>();
        let focal_px = orbit.focal_px(size) as f32;
        let middle = orbit.middle.coords.cast::<f32>();
        let distance = orbit.distance as f32;
        let (half_u, half_v) = (size.0 as f32 / 2.0, size.1 as f32 / 2.0);
        let near = 1e-3 * distance;
        let side_at_middle = look.point_px as f32 * distance;
        let [m00, m10, m20, m01, m11, m21, m02, m12, m22]: [f32; 9] = {
            let mut values = [0.0; 9];
            values.copy_from_slice(rotation.as_slice());
            values
        };
        let num_points = match look.every {
            0 | 1 if !scene.triangles.is_empty() => scene.first_vertex,
            _ => scene.points.len(),
        };
        let points = scene.points.iter().take(num_points).enumerate();
        for (index, (place, color)) in points.step_by(look.every.max(1)) {
            let (x, y, z) = (
                place[0] - middle.x,
                place[1] - middle.y,
                place[2] - middle.z,
            );
            let depth = m20 * x + m21 * y + m22 * z + distance;
            // The comparison is false for NaN.
            let is_in_front = depth > near;
            if !is_in_front {
                continue;
            }
            let scale = focal_px / depth;
            let u = (m00 * x + m01 * y + m02 * z) * scale + half_u;
            let v = (m10 * x + m11 * y + m12 * z) * scale + half_v;
            if !(u > -8.0 && v > -8.0 && u < size.0 as f32 + 8.0 && v < size.1 as f32 + 8.0) {
                continue;
            }
            let side = (side_at_middle / depth).clamp(1.0, 7.0);
            // Adding 0.5 rounds, and the cast saturates at 0: browsers have no instruction for
            // `round`.
            let from = |at: f32| (at - side / 2.0 + 0.5) as usize;
            let to = |at: f32, most: usize| ((at + side / 2.0 + 0.5) as usize).min(most);
            for row in from(v)..to(v, size.1) {
                for column in from(u)..to(u, size.0) {
                    self.plot(row * size.0 + column, depth, index as u32, *color);
                }
            }
        }
    }

    fn picture(&mut self, projected: &ProjectedPicture<'_>) {
        for row in projected.rows.clone() {
            for column in projected.columns.clone() {
                let Some((depth, color)) = projected.sample(column, row) else {
                    continue;
                };
                self.plot(row * self.width + column, depth, NONE, color);
            }
        }
    }

    fn line(&mut self, line: &Line, orbit: &Orbit) {
        let size = (self.width, self.height);
        let (Some((from, near)), Some((to, far))) =
            (orbit.project(line.from, size), orbit.project(line.to, size))
        else {
            return;
        };
        let Some((start, end)) = inside(from, to, size) else {
            return;
        };
        let (du, dv) = (to[0] - from[0], to[1] - from[1]);
        // Two steps per pixel, since rounding with one would leave gaps.
        let steps = (2.0 * (end - start) * du.abs().max(dv.abs()))
            .ceil()
            .clamp(1.0, 40_000.0);
        for step in 0..=steps as usize {
            let fraction = start + (end - start) * step as f64 / steps;
            let (u, v) = (from[0] + fraction * du, from[1] + fraction * dv);
            // Inverse depth is linear in the picture.
            let depth = (1.0 / ((1.0 - fraction) / near + fraction / far)) as f32;
            if !(u >= 0.0 && v >= 0.0 && u < size.0 as f64 && v < size.1 as f64) {
                continue;
            }
            let pixel = v as usize * size.0 + u as usize;
            self.plot(pixel, depth, NONE, line.color);
        }
    }

    /// Colors a pixel unless it shows something nearer.
    fn plot(&mut self, pixel: usize, depth: f32, point: u32, color: [u8; 3]) {
        if depth < self.depth[pixel] {
            self.depth[pixel] = depth;
            self.point[pixel] = point;
            self.rgba[4 * pixel..4 * pixel + 3].copy_from_slice(&color);
        }
    }

    /// Returns the index of the point drawn nearest to a pixel, at most `radius_px` pixels away.
    pub fn pick(&self, u: f64, v: f64, radius_px: usize) -> Option<usize> {
        if !(u.is_finite() && v.is_finite()) {
            return None;
        }
        let reach = radius_px as i64;
        let mut best: Option<(i64, usize)> = None;
        for dv in -reach..=reach {
            for du in -reach..=reach {
                let (column, row) = (u.floor() as i64 + du, v.floor() as i64 + dv);
                let is_inside = (0..self.width as i64).contains(&column)
                    && (0..self.height as i64).contains(&row);
                if !is_inside {
                    continue;
                }
                let point = self.point[row as usize * self.width + column as usize];
                let away = du * du + dv * dv;
                if point != NONE && best.is_none_or(|(least, _)| away < least) {
                    best = Some((away, point as usize));
                }
            }
        }
        best.map(|(_, point)| point)
    }
}

/// Returns the part of a line within the picture, as fractions of its length.
fn inside(from: [f64; 2], to: [f64; 2], size: (usize, usize)) -> Option<(f64, f64)> {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for (axis, side) in [size.0 as f64, size.1 as f64].into_iter().enumerate() {
        let step = to[axis] - from[axis];
        if step.abs() < 1e-12 {
            if !(0.0..=side).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let (a, b) = (-from[axis] / step, (side - from[axis]) / step);
        start = start.max(a.min(b));
        end = end.min(a.max(b));
    }
    (start < end).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::default();
        for n in 0..200_u32 {
            let place = [n % 10, n / 10 % 10, n / 100].map(|k| k as f32 * 0.1);
            scene.points.push((place, [n as u8, 100, 50]));
        }
        scene
    }

    #[test]
    fn the_nearer_point_hides_the_one_behind_it() {
        let mut scene = Scene::default();
        scene.points.push(([0.0, 0.0, 1.0], [255, 0, 0]));
        scene.points.push(([0.0, 0.0, -1.0], [0, 255, 0]));
        let mut orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
        orbit.rotate(0.0, -orbit.pitch_rad);
        let mut frame = Frame::default();
        frame.draw(&scene, &orbit, (40, 40), &Look::default());
        assert_eq!(frame.pick(20.0, 20.0, 2), Some(1));
        // Seen from behind, the other point is in front.
        orbit.rotate(std::f64::consts::PI, 0.0);
        frame.draw(&scene, &orbit, (40, 40), &Look::default());
        assert_eq!(frame.pick(20.0, 20.0, 2), Some(0));
    }

    #[test]
    fn a_click_finds_the_point_that_is_shown_there() {
        let (scene, size) = (scene(), (300, 200));
        let orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
        let mut frame = Frame::default();
        frame.draw(&scene, &orbit, size, &Look::default());
        let mut found = 0;
        for (index, (place, _)) in scene.points.iter().enumerate() {
            let ([u, v], _) = orbit.project(*place, size).expect("all are in front");
            if frame.pick(u, v, 0) == Some(index) {
                found += 1;
            }
        }
        assert!(found > 150, "{found}");
    }

    #[test]
    fn nothing_and_nonsense_are_drawn_as_nothing() {
        let mut frame = Frame::default();
        let mut scene = Scene::default();
        let orbit = Orbit::around(&scene, [0.0; 3]);
        frame.draw(&scene, &orbit, (0, 0), &Look::default());
        assert_eq!(frame.pick(0.0, 0.0, 5), None);
        scene.points.push(([f32::NAN; 3], [0; 3]));
        scene.lines.push(Line {
            from: [f32::INFINITY; 3],
            to: [0.0; 3],
            color: [0; 3],
        });
        let orbit = Orbit::around(&scene, [0.0, 0.0, 1.0]);
        frame.draw(&scene, &orbit, (30, 20), &Look::default());
        assert!(frame.rgba().iter().all(|&value| value == 255));
        assert_eq!(frame.pick(f64::NAN, 3.0, 5), None);
    }

    #[test]
    fn lines_are_cut_at_the_edges_and_hide_behind_points() {
        let mut scene = Scene::default();
        scene.lines.push(Line {
            from: [-1e6, 0.0, 0.0],
            to: [1e6, 0.0, 0.0],
            color: [0, 0, 255],
        });
        let mut orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
        orbit.rotate(0.0, -orbit.pitch_rad);
        let mut frame = Frame::default();
        frame.draw(&scene, &orbit, (50, 30), &Look::default());
        let blue = frame
            .rgba()
            .chunks_exact(4)
            .filter(|p| p[..3] == [0, 0, 255])
            .count();
        assert_eq!(blue, 50);
    }

    #[test]
    fn panning_moves_the_picture_with_the_hand() {
        let (scene, size) = (scene(), (300, 200));
        let mut orbit = Orbit::around(&scene, [0.1, 1.0, 0.2]);
        let middle = orbit.middle.cast::<f32>().into();
        orbit.pan(25.0, -10.0, size);
        let ([u, v], _) = orbit.project(middle, size).expect("it is in front");
        assert!(
            (u - 175.0).abs() < 1e-3 && (v - 90.0).abs() < 1e-3,
            "{u} {v}"
        );
    }
}
