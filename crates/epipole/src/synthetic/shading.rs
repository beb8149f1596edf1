//! The color of a place on a body: paint times light, plus reflections on glossy things.

use super::body::Body;
use super::light::{LightMap, Lighting};
use super::shape::Place;
use nalgebra::Vector3;
use std::sync::LazyLock;

/// log₂ of a positive number, within 0.09: linear between powers of two.
fn log2(x: f32) -> f32 {
    (x.to_bits() as i32 - (127 << 23)) as f32 * (1.0 / (1 << 23) as f32)
}

/// What the ray that found a place tells about it.
pub(crate) struct Look {
    pub(crate) x_in_world: [f32; 3],
    pub(crate) direction_in_world: [f32; 3],
    /// Width of a pixel at this depth, meters of the body as it was built.
    pub(crate) pixel_m: f32,
    /// Light on the table where a movable thing stands: window and soft.
    pub(crate) decal: Option<[f32; 2]>,
    /// Mix neighboring sizes of a texture.
    pub(crate) smooth: bool,
}

#[inline]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(crate) fn single(v: &Vector3<f64>) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

/// Linear red, green and blue.
#[inline]
pub(crate) fn color(
    body: &Body,
    lights: &[LightMap],
    place: &Place,
    lighting: &Lighting,
    look: &Look,
) -> [f32; 3] {
    let paint = &body.paints[place.chart];
    let normal = single(&body.normal_in_world(&place.normal));
    let direction = look.direction_in_world;
    let inverse_length = 1.0 / dot(direction, direction).sqrt();
    let facing = -dot(normal, direction) * inverse_length;
    let [width, height] = paint.texture.size();
    let texels_per_m = (paint.scale[0].abs() * width * place.per_m[0] as f32)
        .max(paint.scale[1].abs() * height * place.per_m[1] as f32);
    // A slanted pixel covers more of the surface in one direction: between its two widths. The
    // logarithm of the square saves the roots.
    let footprint = texels_per_m * look.pixel_m;
    let lod = 0.5 * log2(footprint * footprint / facing.clamp(0.12, 1.0)) - 0.35;
    let (s, t) = (place.s as f32, place.t as f32);
    let texel = paint.texture.sample(
        s * paint.scale[0] + paint.offset[0],
        t * paint.scale[1] + paint.offset[1],
        lod,
        look.smooth,
    );
    let mut color = paint.tint;
    for i in 0..3 {
        color[i] *= texel[i];
    }
    if paint.glow > 0.0 {
        for channel in &mut color {
            *channel *= paint.glow;
        }
        return color;
    }
    let mut light = lights[place.chart].sample(s, t);
    if let Some([window, soft]) = look.decal {
        let ambient = lighting.ambient(normal);
        for i in 0..3 {
            let own = ambient[i].min(light[i]);
            light[i] = own * soft + (light[i] - own) * window;
        }
        light[3] *= window;
    }
    for i in 0..3 {
        color[i] *= light[i];
    }
    let gloss = paint.gloss * texel[3];
    if gloss > 0.0 {
        let mut mirrored = [0.0; 3];
        for i in 0..3 {
            mirrored[i] = direction[i] * inverse_length + normal[i] * (2.0 * facing);
        }
        let shine = reflection(lighting, look.x_in_world, mirrored, light[3]);
        // Schlick 1994: more of the light is reflected at grazing angles.
        let grazing = 1.0 - facing.clamp(0.0, 1.0);
        let grazing_sq = grazing * grazing;
        let strength = gloss * (0.045 + 0.6 * grazing_sq * grazing_sq * grazing);
        for i in 0..3 {
            color[i] += strength * shine[i];
        }
    }
    color
}

/// What a mirror would show in this direction: a blurred window with its bars, and the room.
#[inline]
fn reflection(
    lighting: &Lighting,
    x_in_world: [f32; 3],
    direction: [f32; 3],
    visible: f32,
) -> [f32; 3] {
    let mut color = lighting.ambient(direction);
    for channel in &mut color {
        *channel *= 0.8;
    }
    let mirror = &lighting.mirror;
    let approach = dot(mirror.normal, direction);
    if approach < 0.0 && visible > 0.0 {
        let along = (mirror.offset - dot(mirror.normal, x_in_world)) / approach;
        let mut at = [0.0; 3];
        for i in 0..3 {
            at[i] = x_in_world[i] + direction[i] * along;
        }
        let u = dot(at, mirror.u) - mirror.u_offset;
        let v = dot(at, mirror.v) - mirror.v_offset;
        let edge = |x: f32| (4.0 * (1.12 - x.abs())).clamp(0.0, 1.0);
        let bar = |x: f32| (7.0 * x.abs()).clamp(0.25, 1.0);
        let bright = 9.0 * visible * edge(u) * edge(v) * bar(u) * bar(v);
        for i in 0..3 {
            color[i] += bright * lighting.color[i];
        }
    }
    color
}

/// Turns linear light into bytes: a soft shoulder for the brightest, then the sRGB curve.
#[derive(Debug)]
pub(crate) struct Film {
    /// 256 × the encoded value, for light in [0, [`Film::MOST`]).
    curve: Vec<u16>,
}

impl Film {
    const SIZE: usize = 8192;
    const MOST: f32 = 2.5;

    /// The film of every photograph.
    pub(crate) fn shared() -> &'static Self {
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

    /// The bytes of one pixel. An ordered pattern of less than one step hides banding.
    #[inline]
    pub(crate) fn develop(&self, color: [f32; 3], x: u32, y: u32) -> [u8; 3] {
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

    #[test]
    fn the_quick_logarithm_is_close() {
        for x in [0.01f32, 0.5, 1.0, 1.4, 2.0, 3.0, 700.0] {
            assert!((log2(x) - libm::log2f(x)).abs() < 0.09, "{x}");
        }
    }
}
