//! Bodies whose surface a ray meets in closed form or by a convergent iteration.
//!
//! Each shape lives in its own frame, x right, y **down**, z forward like the world, and carries
//! charts: maps of its surface by (s, t) in [0, 1]², on which pictures and light are painted.

mod cuboid;
mod lathe;
mod ring;

pub(crate) use cuboid::{BACK, BOTTOM, Cuboid, FRONT, RIGHT, TOP};
pub(crate) use lathe::{Lathe, Profile};
pub(crate) use ring::Ring;

use nalgebra::Vector3;

/// A ray `origin + along * direction`, along > 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    pub(crate) origin: Vector3<f64>,
    pub(crate) direction: Vector3<f64>,
}

impl Ray {
    pub(crate) fn at(&self, along: f64) -> Vector3<f64> {
        self.origin + self.direction * along
    }
}

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    /// In multiples of the ray's direction.
    pub(crate) along: f64,
    /// Which face or segment of the shape; only the shape itself reads it.
    pub(crate) part: u32,
}

/// A place on a shape's surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) chart: usize,
    pub(crate) s: f64,
    pub(crate) t: f64,
    /// Unit, outward.
    pub(crate) normal: Vector3<f64>,
    /// How much s and t grow per meter here.
    pub(crate) per_m: [f64; 2],
}

#[derive(Debug)]
pub(crate) enum Shape {
    Cuboid(Cuboid),
    Lathe(Lathe),
    Ring(Ring),
}

impl Shape {
    /// The first contact with `near < along < far`.
    #[inline(always)]
    pub(crate) fn meet(&self, ray: &Ray, near: f64, far: f64) -> Option<Contact> {
        match self {
            Self::Cuboid(shape) => shape.meet(ray, near, far),
            Self::Lathe(shape) => shape.meet(ray, near, far),
            Self::Ring(shape) => shape.meet(ray, near, far),
        }
    }

    /// Chart, coordinates and normal of a point that [`Shape::meet`] found.
    #[inline]
    pub(crate) fn place(&self, point: &Vector3<f64>, part: u32) -> Place {
        match self {
            Self::Cuboid(shape) => shape.place(point, part),
            Self::Lathe(shape) => shape.place(point, part),
            Self::Ring(shape) => shape.place(point),
        }
    }

    /// The point of a chart and its outward normal: the inverse of [`Shape::place`].
    pub(crate) fn point(&self, chart: usize, s: f64, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            Self::Cuboid(shape) => shape.point(chart, s, t),
            Self::Lathe(shape) => shape.point(s, t),
            Self::Ring(shape) => shape.point(s, t),
        }
    }

    pub(crate) fn num_charts(&self) -> usize {
        match self {
            Self::Cuboid(_) => 6,
            Self::Lathe(_) | Self::Ring(_) => 1,
        }
    }

    /// Whether a point lies in the solid; for a room, whether it lies in the walls or beyond.
    pub(crate) fn contains(&self, point: &Vector3<f64>) -> bool {
        match self {
            Self::Cuboid(shape) => shape.contains(point),
            Self::Lathe(shape) => shape.contains(point),
            Self::Ring(shape) => shape.contains(point),
        }
    }

    /// Half the sides of a box around the shape, and the box's center.
    pub(crate) fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            Self::Cuboid(shape) => shape.bounds(),
            Self::Lathe(shape) => shape.bounds(),
            Self::Ring(shape) => shape.bounds(),
        }
    }
}

/// The angle of (x, y) in turns, in [0, 1), to about 2·10⁻⁶ of a turn: enough to find a texel, and
/// several times faster than an exact arc tangent.
pub(crate) fn turns(x: f64, y: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let (large, small) = if ax > ay { (ax, ay) } else { (ay, ax) };
    if large == 0.0 {
        return 0.0;
    }
    let q = small / large;
    let q2 = q * q;
    // Odd minimax polynomial of atan on [0, 1] (Abramowitz & Stegun 1964, 4.4.49), in turns.
    let eighth = q
        * (0.999_866_0
            + q2 * (-0.330_299_5 + q2 * (0.180_141_0 + q2 * (-0.085_133_0 + q2 * 0.020_835_1))))
        * (0.5 / std::f64::consts::PI);
    let quarter = if ax > ay { eighth } else { 0.25 - eighth };
    let half = if x < 0.0 { 0.5 - quarter } else { quarter };
    let turn = if y < 0.0 { 1.0 - half } else { half };
    if turn < 1.0 { turn } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn turns_are_close_to_the_arc_tangent() {
        let mut random = Random::new(4);
        for _ in 0..2000 {
            let (x, y) = (random.normal(), random.normal());
            let mut exact = libm::atan2(y, x) / (2.0 * std::f64::consts::PI);
            if exact < 0.0 {
                exact += 1.0;
            }
            assert!((turns(x, y) - exact).abs() < 4e-6, "{x} {y}");
        }
        assert_eq!(turns(0.0, 0.0), 0.0);
    }

    fn shapes() -> Vec<Shape> {
        vec![
            Shape::Cuboid(Cuboid::solid(0.3, 0.2, 0.1)),
            Shape::Cuboid(Cuboid::room(3.0, 2.0, 4.0)),
            Shape::Lathe(Lathe::new(
                Profile::new()
                    .to(0.2, 0.0)
                    .to(0.3, 0.5)
                    .sharp()
                    .to(0.25, 0.5)
                    .to(0.2, 0.1)
                    .sharp()
                    .to(0.0, 0.1),
            )),
            Shape::Ring(Ring::new(0.05, 0.01, 1.3, 1.4, -0.02)),
        ]
    }

    /// Rays aimed at random points: the contact lies on the surface, its place maps back to it,
    /// and the normal faces the ray's origin.
    #[test]
    fn contacts_lie_on_the_charts() {
        let mut random = Random::new(9);
        for (index, shape) in shapes().iter().enumerate() {
            let inside = matches!(shape, Shape::Cuboid(room) if room.is_room());
            let (half, center) = shape.bounds();
            let mut num_contacts = 0;
            for _ in 0..3000 {
                let mut vector = || {
                    Vector3::new(
                        random.uniform(-1.0, 1.0),
                        random.uniform(-1.0, 1.0),
                        random.uniform(-1.0, 1.0),
                    )
                };
                let origin = if inside {
                    vector()
                } else {
                    center + vector().normalize() * half.norm() * 3.0
                };
                let target = center + vector().component_mul(&half);
                let ray = Ray {
                    origin,
                    direction: target - origin,
                };
                let Some(contact) = shape.meet(&ray, 1e-9, f64::INFINITY) else {
                    continue;
                };
                num_contacts += 1;
                let point = ray.at(contact.along);
                let place = shape.place(&point, contact.part);
                let (back, _) = shape.point(place.chart, place.s, place.t);
                assert!(
                    (back - point).norm() < 2e-5,
                    "shape {index}: {point:?} {back:?}"
                );
                assert!((place.normal.norm() - 1.0).abs() < 1e-9);
                // Smoothed normals of a profile may lean a little beyond the silhouette.
                assert!(
                    place.normal.dot(&ray.direction.normalize()) < 0.5,
                    "shape {index}"
                );
                assert!(!shape.contains(&ray.at(contact.along - 1e-6)));
                assert!(shape.contains(&ray.at(contact.along + 1e-6)) || !inside);
            }
            assert!(num_contacts > 500, "shape {index}: {num_contacts}");
        }
    }
}
