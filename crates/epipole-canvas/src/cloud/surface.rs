//! Triangles of a scene in a view.

use super::{Orbit, Scene};

/// Brightness of a triangle seen edge-on; it is 1 for one that faces the eye.
const EDGE_ON: f32 = 0.45;

/// A pixel of a triangle.
pub(super) struct Fragment {
    /// Index of the pixel, row by row.
    pub(super) pixel: usize,
    /// Depth along the axis of the view.
    pub(super) depth: f32,
    /// Index of the nearest corner among the points.
    pub(super) point: u32,
    /// Color with shading.
    pub(super) color: [u8; 3],
}

/// A corner in the picture and in the frame of the eye.
#[derive(Debug, Clone, Copy)]
struct Corner {
    pixel: [f32; 2],
    place: [f32; 3],
    color: [u8; 3],
}

/// Draws the triangles, except for those with a corner behind the eye.
///
/// * `plot`: receives the pixels of all triangles, including hidden ones
pub(super) fn draw(
    scene: &Scene,
    orbit: &Orbit,
    size: (usize, usize),
    mut plot: impl FnMut(Fragment),
) {
    let vertices = scene.points.get(scene.first_vertex..).unwrap_or_default();
    let corners = corners(vertices, orbit, size);
    let corner = |vertex: u32| *corners.get(vertex as usize)?;
    for triangle in &scene.triangles {
        if let [Some(a), Some(b), Some(c)] = triangle.map(corner) {
            let points = triangle.map(|vertex| scene.first_vertex as u32 + vertex);
            fill([a, b, c], points, size, &mut plot);
        }
    }
}

/// Projects the vertices; `None` for those behind the eye.
fn corners(
    vertices: &[([f32; 3], [u8; 3])],
    orbit: &Orbit,
    size: (usize, usize),
) -> Vec<Option<Corner>> {
    let rotation = orbit.rotation().cast::<f32>();
    let middle = orbit.middle.coords.cast::<f32>();
    let distance = orbit.distance as f32;
    let focal_px = orbit.focal_px(size) as f32;
    let half = [size.0 as f32 / 2.0, size.1 as f32 / 2.0];
    let corner = |&(place, color): &([f32; 3], [u8; 3])| {
        let mut in_view = rotation * (nalgebra::Vector3::from(place) - middle);
        in_view.z += distance;
        // The comparison is false for NaN.
        let is_in_front = in_view.z > 1e-3 * distance;
        is_in_front.then(|| Corner {
            pixel: [0, 1].map(|axis| in_view[axis] * (focal_px / in_view.z) + half[axis]),
            place: in_view.into(),
            color,
        })
    };
    vertices.iter().map(corner).collect()
}

fn fill(
    corners: [Corner; 3],
    points: [u32; 3],
    (width, height): (usize, usize),
    plot: &mut impl FnMut(Fragment),
) {
    let [a, b, c] = corners.map(|corner| corner.pixel);
    let cross = |o: [f32; 2], p: [f32; 2], q: [f32; 2]| {
        (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])
    };
    let area = cross(a, b, c);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    // Pixels whose centers may be inside; the cast saturates at 0.
    let range = |axis: usize, most: usize| {
        let low = a[axis].min(b[axis]).min(c[axis]);
        let high = a[axis].max(b[axis]).max(c[axis]);
        (low + 0.5) as usize..((high + 0.5).max(0.0) as usize).min(most)
    };
    let shade = shade(corners.map(|corner| corner.place));
    let inverse_depths = corners.map(|corner| 1.0 / corner.place[2]);
    let inverse_area = 1.0 / area;
    for row in range(1, height) {
        for column in range(0, width) {
            let at = [column as f32 + 0.5, row as f32 + 0.5];
            let weights = [cross(b, c, at), cross(c, a, at), cross(a, b, at)];
            let weights = weights.map(|weight| weight * inverse_area);
            let [first, second, third] = weights;
            if !(first >= 0.0 && second >= 0.0 && third >= 0.0) {
                continue;
            }
            let nearest = match (first >= second, first >= third, second >= third) {
                (true, true, _) => 0,
                (_, _, true) => 1,
                _ => 2,
            };
            let mean = |values: [f32; 3]| {
                weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
            };
            let channel = |channel: usize| {
                let values = corners.map(|corner| f32::from(corner.color[channel]));
                (shade * mean(values) + 0.5) as u8
            };
            plot(Fragment {
                pixel: row * width + column,
                depth: 1.0 / mean(inverse_depths),
                point: points[nearest],
                color: [0, 1, 2].map(channel),
            });
        }
    }
}

