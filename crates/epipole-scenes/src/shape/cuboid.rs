//! Boxes, and rooms seen from inside.

use super::ray::{Contact, Place, Ray};
use nalgebra::Vector3;

/// The six faces, as part and chart numbers of a [`Cuboid`], seen along +z with y down.
pub(crate) const LEFT: usize = 0;
/// The face at +x.
pub(crate) const RIGHT: usize = 1;
/// The face at −y, since y is down.
pub(crate) const TOP: usize = 2;
/// The face at +y.
pub(crate) const BOTTOM: usize = 3;
/// The face at −z, toward a camera that looks along +z.
pub(crate) const FRONT: usize = 4;
/// The face at +z.
pub(crate) const BACK: usize = 5;

/// A box around the origin, or a box-shaped room.
#[derive(Debug)]
pub(crate) struct Cuboid {
    half: Vector3<f64>,
    /// Inverse side lengths, 1/m.
    inverse: Vector3<f64>,
    room: bool,
}

impl Cuboid {
    /// Creates a solid box with these sides.
    pub(crate) fn solid(width_m: f64, height_m: f64, depth_m: f64) -> Self {
        Self {
            half: Vector3::new(width_m, height_m, depth_m) / 2.0,
            inverse: Vector3::new(1.0 / width_m, 1.0 / height_m, 1.0 / depth_m),
            room: false,
        }
    }

    /// Creates an empty box: rays inside meet its walls.
    pub(crate) fn room(width_m: f64, height_m: f64, depth_m: f64) -> Self {
        Self {
            room: true,
            ..Self::solid(width_m, height_m, depth_m)
        }
    }

    /// Returns whether it is an empty room instead of a solid.
    pub(crate) fn is_room(&self) -> bool {
        self.room
    }

    /// Intersects by slabs (Kay & Kajiya 1986): the ray is inside where it is between all three
    /// pairs of planes.
    #[inline(always)]
    pub(super) fn meet(&self, ray: &Ray, near: f64, far: f64) -> Option<Contact> {
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut enter_part, mut leave_part) = (0, 0);
        let mut slab = |origin: f64, direction: f64, half: f64, part: u32| {
            let inverse = 1.0 / direction;
            let (low, high) = ((-half - origin) * inverse, (half - origin) * inverse);
            let negative = inverse < 0.0;
            let (first, last) = if negative { (high, low) } else { (low, high) };
            let part = part + u32::from(negative);
            // A ray within a slab's plane gives NaN, which fails every comparison.
            if first > enter {
                enter = first;
                enter_part = part;
            }
            if last < leave {
                leave = last;
                leave_part = part ^ 1;
            }
        };
        let (o, d, half) = (&ray.origin, &ray.direction, &self.half);
        slab(o.x, d.x, half.x, 0);
        slab(o.y, d.y, half.y, 2);
        slab(o.z, d.z, half.z, 4);
        if enter > leave {
            return None;
        }
        let (along, part) = if enter > near && !self.room {
            (enter, enter_part)
        } else {
            (leave, leave_part)
        };
        // A zero component outside its slab makes `enter` infinite, refused here.
        (along > near && along < far).then_some(Contact { along, part })
    }

    /// Returns the directions of increasing s and t on a face, and the two half sides.
    #[inline]
    fn axes(&self, face: usize) -> (usize, f64, usize, f64) {
        // Each face is upright for its viewer: a room's wall from the other side.
        match face ^ usize::from(self.room) {
            LEFT => (2, -1.0, 1, 1.0),
            RIGHT => (2, 1.0, 1, 1.0),
            TOP => (0, 1.0, 2, -1.0),
            BOTTOM => (0, 1.0, 2, 1.0),
            FRONT => (0, 1.0, 1, 1.0),
            _ => (0, -1.0, 1, 1.0),
        }
    }

    #[inline]
    pub(super) fn place(&self, point: &Vector3<f64>, part: u32) -> Place {
        let face = part as usize;
        let (axis_s, sign_s, axis_t, sign_t) = self.axes(face);
        let (inverse_s, inverse_t) = (self.inverse[axis_s], self.inverse[axis_t]);
        Place {
            chart: face,
            s: 0.5 + sign_s * point[axis_s] * inverse_s,
            t: 0.5 + sign_t * point[axis_t] * inverse_t,
            normal: self.normal(face),
            per_m: [inverse_s, inverse_t],
        }
    }

    fn normal(&self, face: usize) -> Vector3<f64> {
        let mut normal = Vector3::zeros();
        let outward = if face & 1 == 0 { -1.0 } else { 1.0 };
        normal[face / 2] = if self.room { -outward } else { outward };
        normal
    }

    pub(super) fn point(&self, face: usize, s: f64, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (axis_s, sign_s, axis_t, sign_t) = self.axes(face);
        let mut point = Vector3::zeros();
        point[face / 2] = self.half[face / 2] * if face & 1 == 0 { -1.0 } else { 1.0 };
        point[axis_s] = (2.0 * s - 1.0) * sign_s * self.half[axis_s];
        point[axis_t] = (2.0 * t - 1.0) * sign_t * self.half[axis_t];
        (point, self.normal(face))
    }

    pub(super) fn contains(&self, point: &Vector3<f64>) -> bool {
        let inside = (0..3).all(|axis| point[axis].abs() < self.half[axis]);
        inside != self.room
    }

    pub(super) fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        (self.half, Vector3::zeros())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
        Ray {
            origin: Vector3::from(origin),
            direction: Vector3::from(direction),
        }
    }

    #[test]
    fn front_face_first_then_back() {
        let solid = Cuboid::solid(2.0, 2.0, 2.0);
        let along_z = ray([0.5, 0.5, -3.0], [0.0, 0.0, 2.0]);
        let contact = solid.meet(&along_z, 0.0, 1e9).unwrap();
        assert_eq!((contact.along, contact.part), (1.0, FRONT as u32));
        let contact = solid.meet(&along_z, 1.5, 1e9).unwrap();
        assert_eq!((contact.along, contact.part), (2.0, BACK as u32));
        assert_eq!(
            solid.meet(&ray([2.0, 0.0, -3.0], [0.0, 0.0, 1.0]), 0.0, 1e9),
            None
        );
        assert_eq!(solid.meet(&along_z, 2.5, 1e9), None);
    }

    #[test]
    fn a_room_is_met_from_within() {
        let room = Cuboid::room(2.0, 2.0, 2.0);
        let contact = room
            .meet(&ray([0.0; 3], [-0.5, 0.1, 0.0]), 0.0, 1e9)
            .unwrap();
        assert_eq!((contact.along, contact.part), (2.0, LEFT as u32));
        assert_eq!(room.place(&Vector3::new(-1.0, 0.2, 0.0), 0).normal.x, 1.0);
        assert!(room.contains(&Vector3::new(1.5, 0.0, 0.0)));
        assert!(!room.contains(&Vector3::zeros()));
    }
}
