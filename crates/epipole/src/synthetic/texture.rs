//! Painted surfaces: textures with smaller copies of themselves for distant views.
//!
//! A texture is painted when it is first looked at, so that a scene of which only the geometry is
//! asked costs nothing.

use super::noise::split;
use std::fmt;
use std::sync::LazyLock;

/// One size of a texture.
#[derive(Debug)]
struct Level {
    width: i32,
    height: i32,
    texels: Vec<[u8; 4]>,
}

/// A picture on a surface, with its halved copies (Williams 1983, "Pyramidal parametrics").
///
/// A texel holds red, green, blue and gloss. Colors are stored as 255 √linear, which is close to
/// how the eye divides brightness and decodes with one multiplication.
pub(crate) struct Texture {
    width: u32,
    height: u32,
    levels: LazyLock<Vec<Level>, Box<dyn FnOnce() -> Vec<Level> + Send>>,
    /// Whether the left edge continues at the right one, as on a mug.
    wraps: bool,
}

impl Texture {
    /// Will paint every texel: `paint(s, t)` with s to the right and t down, both in (0, 1), returns
    /// linear red, green, blue and gloss, each in [0, 1].
    ///
    /// Width and height are powers of two, so that every level is an exact half of the last.
    pub(crate) fn paint(
        width: u32,
        height: u32,
        wraps: bool,
        paint: impl Fn(f32, f32) -> [f32; 4] + Send + 'static,
    ) -> Self {
        debug_assert!(width.is_power_of_two() && height.is_power_of_two());
        Self {
            width,
            height,
            levels: LazyLock::new(Box::new(move || painted(width, height, &paint))),
            wraps,
        }
    }

    /// One color everywhere.
    pub(crate) fn plain(color: [f32; 3], gloss: f32) -> Self {
        Self::paint(1, 1, true, move |_, _| {
            [color[0], color[1], color[2], gloss]
        })
    }

    /// Texels across and down at full size.
    pub(crate) fn size(&self) -> [f32; 2] {
        [self.width as f32, self.height as f32]
    }

    /// Bytes of all levels.
    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        self.levels.iter().map(|level| 4 * level.texels.len()).sum()
    }

    /// The color around (s, t), averaged over about `2^lod` texels of the full size.
    ///
    /// With `smooth` two levels are mixed, otherwise the nearer one is taken.
    #[inline]
    pub(crate) fn sample(&self, s: f32, t: f32, lod: f32, smooth: bool) -> [f32; 4] {
        let levels = &*self.levels;
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

/// Every texel, and the halved copies down to a single one.
/// Not generic, and so once in a module, not once for each texture.
fn painted(width: u32, height: u32, paint: &dyn Fn(f32, f32) -> [f32; 4]) -> Vec<Level> {
    let (step_s, step_t) = (1.0 / width as f32, 1.0 / height as f32);
    let mut texels = Vec::with_capacity((width * height) as usize);
    for y in 0..height {
        for x in 0..width {
            let color = paint((x as f32 + 0.5) * step_s, (y as f32 + 0.5) * step_t);
            texels.push(encode(color));
        }
    }
    let mut levels = vec![Level {
        width: width as i32,
        height: height as i32,
        texels,
    }];
    while let Some(smaller) = halved(&levels[levels.len() - 1]) {
        levels.push(smaller);
    }
    levels
}

fn encode(color: [f32; 4]) -> [u8; 4] {
    // The cast saturates, so too bright a color becomes the brightest there is.
    color.map(|channel| (channel.max(0.0).sqrt() * 255.0 + 0.5) as u8)
}

/// The next smaller level, each texel the mean light of those that it covers.
fn halved(level: &Level) -> Option<Level> {
    if level.width == 1 && level.height == 1 {
        return None;
    }
    let (width, height) = ((level.width / 2).max(1), (level.height / 2).max(1));
    let (step_x, step_y) = (level.width / width, level.height / height);
    let mut texels = Vec::with_capacity((width * height) as usize);
    for y in 0..height {
        for x in 0..width {
            let mut sum = [0u32; 4];
            for dy in 0..2 {
                for dx in 0..2 {
                    let column = x * step_x + dx.min(step_x - 1);
                    let row = y * step_y + dy.min(step_y - 1);
                    let texel = level.texels[(row * level.width + column) as usize];
                    for i in 0..4 {
                        sum[i] += u32::from(texel[i]) * u32::from(texel[i]);
                    }
                }
            }
            texels.push(sum.map(|sum| ((sum as f32 * 0.25).sqrt() + 0.5) as u8));
        }
    }
    Some(Level {
        width,
        height,
        texels,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy() -> Texture {
        let noise = super::super::noise::Noise::new(3);
        Texture::paint(64, 32, true, move |s, t| {
            let value = 0.5 + 0.4 * noise.value(s * 40.0, t * 40.0);
            [value, 0.5 * value, 0.25, 1.0]
        })
    }

    /// Light is neither made nor lost from one size to the next.
    #[test]
    fn every_level_has_the_same_mean_light() {
        let texture = noisy();
        assert_eq!(texture.levels.len(), 7);
        let means: Vec<[f32; 4]> = texture
            .levels
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
    fn far_away_everything_is_the_mean() {
        let texture = noisy();
        let color = texture.sample(0.3, 0.9, 99.0, true);
        assert!((color[0] - 2.0 * color[1]).abs() < 0.01, "{color:?}");
        assert_eq!(
            texture.bytes(),
            4 * (64 * 32 + 32 * 16 + 16 * 8 + 8 * 4 + 4 * 2 + 2 + 1)
        );
    }
}
