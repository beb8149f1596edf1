//! Conversion of linear light to bytes.

use std::sync::LazyLock;

/// Converts linear light to bytes: a soft shoulder for highlights, then the sRGB curve.
#[derive(Debug)]
pub(super) struct Film {
    /// 256 times the encoded value, for light in [0, [`Film::MOST`]).
    curve: Vec<u16>,
}

impl Film {
    const SIZE: usize = 8192;
    const MOST: f32 = 2.5;

    /// Returns the film shared by all photographs.
    pub(super) fn shared() -> &'static Self {
        static FILM: LazyLock<Film> = LazyLock::new(Film::new);
        &FILM
    }

    fn new() -> Self {
        let curve = (0..Self::SIZE)
            .map(|i| {
                let light = (i as f64 + 0.5) * f64::from(Self::MOST) / Self::SIZE as f64;
                let knee = 0.55;
                let light = if light < knee {
                    light
                } else {
                    let over = (light - knee) / (1.0 - knee);
                    knee + (1.0 - knee) * over / (1.0 + 0.8 * over)
                };
                let encoded = if light <= 0.003_130_8 {
                    12.92 * light
                } else {
                    1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
                };
                (encoded.min(1.0) * 255.0 * 256.0 + 0.5) as u16
            })
            .collect();
        Self { curve }
    }

    /// Returns the bytes of one pixel. Ordered dithering by less than one step hides banding.
    #[inline]
    pub(super) fn develop(&self, color: [f32; 3], x: u32, y: u32) -> [u8; 3] {
        const PATTERN: [u16; 16] = [0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5];
        let threshold = PATTERN[(4 * (y & 3) + (x & 3)) as usize] * 16 + 8;
        let mut bytes = [0; 3];
        for i in 0..3 {
            let index = (color[i] * (Self::SIZE as f32 / Self::MOST)) as usize;
            let value = self.curve[index.min(Self::SIZE - 1)];
            bytes[i] = ((value + threshold) >> 8) as u8;
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_film_keeps_order_and_ends() {
        let film = Film::new();
        let mut last = 0;
        for i in 0..2600 {
            let value = film.develop([i as f32 * 0.001; 3], 1, 1)[0];
            assert!(value >= last);
            last = value;
        }
        assert_eq!(film.develop([0.0; 3], 0, 0), [0; 3]);
        assert!(last >= 250);
        // Middle gray: linear 0.214 is sRGB 128 (IEC 61966-2-1).
        let middle = film.develop([0.2140; 3], 2, 1)[0];
        assert!((127..=128).contains(&middle), "{middle}");
        assert_eq!(film.develop([f32::NAN, -1.0, 1e9], 0, 0)[..2], [0, 0]);
    }
}
