//! Painted surfaces: mipmapped textures.
//!
//! A texture is painted on first use, so that a scene is cheap if only its geometry is needed.

use super::noise::split;
use crate::detail::Detail;
use crate::gradual::Gradual;
use std::fmt;

/// Downscaling factor of a texture's sketch along each side.
const SKETCH_FACTOR: u32 = 8;

/// Stored red, green, blue and gloss.
type Texel = [u8; 4];

/// One mipmap level.
#[derive(Debug)]
struct Level {
    width: i32,
    height: i32,
    texels: Vec<Texel>,
}

/// A mipmapped texture (Williams 1983, "Pyramidal parametrics").
///
/// A texel holds red, green, blue and gloss. Colors are stored as 255 √linear, which is close to
/// perceived brightness and decodes with one multiplication.
pub(crate) struct Texture {
    width: u32,
    height: u32,
    paint: Box<dyn Fn(f32, f32) -> [f32; 4] + Send + Sync>,
    levels: Gradual<Painting, Vec<Level>>,
    /// Sketch for drafts, painted separately, as that is 64 times as fast as downscaling the full
    /// texture.
    sketch: Gradual<Painting, Vec<Level>>,
    /// Whether the left edge continues at the right one, as on a mug.
    wraps: bool,
}

impl Texture {
    /// Creates a texture that will be painted by `paint(s, t)`, with s to the right and t down,
    /// both in (0, 1), and the result linear red, green, blue and gloss, each in [0, 1].
    ///
    /// Width and height are powers of two, so that every level is exactly half of the one before.
    pub(crate) fn paint(
        width: u32,
        height: u32,
        wraps: bool,
        paint: impl Fn(f32, f32) -> [f32; 4] + Send + Sync + 'static,
    ) -> Self {
        debug_assert!(width.is_power_of_two() && height.is_power_of_two());
        Self {
            width,
            height,
            paint: Box::new(paint),
            levels: Gradual::new(),
            sketch: Gradual::new(),
            wraps,
        }
    }

    /// Creates a texture of one color.
    pub(crate) fn plain(color: [f32; 3], gloss: f32) -> Self {
        Self::paint(1, 1, true, move |_, _| {
            [color[0], color[1], color[2], gloss]
        })
    }

    /// Returns the numbers of texels across and down at full size.
    pub(crate) fn size(&self) -> [f32; 2] {
        [self.width as f32, self.height as f32]
    }

    /// Computes up to `num_texels` more texels; false once all are computed.
    pub(crate) fn advance(&self, detail: Detail, num_texels: usize) -> bool {
        let (levels, size) = self.of(detail);
        levels.advance(num_texels, |part, amount| {
            painted(part, size, &self.paint, amount)
        })
    }

    fn levels(&self) -> &[Level] {
        self.whole(Detail::Full)
    }

    fn sketch(&self) -> &[Level] {
        self.whole(Detail::Sketch)
    }

    fn whole(&self, detail: Detail) -> &[Level] {
        let (levels, size) = self.of(detail);
        levels.get(|part, amount| painted(part, size, &self.paint, amount))
    }

    /// Returns the levels at this detail, and the size of the largest.
    fn of(&self, detail: Detail) -> (&Gradual<Painting, Vec<Level>>, (u32, u32)) {
        let smaller = |side: u32| (side / SKETCH_FACTOR).max(1);
        match detail {
            Detail::Full => (&self.levels, (self.width, self.height)),
            Detail::Sketch => (&self.sketch, (smaller(self.width), smaller(self.height))),
        }
    }

