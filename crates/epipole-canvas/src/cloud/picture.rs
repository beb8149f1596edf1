//! Photographs in a scene: textured parallelograms with per-pixel depth.

use super::Orbit;
use nalgebra::{Matrix3, Point3, Vector3};
use std::sync::Arc;

/// A photograph on a parallelogram.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Position of its upper left corner.
    pub corner: [f32; 3],
    /// Vector from there to the upper right corner.
    pub right: [f32; 3],
    /// Vector from the upper left to the lower left corner.
    pub down: [f32; 3],
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Red, green, blue, row by row.
    pub rgb: Arc<[u8]>,
}

/// A picture in a view, with its mapping from pixels of the view and its depth.
pub(super) struct ProjectedPicture<'a> {
    picture: &'a Picture,
    /// Maps a ray `(x, y, 1)` of the view to `(s, t, 1) / depth`; s and t are fractions of the two
    /// sides.
    fractions_of_ray: Matrix3<f64>,
    focal_px: f64,
    half: (f64, f64),
    /// Columns and rows that may show it.
    pub(super) columns: std::ops::Range<usize>,
    pub(super) rows: std::ops::Range<usize>,
}

impl<'a> ProjectedPicture<'a> {
    /// Prepares a picture; `None` if it is edge-on, empty or out of view.
    pub(super) fn new(picture: &'a Picture, orbit: &Orbit, size: (usize, usize)) -> Option<Self> {
        let (width, height) = picture.size;
        if width == 0 || height == 0 || picture.rgb.len() < 3 * width * height {
            return None;
        }
        let rotation = orbit.rotation();
        let wide = |place: [f32; 3]| Vector3::from(place.map(f64::from));
        let corner = rotation * (Point3::from(wide(picture.corner)) - orbit.middle)
            + Vector3::new(0.0, 0.0, orbit.distance);
        let (right, down) = (
            rotation * wide(picture.right),
            rotation * wide(picture.down),
        );
        let sides = Matrix3::from_columns(&[right, down, corner]);
        let fractions_of_ray = sides
            .try_inverse()
            .filter(|m| m.iter().all(|x| x.is_finite()))?;
        let focal_px = orbit.focal_px(size);
        let half = (size.0 as f64 / 2.0, size.1 as f64 / 2.0);
        let corners = [corner, corner + right, corner + right + down, corner + down];
        let (mut columns, mut rows) = (0..size.0, 0..size.1);
        if corners.iter().all(|c| c.z > 1e-3 * orbit.distance) {
            // In front of the view, it lies within its projected corners.
            let span = |axis: usize, half: f64, most: usize| {
                let projected = corners.map(|c| c[axis] / c.z * focal_px + half);
                let low = projected.iter().copied().fold(f64::INFINITY, f64::min);
                let high = projected.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (low.floor().max(0.0) as usize).min(most)..(high.ceil().max(0.0) as usize).min(most)
            };
            (columns, rows) = (span(0, half.0, size.0), span(1, half.1, size.1));
        } else if corners.iter().all(|c| c.z <= 0.0) {
            return None;
        }
        Some(Self {
            picture,
            fractions_of_ray,
            focal_px,
            half,
            columns,
            rows,
        })
    }

    /// Returns the depth and the color of the picture at a pixel of the view; `None` outside of it
    /// and behind the view.
    pub(super) fn sample(&self, column: usize, row: usize) -> Option<(f32, [u8; 3])> {
        let x = (column as f64 + 0.5 - self.half.0) / self.focal_px;
        let y = (row as f64 + 0.5 - self.half.1) / self.focal_px;
        let fractions = self.fractions_of_ray * Vector3::new(x, y, 1.0);
        // The comparison is false for NaN.
        let is_in_front = fractions.z > 0.0;
        if !is_in_front {
            return None;
        }
        let (s, t) = (fractions.x / fractions.z, fractions.y / fractions.z);
        if !((0.0..1.0).contains(&s) && (0.0..1.0).contains(&t)) {
            return None;
        }
        let (width, height) = self.picture.size;
        let at = 3 * ((t * height as f64) as usize * width + (s * width as f64) as usize);
        let color = self.picture.rgb.get(at..at + 3)?.try_into().ok()?;
        Some(((1.0 / fractions.z) as f32, color))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Frame, Look, Scene};
    use super::*;

