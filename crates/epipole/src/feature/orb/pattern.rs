//! The pairs of positions that a binary descriptor compares.

use crate::math::random::Random;
use crate::math::simd::dispatched;
use image::GrayImage;

/// Radius of the disc that contains all positions, pixels.
pub(super) const RADIUS: usize = 15;

/// Number of positions: 256 pairs.
const PLACES: usize = 512;

/// Offsets from the keypoint; those of pair k are at 2k and 2k + 1.
pub(super) struct Pattern {
    u: [f32; PLACES],
    v: [f32; PLACES],
}

impl Pattern {
    /// Draws positions from a Gaussian with a fifth of the disc's diameter as standard deviation,
    /// the best layout in Calonder et al. 2010 (§3.2, their G II); the seed must never change.
    pub(super) fn new() -> Self {
        let mut random = Random::new(0x0e91_901e);
        let mut place = || loop {
            let spread = (2.0 * RADIUS as f64 + 1.0) / 5.0;
            let (x, y) = (spread * random.normal(), spread * random.normal());
            if x * x + y * y <= (RADIUS * RADIUS) as f64 {
                return [x as f32, y as f32];
            }
        };
        let mut pattern = Self {
            u: [0.0; PLACES],
            v: [0.0; PLACES],
        };
        for k in 0..PLACES {
            [pattern.u[k], pattern.v[k]] = place();
        }
        pattern
    }

    /// Compares the pairs of the pattern, rotated by the keypoint's angle: bit k is set if the
    /// first position of pair k is darker than the second.
    pub(super) fn compare(
        &self,
        image: &GrayImage,
        x: usize,
        y: usize,
        angle_rad: f32,
    ) -> [u64; 4] {
        let width = image.width() as isize;
        let center = y as isize * width + x as isize;
        let (sin, cos) = (libm::sinf(angle_rad), libm::cosf(angle_rad));
        let mut offsets = [0i32; PLACES];
        rotated(self, sin, cos, width as i32, &mut offsets);
        let value = |k: usize| image.as_raw()[(center + offsets[k] as isize) as usize];
        let mut bits = [0u64; 4];
        for k in 0..PLACES / 2 {
            bits[k / 64] |= u64::from(value(2 * k) < value(2 * k + 1)) << (k % 64);
        }
        bits
    }
}

dispatched! {
    /// Computes the pixel offsets of the rotated pattern from the keypoint, for an image of some
    /// width.
    fn rotated(pattern: &Pattern, sin: f32, cos: f32, width: i32, offsets: &mut [i32; PLACES]) {
        for k in 0..PLACES {
            let (a, b) = (pattern.u[k], pattern.v[k]);
            let u = nearest(a * cos - b * sin);
            let v = nearest(a * sin + b * cos);
            offsets[k] = v * width + u;
        }
    }
}

/// Constant that, added to a small float, puts the nearest integer into the lowest bits.
const WHOLE: f32 = 12_582_912.0;

/// Rounds a small number as `f32::round`: to the nearest integer, halves away from zero. Unlike
/// `as`, which saturates, it vectorizes.
#[inline(always)]
fn nearest(x: f32) -> i32 {
    let shifted = x + WHOLE;
    let whole = shifted.to_bits() as i32 - WHOLE.to_bits() as i32;
    let rest = x - (shifted - WHOLE);
    whole + i32::from((rest >= 0.5) & (x > 0.0)) - i32::from((rest <= -0.5) & (x < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_round_away_from_zero() {
        for k in -3000..=3000 {
            let x = k as f32 / 128.0;
            for x in [x, x.next_up(), x.next_down()] {
                assert_eq!(nearest(x), x.round() as i32, "{x}");
            }
        }
    }

    #[test]
    fn the_pattern_is_pinned() {
        let pattern = Pattern::new();
        let image = GrayImage::from_fn(41, 41, |u, v| {
            image::Luma([((u * 11 + v * 29) % 251) as u8])
        });
        let bits = pattern.compare(&image, 20, 20, 0.5);
        let expected = [
            15_572_984_994_173_566_659,
            12_185_322_719_231_186_560,
            15_851_955_285_418_358_710,
            1_367_068_695_094_512_630,
        ];
        assert_eq!(bits, expected);
    }
}
