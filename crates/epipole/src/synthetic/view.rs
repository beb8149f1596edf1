//! A scene as one camera sees it: which bodies may show where, and what a ray finds.

use super::body::{Body, Placement};
use super::light::{Decal, Detail, LightMap, Lighting};
use super::render::Sampling;
use super::scene::{SHADE_M, Scene};
use super::shading::{self, Look};
use super::shape::TOP;
use super::shape::{Contact, Ray};
use crate::camera::PosedCamera;
use nalgebra::{Matrix3, Point2, Point3, Vector2, Vector3};
use std::ops::Range;

/// Side of the squares of pixels that share a list of candidates.
pub(super) const TILE: u32 = 8;
const NEAR: f64 = 1e-9;
/// Depth beyond which things are in front of the camera, meters.
const FRONT_M: f64 = 1e-6;

/// A body as one camera sees it.
struct Seen<'a> {
    body: &'a Body,
    lights: &'a [LightMap],
    origin: Vector3<f64>,
    local_from_cam: Matrix3<f64>,
    /// How many times larger it is than it was built.
    scale: f64,
    /// Pixels that may show it: columns and rows, both ends included.
    columns: (i64, i64),
    rows: (i64, i64),
    /// The same: left, right, top and bottom.
    edges: [f64; 4],
    /// No point of it is nearer than this depth; infinite for the room, which is behind all.
    nearest: f64,
    /// Its number in the scene.
    number: usize,
}

impl Seen<'_> {
    /// Whether the ray through an image point may meet it.
    #[inline(always)]
    fn may_be_at(&self, u: f64, v: f64) -> bool {
        let [left, right, top, bottom] = self.edges;
        (u >= left) & (u <= right) & (v >= top) & (v <= bottom)
    }
}

/// What one ray found.
#[derive(Clone, Copy, Default)]
pub(super) struct Sample {
    /// Body and chart.
    pub(super) key: u32,
    pub(super) depth_m: f32,
    pub(super) inverse_depth: f32,
    pub(super) color: [f32; 3],
}

/// The camera's side of a picture that is to be rendered.
pub(super) struct View<'a> {
    seen: Vec<Seen<'a>>,
    lighting: &'a Lighting,
    /// Shade of the movable thing, where it stands, and the number of the body it falls on.
    shade: Option<(&'a Decal, Placement, usize)>,
    center: Vector3<f64>,
    world_from_cam: Matrix3<f64>,
    principal: Point2<f64>,
    inverse_focal: Vector2<f64>,
    pixel_rad: f64,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) sampling: Sampling,
}

impl<'a> View<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        camera: &PosedCamera,
        width: u32,
        height: u32,
        sampling: Sampling,
    ) -> Self {
        let center = camera.center_in_world().coords;
        let k = &camera.intrinsics;
        let inverse_focal = Vector2::new(1.0 / k.fu_px(), 1.0 / k.fv_px());
        let cam_from_world = camera.cam_from_world.rotation.to_rotation_matrix();
        let world_from_cam = cam_from_world.matrix().transpose();
        let detail = match sampling {
            Sampling::Draft => Detail::Sketch,
            Sampling::Full => Detail::Full,
        };
        let all = scene.placed().zip(scene.lights(detail)).enumerate().map(
            |(number, ((body, placed), lights))| {
                let (columns, rows, nearest) = outline(camera, body, &placed);
                Seen {
                    body,
                    lights,
                    origin: body.local_point(&center, &placed),
                    local_from_cam: body.local_from_world * (world_from_cam / placed.scale),
                    scale: placed.scale,
                    columns,
                    rows,
                    edges: [columns.0, columns.1, rows.0, rows.1].map(|edge| edge as f64),
                    nearest,
                    number,
                }
            },
        );
        // From front to back; the order of bodies decides between equals.
        let mut seen: Vec<Seen> = Vec::new();
        for body in all {
            let is_before = |other: &Seen| other.nearest.total_cmp(&body.nearest).is_le();
            seen.insert(seen.partition_point(is_before), body);
        }
        Self {
            lighting: &scene.fixed.lighting,
            shade: scene.shade(detail),
            seen,
            center,
            world_from_cam,
            principal: k.principal_point(),
            inverse_focal,
            pixel_rad: (inverse_focal.x * inverse_focal.y).sqrt(),
            width,
            height,
            sampling,
        }
    }

    /// For each tile of a row of tiles, the bodies that it may show.
    pub(super) fn candidates(&self, tile_row: u32, lists: &mut Vec<Vec<u16>>) {
        lists.resize(self.width.div_ceil(TILE) as usize, Vec::new());
        lists.iter_mut().for_each(Vec::clear);
        let tile = i64::from(TILE);
        let (top, bottom) = (
            i64::from(tile_row) * tile,
            i64::from(tile_row) * tile + tile - 1,
        );
        for (index, seen) in self.seen.iter().enumerate() {
            if seen.rows.1 < top || seen.rows.0 > bottom {
                continue;
            }
            let first = seen.columns.0.max(0) / tile;
            let last = seen.columns.1.min(i64::from(self.width) - 1);
            if last < 0 {
                continue;
            }
            for list in lists
                .iter_mut()
                .take((last / tile + 1) as usize)
                .skip(first as usize)
            {
                list.push(index as u16);
            }
        }
    }

    /// What the ray through an image point finds among the candidates.
    #[inline]
    pub(super) fn trace(&self, u: f64, v: f64, candidates: &[u16]) -> Sample {
        let x = (u - self.principal.x) * self.inverse_focal.x;
        let y = (v - self.principal.y) * self.inverse_focal.y;
        let turn = |m: &Matrix3<f64>| {
            Vector3::new(
                m.m11 * x + m.m12 * y + m.m13,
                m.m21 * x + m.m22 * y + m.m23,
                m.m31 * x + m.m32 * y + m.m33,
            )
        };
        let mut nearest = Contact {
            along: f64::INFINITY,
            part: 0,
        };
        let mut found = usize::MAX;
        for &index in candidates {
            let seen = &self.seen[usize::from(index)];
            if seen.nearest > nearest.along {
                break;
            }
            // A tile shows much that one ray passes by.
            if !seen.may_be_at(u, v) {
                continue;
            }
            let ray = Ray {
                origin: seen.origin,
                direction: turn(&seen.local_from_cam),
            };
            if let Some(contact) = seen.body.shape.meet(&ray, NEAR, nearest.along) {
                nearest = contact;
                found = usize::from(index);
            }
        }
        let Some(seen) = self.seen.get(found) else {
            return Sample {
                key: u32::MAX,
                depth_m: f32::MAX,
                inverse_depth: 0.0,
                color: [0.0; 3],
            };
        };
        let local = seen.origin + turn(&seen.local_from_cam) * nearest.along;
        let place = seen.body.shape.place(&local, nearest.part);
        let direction_in_world = turn(&self.world_from_cam);
        let x_in_world = self.center + direction_in_world * nearest.along;
        let decal = match &self.shade {
            // Shade lies on what the thing stands on, not on the edges of that.
            Some((decal, placed, ground)) if *ground == seen.number && place.chart == TOP => {
                let from_foot = (x_in_world - placed.foot) / placed.scale;
                decal.sample(from_foot.x, from_foot.z)
            }
            _ => None,
        };
        let look = Look {
            x_in_world: shading::single(&x_in_world),
            direction_in_world: shading::single(&direction_in_world),
            pixel_m: (nearest.along * self.pixel_rad / seen.scale) as f32,
            decal,
            smooth: self.sampling == Sampling::Full,
        };
        let color = shading::color(seen.body, seen.lights, &place, self.lighting, &look);
        Sample {
            key: (seen.number as u32) << 8 | place.chart as u32,
            depth_m: nearest.along as f32,
            inverse_depth: 1.0 / nearest.along as f32,
            color,
        }
    }
}