    /// Returns the bytes of all levels.
    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        self.levels()
            .iter()
            .map(|level| 4 * level.texels.len())
            .sum()
    }

    /// Returns the color around (s, t), averaged over about `2^lod` texels of the full size.
    ///
    /// With `smooth`, interpolates between two levels; otherwise uses the nearest level of the
    /// sketch.
    #[inline]
    pub(crate) fn sample(&self, s: f32, t: f32, lod: f32, smooth: bool) -> [f32; 4] {
        let (levels, lod) = match smooth {
            true => (self.levels(), lod),
            false => (self.sketch(), lod - SKETCH_FACTOR.ilog2() as f32),
        };
        let last = levels.len() - 1;
        let lod = lod.clamp(0.0, last as f32);
        let mut color = if smooth {
            let below = lod as usize;
            let above = (below + 1).min(last);
            let part = lod - below as f32;
            let a = self.bilinear(&levels[below], s, t);
            let b = self.bilinear(&levels[above], s, t);
            let mut color = a;
            for i in 0..4 {
                color[i] += (b[i] - a[i]) * part;
            }
            color
        } else {
            self.bilinear(&levels[(lod + 0.5) as usize], s, t)
        };
        for channel in &mut color {
            *channel = *channel * *channel * (1.0 / (65_280.0 * 65_280.0));
        }
        color
    }

    #[inline]
    fn bilinear(&self, level: &Level, s: f32, t: f32) -> [f32; 4] {
        let (x, fx) = split(s * level.width as f32 - 0.5);
        let (y, fy) = split(t * level.height as f32 - 0.5);
        let (x0, x1) = if self.wraps {
            let mask = level.width - 1;
            (x & mask, (x + 1) & mask)
        } else {
            (
                x.clamp(0, level.width - 1),
                (x + 1).clamp(0, level.width - 1),
            )
        };
        let (y0, y1) = if self.wraps {
            let mask = level.height - 1;
            (y & mask, (y + 1) & mask)
        } else {
            (
                y.clamp(0, level.height - 1),
                (y + 1).clamp(0, level.height - 1),
            )
        };
        // Two channels at a time in one integer: weights of 8 bits leave 8 more per channel.
        let (wx, wy) = ((fx * 256.0) as u32, (fy * 256.0) as u32);
        let both = (wx * wy) >> 8;
        let weights = [256 + both - wx - wy, wx - both, wy - both, both];
        let (mut even, mut odd) = (0, 0);
        for (i, weight) in weights.into_iter().enumerate() {
            let (x, y) = (
                if i & 1 == 0 { x0 } else { x1 },
                if i < 2 { y0 } else { y1 },
            );
            let texel = u32::from_le_bytes(level.texels[(y * level.width + x) as usize]);
            even += (texel & 0x00ff_00ff) * weight;
            odd += ((texel >> 8) & 0x00ff_00ff) * weight;
        }
        [
            (even & 0xffff) as f32,
            (odd & 0xffff) as f32,
            (even >> 16) as f32,
            (odd >> 16) as f32,
        ]
    }
}

impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texture({} × {})", self.width, self.height)
    }
}

/// Finished levels of a texture, and the texels of the next one.
type Painting = (Vec<Level>, Vec<Texel>);

/// Computes more texels, row by row: the largest level is painted, each further one is half the
/// size of the one before. Returns all levels once the smallest is complete. Not generic, so that a
/// module has one copy instead of one per texture.
fn painted(
    (levels, texels): &mut Painting,
    (width, height): (u32, u32),
    paint: &dyn Fn(f32, f32) -> [f32; 4],
    mut num_texels: usize,
) -> Option<Vec<Level>> {
    let (step_s, step_t) = (1.0 / width as f32, 1.0 / height as f32);
    loop {
        let [across, down] = [width, height].map(|side| (side >> levels.len()).max(1) as usize);
        texels.reserve_exact(across * down - texels.len());
        while texels.len() < across * down {
            num_texels = num_texels.checked_sub(1)?;
            let (x, y) = (texels.len() % across, texels.len() / across);
            texels.push(match levels.last() {
                None => encode(paint((x as f32 + 0.5) * step_s, (y as f32 + 0.5) * step_t)),
                Some(larger) => halved(larger, (x, y), (across, down)),
            });
        }
        levels.push(Level {
            width: across as i32,
            height: down as i32,
            texels: std::mem::take(texels),
        });
        if across * down == 1 {
            return Some(std::mem::take(levels));
        }
    }
}

