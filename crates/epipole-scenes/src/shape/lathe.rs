//! Lathed bodies: a profile rotated about the vertical axis, such as mugs, jugs and fruit.

use super::profile::Profile;
use super::ray::{Contact, Place, Ray, angle_fraction};
use epipole::math::length;
use nalgebra::{Vector2, Vector3};

/// One cone of a lathed body.
#[derive(Debug)]
struct Segment {
    start: Vector2<f64>,
    end: Vector2<f64>,
    /// Derivative of radius by height; `None` for a flat ring.
    slope: Option<f64>,
    low: f64,
    high: f64,
    normal_start: Vector2<f64>,
    normal_end: Vector2<f64>,
    /// Length of the profile up to the start, and of the segment, as fractions of the whole.
    before: f64,
    fraction: f64,
}

/// A lathed body. Its axis is vertical, height is −y, and (s, t) are the angle about the axis in
/// turns and the fraction of the profile's length.
#[derive(Debug)]
pub(crate) struct Lathe {
    segments: Vec<Segment>,
    radius: f64,
    low: f64,
    high: f64,
    length: f64,
}

impl Lathe {
    pub(crate) fn new(profile: Profile) -> Self {
        let Profile { vertices, sharp } = profile;
        let lengths: Vec<f64> = vertices
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .collect();
        let length: f64 = lengths.iter().sum();
        let normals: Vec<Vector2<f64>> = vertices
            .windows(2)
            .map(|pair| {
                let d = (pair[1] - pair[0]).normalize();
                Vector2::new(d.y, -d.x)
            })
            .collect();
        let last = normals.len() - 1;
        let at_vertex = |vertex: usize, own: usize| {
            if vertex == 0 || vertex > last {
                // On the axis the normal of a smooth body is vertical.
                let level = Vector2::new(0.0, normals[own].y.signum());
                return if sharp[vertex] { normals[own] } else { level };
            }
            if sharp[vertex] {
                normals[own]
            } else {
                (normals[vertex - 1] + normals[vertex]).normalize()
            }
        };
        let mut before = 0.0;
        let segments = (0..normals.len())
            .map(|i| {
                let (start, end) = (vertices[i], vertices[i + 1]);
                let segment = Segment {
                    start,
                    end,
                    slope: (end.y != start.y).then(|| (end.x - start.x) / (end.y - start.y)),
                    low: start.y.min(end.y),
                    high: start.y.max(end.y),
                    normal_start: at_vertex(i, i),
                    normal_end: at_vertex(i + 1, i),
                    before: before / length,
                    fraction: lengths[i] / length,
                };
                before += lengths[i];
                segment
            })
            .collect();
        Self {
            segments,
            radius: vertices.iter().fold(0.0, |most, v| v.x.max(most)),
            low: vertices
                .iter()
                .fold(f64::INFINITY, |least, v| v.y.min(least)),
            high: vertices
                .iter()
                .fold(f64::NEG_INFINITY, |most, v| v.y.max(most)),
            length,
        }
    }

    /// Returns radius and height at a fraction `t` of the profile's length.
    pub(crate) fn profile_at(&self, t: f64) -> Vector2<f64> {
        let segment = self.segment_at(t);
        let part = ((t - segment.before) / segment.fraction).clamp(0.0, 1.0);
        segment.start + (segment.end - segment.start) * part
    }

    fn segment_at(&self, t: f64) -> &Segment {
        self.segments
            .iter()
            .rev()
            .find(|segment| segment.before <= t)
            .unwrap_or(&self.segments[0])
    }

    #[inline]
    pub(super) fn meet(&self, ray: &Ray, near: f64, far: f64) -> Option<Contact> {
        let (o, d) = (&ray.origin, &ray.direction);
        let (height, rise) = (-o.y, -d.y);
        // The part of the ray in the enclosing cylinder, and its heights there.
        let a = d.x * d.x + d.z * d.z;
        let b = o.x * d.x + o.z * d.z;
        let o_sq = o.x * o.x + o.z * o.z;
        let discriminant = b * b - a * (o_sq - self.radius * self.radius);
        if discriminant < 0.0 {
            return None;
        }
        let (mut first, mut last) = (near, far);
        if a > 0.0 {
            let root = discriminant.sqrt();
            let inverse = 1.0 / a;
            // Small tolerance, so that rounding cannot cut off the widest segment.
            let slack = 1e-9 * root * inverse;
            first = first.max((-b - root) * inverse - slack);
            last = last.min((-b + root) * inverse + slack);
        }
        if first > last {
            return None;
        }
        let (h0, h1) = (height + first * rise, height + last * rise);
        let (h_low, h_high) = (h0.min(h1), h0.max(h1));
        if h_low > self.high || h_high < self.low {
            return None;
        }
        let mut best = Contact {
            along: far,
            part: u32::MAX,
        };
        for (index, segment) in self.segments.iter().enumerate() {
            if segment.low > h_high || segment.high < h_low {
                continue;
            }
            let Some(slope) = segment.slope else {
                let along = (segment.low - height) / rise;
                if along > near && along < best.along {
                    let (x, z) = (o.x + along * d.x, o.z + along * d.z);
                    let r_sq = x * x + z * z;
                    let (r0, r1) = (
                        segment.start.x.min(segment.end.x),
                        segment.start.x.max(segment.end.x),
                    );
                    if r_sq >= r0 * r0 && r_sq <= r1 * r1 {
                        best = Contact {
                            along,
                            part: index as u32,
                        };
                    }
                }
                continue;
            };
            // x² + z² = (r + k t)²
            let r = segment.start.x + slope * (height - segment.start.y);
            let k = slope * rise;
            let qa = a - k * k;
            let qb = b - r * k;
            let qc = o_sq - r * r;
            let discriminant = qb * qb - qa * qc;
            if discriminant < 0.0 {
                continue;
            }
            // Avoids cancellation: one root from −b ∓ √, the other from their product.
            let q = -(qb + if qb < 0.0 { -1.0 } else { 1.0 } * discriminant.sqrt());
            for along in [q / qa, qc / q] {
                if along > near && along < best.along {
                    let h = height + along * rise;
                    if h >= segment.low && h <= segment.high && r + k * along >= 0.0 {
                        best = Contact {
                            along,
                            part: index as u32,
                        };
                    }
                }
            }
        }
        (best.part != u32::MAX).then_some(best)
    }