/// Columns and rows between which a body appears, around the corners of its box, and a depth
/// that is not beyond its nearest point.
fn outline(camera: &PosedCamera, body: &Body, placed: &Placement) -> ((i64, i64), (i64, i64), f64) {
    let everywhere = (i64::MIN, i64::MAX);
    if body.is_room() {
        return (everywhere, everywhere, f64::INFINITY);
    }
    let (half, center) = body.shape.bounds();
    let corners = corners(&half).map(|offset| body.world_point(&(center + offset), placed));
    outline_of_box(camera, &corners)
}

/// Where the corners of a box with these half sides are from its middle.
fn corners(half: &Vector3<f64>) -> [Vector3<f64>; 8] {
    std::array::from_fn(|corner| {
        let sign = |bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)))
    })
}

/// The same of a box with these corners in the world.
#[inline(never)]
fn outline_of_box(
    camera: &PosedCamera,
    corners: &[Vector3<f64>; 8],
) -> ((i64, i64), (i64, i64), f64) {
    let corners = corners.map(|corner| camera.cam_from_world * Point3::from(corner));
    let nearest = corners.iter().fold(f64::INFINITY, |z, x| z.min(x.z)) - 1e-9;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut include = |x_in_cam: &Point3<f64>| {
        if let Ok(pixel) = camera.intrinsics.project(x_in_cam) {
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
        // The edges from this corner that cross the plane just in front of the camera.
        for bit in 0..3 {
            let b = &corners[index ^ (1 << bit)];
            if a.z < FRONT_M && b.z >= FRONT_M {
                include(&(b + (a - b) * ((b.z - FRONT_M) / (b.z - a.z))));
            }
        }
    }
    if low[0] > high[0] {
        // Nothing of it lies in front of the camera.
        return ((1, 0), (1, 0), nearest);
    }
    // One pixel more for the rays between pixel centers. The casts saturate.
    let range = |i: usize| {
        (
            (low[i].floor() as i64).saturating_sub(1),
            (high[i].ceil() as i64).saturating_add(1),
        )
    };
    (range(0), range(1), nearest)
}

impl Scene {
    /// Columns and rows that may show the thing that can be moved, or its shade; no other pixel tells where it is. None
    /// in a scene without one.
    ///
    /// * `camera`: for a picture of this width and height
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::synthetic::{MovableKind, MovableObject, Scene, long_table_camera};
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
        // What is not before the camera has no columns and rows, and joined to others makes them a corner more.
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
    use crate::math::random::Random;
    use crate::synthetic::{MovableKind, MovableObject, Photograph, still_life_camera};
    use nalgebra::Isometry3;

    /// Drafts are made anew only there.
    #[test]
    fn elsewhere_nothing_changes_when_the_thing_moves() {
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
