//! The pairs of places that a binary descriptor compares.

use crate::math::random::Random;
use image::GrayImage;

/// All places lie in a disc of this radius, pixels.
pub(super) const RADIUS: usize = 15;

/// 256 pairs of offsets from the keypoint.
pub(super) struct Pattern {
    pairs: Vec<[[f32; 2]; 2]>,
}

impl Pattern {
    /// Places drawn from a Gaussian of a fifth of the disc's diameter, the best of the layouts
    /// that Calonder et al. 2010 compare (§3.2, their G II); the seed is fixed for good.
    pub(super) fn new() -> Self {
        let mut random = Random::new(0x0e91_901e);
        let mut place = || loop {
            let spread = (2.0 * RADIUS as f64 + 1.0) / 5.0;
            let (x, y) = (spread * random.normal(), spread * random.normal());
            if x * x + y * y <= (RADIUS * RADIUS) as f64 {
                return [x as f32, y as f32];
            }
        };
        Self {
            pairs: (0..256).map(|_| [place(), place()]).collect(),
        }
    }

    /// Bit k says whether the first place of pair k is darker than the second, the pattern turned
    /// by the keypoint's angle.
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
        let value = |[a, b]: [f32; 2]| {
            let u = (a * cos - b * sin).round() as isize;
            let v = (a * sin + b * cos).round() as isize;
            image.as_raw()[(center + v * width + u) as usize]
        };
        let mut bits = [0u64; 4];
        for (k, &[first, second]) in self.pairs.iter().enumerate() {
            bits[k / 64] |= u64::from(value(first) < value(second)) << (k % 64);
        }
        bits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