/// Returns the brightness by the angle between the triangle's normal and the ray to the eye.
fn shade(places: [[f32; 3]; 3]) -> f32 {
    let [a, b, c] = places.map(nalgebra::Vector3::from);
    let normal = (b - a).cross(&(c - a));
    let norms = normal.norm() * a.norm();
    let facing = match norms > 0.0 {
        true => (normal.dot(&a) / norms).abs().min(1.0),
        false => 1.0,
    };
    EDGE_ON + (1.0 - EDGE_ON) * facing
}

#[cfg(test)]
mod tests {
    use super::super::{Frame, Look, Orbit, Scene};

    /// A square at z = 0 of two triangles, and a point behind it.
    fn scene() -> Scene {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let mut scene = Scene {
            points: vec![([0.0, 0.0, 0.5], [0, 0, 255])],
            first_vertex: 1,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Scene::default()
        };
        let corner = |[x, y]: [f32; 2]| ([x, y, 0.0], [200, 100, 0]);
        scene.points.extend(corners.map(corner));
        scene
    }

    fn drawn(scene: &Scene, look: &Look) -> (Frame, Orbit) {
        let mut orbit = Orbit::around(scene, [0.0, 1.0, 0.0]);
        orbit.rotate(0.0, -orbit.pitch_rad);
        let mut frame = Frame::default();
        frame.draw(scene, &orbit, (100, 80), look);
        (frame, orbit)
    }

    #[test]
    fn a_surface_hides_what_is_behind_it_and_has_no_gaps() {
        let scene = scene();
        let (frame, orbit) = drawn(&scene, &Look::default());
        let (low, _) = orbit.project([-1.0, -1.0, 0.0], (100, 80)).unwrap();
        let (high, _) = orbit.project([1.0, 1.0, 0.0], (100, 80)).unwrap();
        let inside = |at: usize, axis: usize| {
            let center = at as f64 + 0.5;
            center > low[axis] + 1e-3 && center < high[axis] - 1e-3
        };
        let mut covered = 0;
        for (n, pixel) in frame.rgba().chunks_exact(4).enumerate() {
            if inside(n % 100, 0) && inside(n / 100, 1) {
                // Seen at an angle of up to 20°.
                assert!(pixel[0] > 180 && pixel[2] == 0, "{n}: {pixel:?}");
                covered += 1;
            }
        }
        assert!(covered > 1000, "{covered}");
        assert_eq!(frame.pick(low[0] + 2.0, low[1] + 2.0, 0), Some(1));
        assert_eq!(frame.pick(high[0] - 2.0, high[1] - 2.0, 0), Some(3));
    }

    #[test]
    fn a_coarse_picture_has_only_the_corners() {
        let look = Look {
            every: 2,
            ..Look::default()
        };
        let (frame, _) = drawn(&scene(), &look);
        assert_eq!(frame.pick(50.0, 40.0, 0), Some(0));
    }

    #[test]
    fn a_triangle_without_corners_or_area_is_not_drawn() {
        let mut scene = scene();
        scene.triangles = vec![[0, 0, 1], [0, 1, 4], [0, 1, u32::MAX]];
        scene.points[3].0 = [f32::NAN; 3];
        scene.triangles.push([0, 1, 2]);
        let (frame, _) = drawn(&scene, &Look::default());
        assert_eq!(frame.pick(50.0, 40.0, 0), Some(0));
        let orange = |pixel: &&[u8]| pixel[2] == 0;
        assert_eq!(frame.rgba().chunks_exact(4).filter(orange).count(), 0);
    }
}
