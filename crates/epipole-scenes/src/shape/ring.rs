//! The handle of a mug: a stretched torus with one side hidden in the mug.

use super::ray::{Contact, Place, Ray, angle_fraction};
use epipole::math::length;
use nalgebra::Vector3;

/// A torus around the z axis, stretched along y and z and cut at a plane x = const.
#[derive(Debug)]
pub(crate) struct Ring {
    /// Distance from the center to the middle of the tube, and the tube's radius.
    major: f64,
    minor: f64,
    /// Stretch along x, y and z.
    stretch: Vector3<f64>,
    /// Lower bound of x; the rest is cut off.
    cut_x: f64,
}

impl Ring {
    pub(crate) fn new(major: f64, minor: f64, tall: f64, wide: f64, cut_x: f64) -> Self {
        Self {
            major,
            minor,
            stretch: Vector3::new(1.0, tall, wide),
            cut_x,
        }
    }

    /// Returns the distance to the unstretched torus and its gradient.
    #[inline]
    fn distance(&self, p: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let ring = (p.x * p.x + p.y * p.y).sqrt().max(1e-12);
        let off = ring - self.major;
        let tube = (off * off + p.z * p.z).sqrt().max(1e-12);
        let scale = off / (tube * ring);
        (
            tube - self.minor,
            Vector3::new(p.x * scale, p.y * scale, p.z / tube),
        )
    }

    /// Intersects by sphere tracing, as steps no longer than the distance never cross the surface
    /// (Hart 1996); Newton's iteration then converges to it.
    pub(super) fn meet(&self, ray: &Ray, near: f64, far: f64) -> Option<Contact> {
        let (half, center) = self.bounds();
        let (mut first, mut last) = (near, far);
        for axis in 0..3 {
            let inverse = 1.0 / ray.direction[axis];
            let a = (center[axis] - half[axis] - ray.origin[axis]) * inverse;
            let b = (center[axis] + half[axis] - ray.origin[axis]) * inverse;
            let (a, b) = if a < b { (a, b) } else { (b, a) };
            if a > first {
                first = a;
            }
            if b < last {
                last = b;
            }
        }
        if first > last || !first.is_finite() {
            return None;
        }
        let origin = ray.origin.component_div(&self.stretch);
        let direction = ray.direction.component_div(&self.stretch);
        let inverse_speed = 1.0 / length(&direction);
        let mut along = first;
        for _ in 0..96 {
            let (distance, gradient) = self.distance(&(origin + direction * along));
            if distance < 1e-5 {
                if distance < -1e-5 {
                    return None;
                }
                let mut exact = along;
                let (mut distance, mut slope) = (distance, gradient.dot(&direction));
                for _ in 0..8 {
                    if slope >= 0.0 || distance.abs() < 1e-15 {
                        break;
                    }
                    exact -= distance / slope;
                    let (next, gradient) = self.distance(&(origin + direction * exact));
                    distance = next;
                    slope = gradient.dot(&direction);
                }
                if distance.abs() < 1e-12 && exact > near && exact >= first && exact < last {
                    return Some(Contact {
                        along: exact,
                        part: 0,
                    });
                }
                // A near miss: continue behind the point of closest approach.
                along += 2e-5 * inverse_speed;
            } else {
                along += distance * inverse_speed;
            }
            if along > last {
                return None;
            }
        }
        None
    }

    pub(super) fn place(&self, point: &Vector3<f64>) -> Place {
        let p = point.component_div(&self.stretch);
        let (_, gradient) = self.distance(&p);
        let normal = gradient.component_div(&self.stretch);
        let ring = (p.x * p.x + p.y * p.y).sqrt();
        Place {
            chart: 0,
            s: angle_fraction(p.x, p.y),
            t: angle_fraction(ring - self.major, p.z),
            normal: normal / length(&normal),
            per_m: [
                1.0 / (std::f64::consts::TAU * self.major),
                1.0 / (std::f64::consts::TAU * self.minor),
            ],
        }
    }

    pub(super) fn point(&self, s: f64, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (sin_s, cos_s) = libm::sincos(std::f64::consts::TAU * s);
        let (sin_t, cos_t) = libm::sincos(std::f64::consts::TAU * t);
        let ring = self.major + self.minor * cos_t;
        let p = Vector3::new(ring * cos_s, ring * sin_s, self.minor * sin_t);
        let normal = Vector3::new(cos_t * cos_s, cos_t * sin_s, sin_t).component_div(&self.stretch);
        (p.component_mul(&self.stretch), normal / length(&normal))
    }

    pub(super) fn contains(&self, point: &Vector3<f64>) -> bool {
        point.x > self.cut_x && self.distance(&point.component_div(&self.stretch)).0 < 0.0
    }

    pub(super) fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        let reach = self.major + self.minor;
        let (low, high) = (self.cut_x, reach);
        (
            Vector3::new(
                (high - low) / 2.0,
                reach * self.stretch.y,
                self.minor * self.stretch.z,
            ),
            Vector3::new((high + low) / 2.0, 0.0, 0.0),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_ray_meets_the_tube_at_a_known_depth() {
        let ring = Ring::new(0.05, 0.01, 1.0, 1.0, -1.0);
        let ray = |x: f64| Ray {
            origin: Vector3::new(x, 0.0, -1.0),
            direction: Vector3::new(0.0, 0.0, 1.0),
        };
        let contact = ring.meet(&ray(0.05), 0.0, 1e9).unwrap();
        assert!((contact.along - 0.99).abs() < 1e-12);
        // Through the hole.
        assert_eq!(ring.meet(&ray(0.0), 0.0, 1e9), None);
        assert_eq!(ring.meet(&ray(0.0601), 0.0, 1e9), None);
        assert!(ring.contains(&Vector3::new(0.05, 0.0, 0.005)));
    }
}
