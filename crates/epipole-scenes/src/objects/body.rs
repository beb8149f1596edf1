//! Objects in a room: shape, placement and paint.

use super::proxy::Proxy;
use crate::paint::texture::Texture;
use crate::shape::{Contact, Cuboid, Ray, Shape};
use nalgebra::{Matrix3, Point3, Vector3};
use std::sync::Arc;

/// Appearance of one chart of a shape.
#[derive(Debug, Clone)]
pub(crate) struct Paint {
    pub(crate) texture: Arc<Texture>,
    /// Scale from chart to texture coordinates, followed by `offset`.
    pub(crate) scale: [f32; 2],
    pub(crate) offset: [f32; 2],
    pub(crate) tint: [f32; 3],
    /// Strength of reflections, 0 for matte surfaces, modulated by the texture's fourth channel.
    pub(crate) gloss: f32,
    /// Emitted light, such as from a window pane.
    pub(crate) glow: f32,
    /// Cells of the light map across and down.
    pub(crate) light_cells: [usize; 2],
}

// Not inlined: scenes are built once, by a hundred of these calls, and inlining would cost 8 KB.
impl Paint {
    #[inline(never)]
    pub(crate) fn new(texture: &Arc<Texture>) -> Self {
        Self {
            texture: Arc::clone(texture),
            scale: [1.0, 1.0],
            offset: [0.0, 0.0],
            tint: [1.0; 3],
            gloss: 0.0,
            glow: 0.0,
            light_cells: [8, 8],
        }
    }

    #[inline(never)]
    pub(crate) fn repeated(mut self, across: f32, down: f32) -> Self {
        self.scale = [across, down];
        self
    }

    #[inline(never)]
    pub(crate) fn shifted(mut self, s: f32, t: f32) -> Self {
        self.offset = [s, t];
        self
    }

    #[inline(never)]
    pub(crate) fn tinted(mut self, tint: [f32; 3]) -> Self {
        self.tint = tint;
        self
    }

    #[inline(never)]
    pub(crate) fn glossy(mut self, gloss: f32) -> Self {
        self.gloss = gloss;
        self
    }

    #[inline(never)]
    pub(crate) fn glowing(mut self, glow: f32) -> Self {
        self.glow = glow;
        self
    }

    #[inline(never)]
    pub(crate) fn lit(mut self, across: usize, down: usize) -> Self {
        self.light_cells = [across, down];
        self
    }
}

/// Placement of a body: moved and scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placement {
    /// World position of the body's modeling origin.
    pub(crate) foot: Vector3<f64>,
    pub(crate) scale: f64,
}

impl Placement {
    /// Returns the placement as modeled.
    pub(crate) fn as_built() -> Self {
        Self::at(Vector3::zeros())
    }

    /// Returns a placement that is only moved.
    pub(crate) fn at(foot: Vector3<f64>) -> Self {
        Self { foot, scale: 1.0 }
    }
}

/// An object: a shape for rays, with paints and light maps.
#[derive(Debug)]
pub(crate) struct Body {
    pub(crate) name: &'static str,
    pub(crate) shape: Shape,
    pub(crate) local_from_world: Matrix3<f64>,
    /// Origin of its own frame, in the world.
    pub(crate) center: Vector3<f64>,
    /// Radius around `center` that contains the body, meters.
    reach_m: f64,
    /// Paints by chart of the shape.
    pub(crate) paints: Vec<Paint>,
    /// Simplified shapes for the shade around it.
    pub(crate) proxies: Vec<Proxy>,
    /// Whether it can shade itself, as only hollow objects can.
    pub(crate) hollow: bool,
}

// Not inlined, for the same reason as those of `Paint`.
impl Body {
    /// Creates an upright object at a position, with one paint.
    #[inline(never)]
    pub(crate) fn new(name: &'static str, shape: Shape, center: [f64; 3], paint: &Paint) -> Self {
        let paints = vec![paint.clone(); shape.num_charts()];
        let (half, middle) = shape.bounds();
        Self {
            name,
            reach_m: middle.norm() + half.norm(),
            shape,
            local_from_world: Matrix3::identity(),
            center: Vector3::from(center),
            paints,
            proxies: Vec::new(),
            hollow: false,
        }
    }

    /// Creates a box with these sides, meters.
    #[inline(never)]
    pub(crate) fn cuboid(
        name: &'static str,
        [width, height, depth]: [f64; 3],
        center: [f64; 3],
        paint: &Paint,
    ) -> Self {
        let shape = Shape::Cuboid(Cuboid::solid(width, height, depth));
        Self::new(name, shape, center, paint)
    }

    /// Creates the room around everything, which is its own proxy.
    #[inline(never)]
    pub(crate) fn room([width, height, depth]: [f64; 3], center: [f64; 3], paint: &Paint) -> Self {
        let shape = Shape::Cuboid(Cuboid::room(width, height, depth));
        let mut room = Self::new("the wall", shape, center, paint);
        room.proxies = vec![Proxy::Room {
            center: room.center,
            half: Vector3::new(width, height, depth) / 2.0,
        }];
        room
    }

