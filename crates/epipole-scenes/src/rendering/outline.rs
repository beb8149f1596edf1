//! Image regions of bodies, from their bounding boxes.

use crate::objects::body::{Body, Placement};
use crate::scene::{SHADE_M, Scene};
use epipole::camera::PosedCamera;
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Near plane for bounding boxes, meters.
const FRONT_M: f64 = 1e-6;

/// Returns the columns and rows of the projected bounding box of a body, and a lower bound of its
/// depth.
pub(super) fn outline(
    camera: &PosedCamera,
    body: &Body,
    placed: &Placement,
) -> ((i64, i64), (i64, i64), f64) {
    let everywhere = (i64::MIN, i64::MAX);
    if body.is_room() {
        return (everywhere, everywhere, f64::INFINITY);
    }
    let (half, center) = body.shape.bounds();
    let corners = corners(&half).map(|offset| body.world_point(&(center + offset), placed));
    outline_of_box(camera, &corners)
}

/// Returns the offsets of the corners of a box with these half sides from its center.
fn corners(half: &Vector3<f64>) -> [Vector3<f64>; 8] {
    std::array::from_fn(|corner| {
        let sign = |bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)))
    })
}

/// Returns the same for a box with these corners in the world.
#[inline(never)]
fn outline_of_box(
    camera: &PosedCamera,
    corners: &[Vector3<f64>; 8],
) -> ((i64, i64), (i64, i64), f64) {
    let corners = corners.map(|corner| camera.cam_from_world * Point3::from(corner));
    let nearest = corners.iter().fold(f64::INFINITY, |z, x| z.min(x.z)) - 1e-9;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut include = |x_in_cam: &Point3<f64>| {
        if let Ok(pixel) = camera.camera.intrinsics.project(x_in_cam) {
            for i in 0..2 {
                low[i] = low[i].min(pixel[i]);
                high[i] = high[i].max(pixel[i]);
            }
        }
    };
    for (index, a) in corners.iter().enumerate() {
        if a.z >= FRONT_M {
            include(a);
        }
        // Edges from this corner that cross the near plane.
        for bit in 0..3 {
            let b = &corners[index ^ (1 << bit)];
            if a.z < FRONT_M && b.z >= FRONT_M {
                include(&(b + (a - b) * ((b.z - FRONT_M) / (b.z - a.z))));
            }
        }
    }
    if low[0] > high[0] {
        // Entirely behind the camera.
        return ((1, 0), (1, 0), nearest);
    }
    // One more pixel for the rays between pixel centers. The casts saturate.
    let range = |i: usize| {
        (
            (low[i].floor() as i64).saturating_sub(1),
            (high[i].ceil() as i64).saturating_add(1),
        )
    };
    (range(0), range(1), nearest)
}

impl Scene {
    /// Returns the columns and rows that may show the movable object or its shade; all other pixels
    /// are independent of its position. Empty in a scene without one.
    ///
    /// * `camera`: for a picture of this width and height
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole_scenes::{MovableKind, MovableObject, Scene, long_table_camera};
    /// let ball = MovableObject { kind: MovableKind::Ball, x_m: 0.0, z_m: 3.5 };
    /// let camera = long_table_camera(0.0, 640, 480)?;
    /// let [columns, rows] = Scene::long_table(ball)?.pixels_of_movable(&camera, (640, 480));
    /// // It is 700 / 3.5 · 0.22 = 44 px wide, and its shade reaches farther; most of the picture is not concerned.
    /// assert!(columns.start < 298 && columns.end > 342);
    /// assert!(columns.len() < 320 && rows.len() < 120);
    /// # Ok(()) }
    /// ```
    pub fn pixels_of_movable(
        &self,
        camera: &PosedCamera,
        (width, height): (u32, u32),
    ) -> [Range<u32>; 2] {
        let Some((movable, placed)) = &self.movable else {
            return [0..0, 0..0];
        };
        let half = Vector3::new(1.0, 0.0, 1.0) * (0.5 * SHADE_M * placed.scale);
        let shade = corners(&half).map(|offset| placed.foot + offset);
        let (mut columns, mut rows, _) = outline_of_box(camera, &shade);
        // Empty ranges behind the camera must not be joined, as they would add a corner.
        let join = |a: (i64, i64), b: (i64, i64)| (a.0.min(b.0), a.1.max(b.1));
        for body in &movable.bodies {
            let own = outline(camera, body, placed);
            (columns, rows) = (join(columns, own.0), join(rows, own.1));
        }
        [(columns, width), (rows, height)].map(|((first, last), size)| {
            let place = |at: i64| at.clamp(0, i64::from(size)) as u32;
            place(first)..place(last.saturating_add(1))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rendering::{Photograph, Sampling};
    use crate::sets::{MovableKind, MovableObject, still_life_camera};
    use epipole::math::random::Random;
    use nalgebra::Isometry3;

    /// Drafts are rendered again only in this range.
    #[test]
    fn pixels_elsewhere_are_unchanged_when_the_object_moves() {
        let mut random = Random::new(8);
        let camera = PosedCamera {
            cam_from_world: Isometry3::translation(-0.2, 0.4, 0.1),
            ..still_life_camera(64, 48)
        };
        let mut num_inside = 0;
        for kind in [Some(MovableKind::Ball), Some(MovableKind::Mug), None] {
            let mut last: Option<(Photograph, Vec<bool>)> = None;
            for _ in 0..16 {
                let (x_m, z_m) = (random.uniform(-0.8, 0.8), random.uniform(0.6, 4.0));
                let scene = match kind {
                    Some(kind) => Scene::long_table(MovableObject { kind, x_m, z_m }),
                    None => Scene::studio([0.2 * x_m, z_m.min(2.4)], 0.2 * z_m),
                };
                let scene = scene.unwrap();
                let draft = scene.render(&camera, 64, 48, Sampling::Draft).unwrap();
                let [columns, rows] = scene.pixels_of_movable(&camera, (64, 48));
                let is_inside =
                    |place: u32| columns.contains(&(place % 64)) && rows.contains(&(place / 64));
                let inside: Vec<bool> = (0..64 * 48).map(is_inside).collect();
                num_inside += inside.iter().filter(|&&inside| inside).count();
                if let Some((before, inside_before)) = last {
                    for (place, (u, v, color)) in draft.image.enumerate_pixels().enumerate() {
                        let may_differ = inside[place] || inside_before[place];
                        assert!(may_differ || before.image.get_pixel(u, v) == color);
                    }
                }
                last = Some((draft, inside));
            }
        }
        assert!(num_inside < 48 * 64 * 48 / 2, "{num_inside}");
        let [columns, rows] = Scene::still_life().pixels_of_movable(&camera, (64, 48));
        assert!(columns.is_empty() && rows.is_empty());
    }
}