    /// A picture of 2 × 2 pixels: red, green, blue, white, in the plane z = 0.
    fn picture() -> Picture {
        Picture {
            corner: [-1.0, -1.0, 0.0],
            right: [2.0, 0.0, 0.0],
            down: [0.0, 2.0, 0.0],
            size: (2, 2),
            rgb: [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]]
                .concat()
                .into(),
        }
    }

    fn drawn(scene: &Scene, yaw_rad: f64) -> Frame {
        let mut orbit = Orbit::around(&Scene::default(), [0.0, 1.0, 0.0]);
        orbit.rotate(yaw_rad, -orbit.pitch_rad);
        orbit.distance = 4.0;
        let look = Look {
            background: [9; 3],
            ..Look::default()
        };
        let mut frame = Frame::default();
        frame.draw(scene, &orbit, (100, 100), &look);
        frame
    }

    fn color(frame: &Frame, column: usize, row: usize) -> [u8; 3] {
        let at = 4 * (row * frame.size().0 + column);
        [0, 1, 2].map(|channel| frame.rgba()[at + channel])
    }

    #[test]
    fn a_picture_is_upright_and_mirrored_from_behind() {
        let scene = Scene {
            pictures: vec![picture()],
            ..Scene::default()
        };
        let frame = drawn(&scene, 0.0);
        // Half a side is focal length over distance: 1.2 × 100 / 4 = 30 pixels.
        assert_eq!(color(&frame, 30, 30), [255, 0, 0]);
        assert_eq!(color(&frame, 70, 30), [0, 255, 0]);
        assert_eq!(color(&frame, 30, 70), [0, 0, 255]);
        assert_eq!(color(&frame, 70, 70), [255, 255, 255]);
        for (column, row) in [(18, 50), (81, 50), (50, 18), (50, 81)] {
            assert_eq!(color(&frame, column, row), [9; 3], "{column} {row}");
        }
        for (column, row) in [(20, 50), (79, 50), (50, 20), (50, 79)] {
            assert_ne!(color(&frame, column, row), [9; 3], "{column} {row}");
        }
        let behind = drawn(&scene, std::f64::consts::PI);
        assert_eq!(color(&behind, 30, 30), [0, 255, 0]);
        assert_eq!(behind.pick(50.0, 50.0, 5), None);
    }

    #[test]
    fn points_hide_a_picture_behind_them_and_are_hidden_by_one_before_them() {
        for (z, picked) in [(-0.5, Some(0)), (0.5, None)] {
            let scene = Scene {
                points: vec![([0.3, 0.3, z], [1, 2, 3])],
                pictures: vec![picture()],
                ..Scene::default()
            };
            let frame = drawn(&scene, 0.0);
            let at = 50.0 + 0.3 * 120.0 / (4.0 + f64::from(z));
            assert_eq!(frame.pick(at, at, 1), picked, "{z}");
        }
    }

    #[test]
    fn from_its_edge_or_with_too_few_pixels_it_is_invisible() {
        let scene = |picture| Scene {
            pictures: vec![picture],
            ..Scene::default()
        };
        let empty = Picture {
            rgb: Vec::new().into(),
            ..picture()
        };
        let flat = Picture {
            down: [1.0, 0.0, 0.0],
            ..picture()
        };
        let nonsense = Picture {
            right: [f32::NAN, 0.0, 0.0],
            ..picture()
        };
        for picture in [empty, flat, nonsense] {
            let frame = drawn(&scene(picture), 0.3);
            assert!(
                frame
                    .rgba()
                    .chunks_exact(4)
                    .all(|pixel| pixel[..3] == [9; 3])
            );
        }
        // A picture around the viewer: no part is drawn twice, and nothing panics.
        let mut around = picture();
        around.corner = [-1.0, -1.0, -4.0];
        around.right = [2.0, 0.0, 8.0];
        drawn(&scene(around), 0.0);
    }
}
