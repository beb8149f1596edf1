//! Shapes with a closed-form or convergent iterative ray intersection.
//!
//! Each shape has its own frame, with x right, y **down** and z forward like the world, and charts:
//! maps of its surface by (s, t) in [0, 1]² for textures and light maps.

mod cuboid;
mod lathe;
mod profile;
mod ray;
mod ring;

pub(crate) use cuboid::{BACK, BOTTOM, Cuboid, FRONT, RIGHT, TOP};
pub(crate) use lathe::Lathe;
pub(crate) use profile::Profile;
pub(crate) use ray::{Contact, Place, Ray};
pub(crate) use ring::Ring;

use nalgebra::Vector3;

#[derive(Debug)]
pub(crate) enum Shape {
    Cuboid(Cuboid),
    Lathe(Lathe),
    Ring(Ring),
}

impl Shape {
    /// Returns the first contact with `near < along < far`.
    #[inline(always)]
    pub(crate) fn meet(&self, ray: &Ray, near: f64, far: f64) -> Option<Contact> {
        match self {
            Self::Cuboid(shape) => shape.meet(ray, near, far),
            Self::Lathe(shape) => shape.meet(ray, near, far),
            Self::Ring(shape) => shape.meet(ray, near, far),
        }
    }

    /// Returns chart, coordinates and normal of a point found by [`Shape::meet`].
    #[inline]
    pub(crate) fn place(&self, point: &Vector3<f64>, part: u32) -> Place {
        match self {
            Self::Cuboid(shape) => shape.place(point, part),
            Self::Lathe(shape) => shape.place(point, part),
            Self::Ring(shape) => shape.place(point),
        }
    }

    /// Returns the point of a chart and its outward normal: the inverse of [`Shape::place`].
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

    /// Returns whether a point is in the solid; for a room, whether it is in the walls or beyond.
    pub(crate) fn contains(&self, point: &Vector3<f64>) -> bool {
        match self {
            Self::Cuboid(shape) => shape.contains(point),
            Self::Lathe(shape) => shape.contains(point),
            Self::Ring(shape) => shape.contains(point),
        }
    }

    /// Returns half the sides of a bounding box, and its center.
    pub(crate) fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            Self::Cuboid(shape) => shape.bounds(),
            Self::Lathe(shape) => shape.bounds(),
            Self::Ring(shape) => shape.bounds(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::math::random::Random;

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

    /// Asserts for rays to random points that the contact is on the surface, its place maps back to
    /// it, and the normal faces the ray's origin.
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