    /// Rotates about the vertical axis; positive turns x toward z.
    pub(crate) fn yawed(self, yaw_rad: f64) -> Self {
        self.rotated(yaw_rad, 0.0)
    }

    /// Tips over about its own z axis, then rotates about the vertical one.
    #[inline(never)]
    #[rustfmt::skip]
    pub(crate) fn rotated(mut self, yaw_rad: f64, tip_rad: f64) -> Self {
        let (sin, cos) = libm::sincos(yaw_rad);
        let world_from_tipped = Matrix3::new(
            cos, 0.0, -sin,
            0.0, 1.0, 0.0,
            sin, 0.0, cos,
        );
        let (sin, cos) = libm::sincos(tip_rad);
        let tipped_from_local = Matrix3::new(
            cos, -sin, 0.0,
            sin, cos,  0.0,
            0.0, 0.0,  1.0,
        );
        self.local_from_world = (world_from_tipped * tipped_from_local).transpose();
        self
    }

    #[inline(never)]
    pub(crate) fn painted(mut self, chart: usize, paint: &Paint) -> Self {
        self.paints[chart] = paint.clone();
        self
    }

    #[inline(never)]
    pub(crate) fn hollow(mut self) -> Self {
        self.hollow = true;
        self
    }

    /// Makes its own box its proxy.
    #[inline(never)]
    pub(crate) fn boxed(mut self) -> Self {
        let (half, center) = self.shape.bounds();
        self.proxies = vec![Proxy::Box {
            center: self.center + self.local_from_world.transpose() * center,
            local_from_world: self.local_from_world,
            half,
        }];
        self
    }

    /// Sets its proxies, given relative to its center.
    #[inline(never)]
    pub(crate) fn with_proxies(mut self, proxies: &[Proxy]) -> Self {
        self.proxies = proxies
            .iter()
            .map(|proxy| proxy.moved(&self.center))
            .collect();
        self
    }

    /// Transforms a point from the world to the frame of this body. The frame does not scale with
    /// the placement, so equal views are computed from equal numbers.
    #[inline]
    pub(crate) fn local_point(&self, point: &Vector3<f64>, placed: &Placement) -> Vector3<f64> {
        let from_center = point - self.center * placed.scale - placed.foot;
        self.local_from_world * (from_center / placed.scale)
    }

    /// Transforms a point of this body to the world.
    pub(crate) fn world_point(&self, local: &Vector3<f64>, placed: &Placement) -> Vector3<f64> {
        self.local_from_world.tr_mul(local) * placed.scale
            + self.center * placed.scale
            + placed.foot
    }

    /// Transforms a ray from the world to the frame of this body.
    #[inline]
    pub(crate) fn local_ray(&self, ray: &Ray, placed: &Placement) -> Ray {
        Ray {
            origin: self.local_point(&ray.origin, placed),
            direction: self.local_from_world * (ray.direction / placed.scale),
        }
    }

    /// Returns the first contact of a ray of the world.
    pub(crate) fn meet(
        &self,
        ray: &Ray,
        placed: &Placement,
        near: f64,
        far: f64,
    ) -> Option<Contact> {
        if self.is_aside(ray, placed, far) {
            return None;
        }
        self.shape.meet(&self.local_ray(ray, placed), near, far)
    }

    /// Returns whether a ray certainly misses it or meets it beyond `far`, by a bounding sphere:
    /// most rays miss, and the test costs a fraction of the shape's. Never true for the room.
    #[inline]
    fn is_aside(&self, ray: &Ray, placed: &Placement, far: f64) -> bool {
        // Relative margin for rounding.
        const HAIR: f64 = 1e-9;
        let to_center = self.center * placed.scale + placed.foot - ray.origin;
        let reach_m = self.reach_m * placed.scale * (1.0 + HAIR);
        let length_sq = ray.direction.norm_squared();
        // Everything is scaled by the squared length of the direction.
        let along = to_center.dot(&ray.direction);
        let away_sq = to_center.norm_squared() * length_sq;
        let reach_sq = reach_m * reach_m * length_sq + HAIR * away_sq;
        let beyond = along - far * length_sq;
        !self.is_room()
            && (away_sq - along * along > reach_sq
                || (along < 0.0 && away_sq > reach_sq)
                || (beyond > 0.0 && beyond * beyond > reach_sq))
    }

    pub(crate) fn normal_in_world(&self, normal: &Vector3<f64>) -> Vector3<f64> {
        self.local_from_world.tr_mul(normal)
    }

    /// Returns whether it is the room, which encloses everything else.
    pub(crate) fn is_room(&self) -> bool {
        matches!(&self.shape, Shape::Cuboid(cuboid) if cuboid.is_room())
    }

    /// Returns center and radius of a bounding sphere.
    pub(crate) fn bounding_sphere(&self) -> (Vector3<f64>, f64) {
        let (half, center) = self.shape.bounds();
        (
            self.center + self.local_from_world.tr_mul(&center),
            half.norm(),
        )
    }

    pub(crate) fn contains(&self, x_in_world: &Point3<f64>, placed: &Placement) -> bool {
        let local = self.local_point(&x_in_world.coords, placed);
        self.shape.contains(&local)
    }
}
