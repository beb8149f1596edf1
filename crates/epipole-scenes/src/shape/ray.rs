//! Rays, and their contacts with shapes.

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

/// Contact of a ray with a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    /// Ray parameter, in multiples of the ray's direction.
    pub(crate) along: f64,
    /// Index of the face or segment, private to the shape.
    pub(crate) part: u32,
}

/// A position on a shape's surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) chart: usize,
    pub(crate) s: f64,
    pub(crate) t: f64,
    /// Unit outward normal.
    pub(crate) normal: Vector3<f64>,
    /// Derivatives of s and t, per meter.
    pub(crate) per_m: [f64; 2],
}

/// Returns the angle of (x, y) in turns, in [0, 1), to about 2·10⁻⁶ of a turn: enough for a texel,
/// and several times faster than an exact arc tangent.
pub(crate) fn angle_fraction(x: f64, y: f64) -> f64 {
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
    let fraction = if y < 0.0 { 1.0 - half } else { half };
    if fraction < 1.0 { fraction } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::math::random::Random;

    #[test]
    fn angle_fractions_are_close_to_the_arc_tangent() {
        let mut random = Random::new(4);
        for _ in 0..2000 {
            let (x, y) = (random.normal(), random.normal());
            let mut exact = libm::atan2(y, x) / (2.0 * std::f64::consts::PI);
            if exact < 0.0 {
                exact += 1.0;
            }
            assert!((angle_fraction(x, y) - exact).abs() < 4e-6, "{x} {y}");
        }
        assert_eq!(angle_fraction(0.0, 0.0), 0.0);
    }
}