fn encode(color: [f32; 4]) -> Texel {
    // The cast saturates overexposed colors.
    color.map(|channel| (channel.max(0.0).sqrt() * 255.0 + 0.5) as u8)
}

/// Returns a texel of the next level, which has `across` × `down` texels: the mean light of the
/// texels that it covers.
fn halved(level: &Level, (x, y): (usize, usize), (across, down): (usize, usize)) -> Texel {
    let (width, height) = (level.width as usize, level.height as usize);
    let (step_x, step_y) = (width / across, height / down);
    let mut sum = [0u32; 4];
    for dy in 0..2 {
        for dx in 0..2 {
            let column = x * step_x + dx.min(step_x - 1);
            let row = y * step_y + dy.min(step_y - 1);
            let texel = level.texels[row * width + column];
            for i in 0..4 {
                sum[i] += u32::from(texel[i]) * u32::from(texel[i]);
            }
        }
    }
    sum.map(|sum| ((sum as f32 * 0.25).sqrt() + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy() -> Texture {
        let noise = crate::paint::noise::Noise::new(3);
        Texture::paint(64, 32, true, move |s, t| {
            let value = 0.5 + 0.4 * noise.value(s * 40.0, t * 40.0);
            [value, 0.5 * value, 0.25, 1.0]
        })
    }

    /// Asserts that the mean light is the same at all levels.
    #[test]
    fn every_level_has_the_same_mean_light() {
        let texture = noisy();
        assert_eq!(texture.levels().len(), 7);
        let means: Vec<[f32; 4]> = texture
            .levels()
            .iter()
            .map(|level| {
                let mut sum = [0.0f32; 4];
                for texel in &level.texels {
                    for i in 0..4 {
                        let value = f32::from(texel[i]) / 255.0;
                        sum[i] += value * value;
                    }
                }
                sum.map(|sum| sum / level.texels.len() as f32)
            })
            .collect();
        for mean in &means {
            for i in 0..4 {
                // Rounding to bytes moves a level by at most half a step, 1/255 of √light.
                assert!(
                    (mean[i] - means[0][i]).abs() < 0.006,
                    "{mean:?} {:?}",
                    means[0]
                );
            }
        }
    }

    #[test]
    fn a_sketch_looks_like_its_texture_from_afar() {
        let texture = noisy();
        for (s, t) in [(0.3, 0.3), (0.7, 0.5), (0.1, 0.8)] {
            let [sharp, sketch] = [true, false].map(|smooth| texture.sample(s, t, 6.0, smooth));
            for i in 0..4 {
                assert!((sharp[i] - sketch[i]).abs() < 0.1, "{sharp:?} {sketch:?}");
            }
        }
    }

    #[test]
    fn texel_centers_give_back_what_was_painted() {
        let texture = Texture::paint(4, 4, false, |s, t| [s * s, t * t, 0.0, 1.0]);
        let color = texture.sample(0.625, 0.375, 0.0, true);
        assert!((color[0] - 0.625 * 0.625).abs() < 0.005, "{color:?}");
        assert!((color[1] - 0.375 * 0.375).abs() < 0.005, "{color:?}");
        assert_eq!(color[3], 1.0);
    }

    #[test]
    fn a_wrapping_texture_has_no_seam() {
        let texture = noisy();
        let (left, right) = (
            texture.sample(0.001, 0.4, 0.0, true),
            texture.sample(1.001, 0.4, 0.0, true),
        );
        for i in 0..4 {
            assert!((left[i] - right[i]).abs() < 1e-4);
        }
    }

    #[test]
    fn far_away_the_texture_is_its_mean() {
        let texture = noisy();
        let color = texture.sample(0.3, 0.9, 99.0, true);
        assert!((color[0] - 2.0 * color[1]).abs() < 0.01, "{color:?}");
        assert_eq!(
            texture.bytes(),
            4 * (64 * 32 + 32 * 16 + 16 * 8 + 8 * 4 + 4 * 2 + 2 + 1)
        );
    }
}