    #[inline]
    pub(super) fn place(&self, point: &Vector3<f64>, part: u32) -> Place {
        let segment = &self.segments[part as usize];
        let radius = (point.x * point.x + point.z * point.z).sqrt();
        let along = segment.end - segment.start;
        let fraction = ((radius - segment.start.x) * along.x
            + (-point.y - segment.start.y) * along.y)
            / along.norm_squared();
        let fraction = fraction.clamp(0.0, 1.0);
        let flat = segment.normal_start + (segment.normal_end - segment.normal_start) * fraction;
        let flat = flat / length(&flat);
        let (cos, sin) = if radius > 1e-12 {
            (point.x / radius, point.z / radius)
        } else {
            (1.0, 0.0)
        };
        Place {
            chart: 0,
            s: angle_fraction(point.x, point.z),
            t: segment.before + segment.fraction * fraction,
            normal: Vector3::new(flat.x * cos, -flat.y, flat.x * sin),
            // Near the axis s changes arbitrarily fast; filtering for it would also blur t.
            per_m: [
                1.0 / (std::f64::consts::TAU * radius.max(0.25 * self.radius)),
                1.0 / self.length,
            ],
        }
    }

    pub(super) fn point(&self, s: f64, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let segment = self.segment_at(t);
        let fraction = ((t - segment.before) / segment.fraction).clamp(0.0, 1.0);
        let at = segment.start + (segment.end - segment.start) * fraction;
        let flat = segment.normal_start + (segment.normal_end - segment.normal_start) * fraction;
        let flat = flat / length(&flat);
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * s);
        (
            Vector3::new(at.x * cos, -at.y, at.x * sin),
            Vector3::new(flat.x * cos, -flat.y, flat.x * sin),
        )
    }

    pub(super) fn contains(&self, point: &Vector3<f64>) -> bool {
        let radius = (point.x * point.x + point.z * point.z).sqrt();
        let height = -point.y;
        // Count the segments outside of the point at its height.
        let mut inside = false;
        for segment in &self.segments {
            if let Some(slope) = segment.slope
                && height >= segment.low
                && height < segment.high
                && segment.start.x + slope * (height - segment.start.y) > radius
            {
                inside = !inside;
            }
        }
        inside
    }

    pub(super) fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        (
            Vector3::new(self.radius, (self.high - self.low) / 2.0, self.radius),
            Vector3::new(0.0, -(self.high + self.low) / 2.0, 0.0),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cylinder_is_met_where_it_should_be() {
        let cylinder = Lathe::new(
            Profile::new()
                .to(0.5, 0.0)
                .sharp()
                .to(0.5, 1.0)
                .sharp()
                .to(0.0, 1.0),
        );
        let ray = |origin: [f64; 3], direction: [f64; 3]| Ray {
            origin: Vector3::from(origin),
            direction: Vector3::from(direction),
        };
        let side = cylinder
            .meet(&ray([0.0, -0.5, -2.0], [0.0, 0.0, 1.0]), 0.0, 1e9)
            .unwrap();
        assert!((side.along - 1.5).abs() < 1e-12);
        let top = cylinder
            .meet(&ray([0.1, -3.0, 0.1], [0.0, 1.0, 0.0]), 0.0, 1e9)
            .unwrap();
        assert!((top.along - 2.0).abs() < 1e-12);
        assert_eq!(top.part, 2);
        assert!(cylinder.contains(&Vector3::new(0.3, -0.5, 0.3)));
        assert!(!cylinder.contains(&Vector3::new(0.3, -0.5, 0.45)));
        assert!(!cylinder.contains(&Vector3::new(0.0, 0.1, 0.0)));
        assert_eq!(
            cylinder.meet(&ray([0.0, -1.5, -2.0], [0.0, 0.0, 1.0]), 0.0, 1e9),
            None
        );
    }
}
