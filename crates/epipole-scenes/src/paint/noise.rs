//! Smooth pseudo-random functions of the plane, the basis of all painted surfaces.

use epipole::math::random::Random;
use std::sync::LazyLock;

/// Side of the lattice; the noise repeats with this period.
const SIDE: usize = 256;

/// The noise from which all scenes are painted.
pub(crate) static NOISE: LazyLock<Noise> = LazyLock::new(|| Noise::new(1859));

/// Value noise: random numbers on an integer lattice, smoothly interpolated.
#[derive(Debug)]
pub(crate) struct Noise {
    lattice: Box<[f32; SIDE * SIDE]>,
}

impl Noise {
    /// Creates noise that depends only on `seed`.
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut lattice = Box::new([0.0; SIDE * SIDE]);
        for value in lattice.iter_mut() {
            *value = random.uniform(-1.0, 1.0) as f32;
        }
        Self { lattice }
    }

    /// Returns the number at a lattice point, in [−1, 1): white noise.
    pub(crate) fn at(&self, x: i32, y: i32) -> f32 {
        self.lattice[(y as usize & (SIDE - 1)) * SIDE + (x as usize & (SIDE - 1))]
    }

    /// Returns smooth noise in [−1, 1] with features about one unit wide.
    #[inline]
    pub(crate) fn value(&self, x: f32, y: f32) -> f32 {
        self.masked(x, y, SIDE - 1, SIDE - 1)
    }

    /// Returns noise with period 1 in `s` and `t`, with these numbers of features per period.
    ///
    /// The numbers of features are powers of two, at most 256.
    #[inline]
    pub(crate) fn tile(&self, s: f32, t: f32, cells: [u16; 2]) -> f32 {
        let [across, down] = cells.map(usize::from);
        debug_assert!(across.is_power_of_two() && down.is_power_of_two());
        self.masked(
            s * across as f32,
            t * down as f32,
            (across - 1) & (SIDE - 1),
            (down - 1) & (SIDE - 1),
        )
    }

    /// Not inlined: it has so many callers that copies would take a considerable part of a module.
    #[inline(never)]
    fn masked(&self, x: f32, y: f32, mask_x: usize, mask_y: usize) -> f32 {
        let (xi, fx) = split(x);
        let (yi, fy) = split(y);
        let (fx, fy) = (ease(fx), ease(fy));
        let (x0, x1) = (xi as usize & mask_x, (xi + 1) as usize & mask_x);
        let row0 = (yi as usize & mask_y) * SIDE;
        let row1 = ((yi + 1) as usize & mask_y) * SIDE;
        // The indices are already in range; the mask avoids bounds checks.
        let at = |index: usize| self.lattice[index & (SIDE * SIDE - 1)];
        let a = mix(at(row0 + x0), at(row0 + x1), fx);
        let b = mix(at(row1 + x0), at(row1 + x1), fx);
        mix(a, b, fy)
    }

    /// Sums octaves of [`Noise::value`], each twice as fine and half as strong as the last.
    pub(crate) fn octaves(&self, x: f32, y: f32, octaves: u32) -> f32 {
        let (mut sum, mut weight, mut scale) = (0.0, 0.5, 1.0);
        for _ in 0..octaves {
            sum += weight * self.value(x * scale + 17.3 * scale, y * scale + 5.7 * scale);
            weight *= 0.5;
            scale *= 2.03;
        }
        sum
    }

    /// Sums octaves of [`Noise::tile`].
    pub(crate) fn octaves_tile(&self, s: f32, t: f32, cells: [u16; 2], octaves: u32) -> f32 {
        let (mut sum, mut weight, mut cells) = (0.0, 0.5, cells);
        for _ in 0..octaves {
            sum += weight * self.tile(s + 0.31, t + 0.17, cells);
            weight *= 0.5;
            cells = cells.map(|count| (2 * count).min(256));
        }
        sum
    }
}

/// Returns the integer and the fractional part, the latter in [0, 1), for |x| < 2²².
#[inline]
pub(crate) fn split(x: f32) -> (i32, f32) {
    // Adding 1.5 · 2²³ rounds to an integer in the lowest bits: two additions instead of slow
    // conversions.
    const SHIFT: f32 = 12_582_912.0;
    let shifted = x + SHIFT;
    let nearest = shifted - SHIFT;
    let whole = (shifted.to_bits() as i32).wrapping_sub(SHIFT.to_bits() as i32);
    if nearest > x {
        (whole.wrapping_sub(1), x - (nearest - 1.0))
    } else {
        (whole, x - nearest)
    }
}

/// Smooth step 3t² − 2t³ on [0, 1].
#[inline]
pub(crate) fn ease(t: f32) -> f32 {
    t * t * (3.0 - 2.0 * t)
}

/// 0 below `low`, 1 above `high`, smooth between them.
#[inline]
pub(crate) fn step(low: f32, high: f32, x: f32) -> f32 {
    ease(((x - low) * (1.0 / (high - low))).clamp(0.0, 1.0))
}

/// Interpolates linearly from `a` (at 0) to `b` (at 1).
#[inline]
pub(crate) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Interpolates linearly between colors.
#[inline]
pub(crate) fn blend(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    [mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t)]
}

/// Scales the brightness of a color by `factor`.
#[inline]
pub(crate) fn dim(color: [f32; 3], factor: f32) -> [f32; 3] {
    [color[0] * factor, color[1] * factor, color[2] * factor]
}

/// Combines a color with gloss, 0 to 1.
pub(crate) fn with_gloss(color: [f32; 3], gloss: f32) -> [f32; 4] {
    [color[0], color[1], color[2], gloss]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn split_is_floor_and_remainder() {
        for (x, whole, part) in [
            (2.75, 2, 0.75),
            (-0.25, -1, 0.75),
            (-3.0, -3, 0.0),
            (0.999_99, 0, 0.999_99),
            (1_000.062_5, 1_000, 0.062_5),
        ] {
            let (got_whole, got_part) = split(x);
            assert_eq!(got_whole, whole, "{x}");
            assert!((got_part - part).abs() < 1e-6, "{x}");
        }
    }

    #[test]
    fn noise_is_continuous_bounded_and_seeded() {
        let (noise, same, other) = (Noise::new(1), Noise::new(1), Noise::new(2));
        let mut differs = false;
        for i in 0..2000 {
            let x = -20.0 + 0.0213 * i as f32;
            let here = noise.value(x, 0.3 * x);
            assert!(here.abs() <= 1.0);
            assert!((here - noise.value(x + 1e-3, 0.3 * x)).abs() < 0.02, "{x}");
            assert_eq!(here, same.value(x, 0.3 * x));
            differs |= here != other.value(x, 0.3 * x);
        }
        assert!(differs);
    }

    #[test]
    fn tiles_close() {
        let noise = Noise::new(8);
        for i in 0..50 {
            let (s, t) = (0.02 * i as f32, 0.013 * i as f32);
            for (ds, dt) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 1.0)] {
                let (a, b) = (
                    noise.octaves_tile(s, t, [8, 32], 4),
                    noise.octaves_tile(s + ds, t + dt, [8, 32], 4),
                );
                assert!((a - b).abs() < 1e-3, "{s} {t}");
            }
        }
    }

    #[test]
    fn noise_goes_through_its_lattice() {
        let noise = Noise::new(5);
        assert_eq!(noise.value(3.0, 7.0), noise.at(3, 7));
        assert_eq!(noise.value(-1.0, 0.0), noise.at(255, 0));
    }
}
