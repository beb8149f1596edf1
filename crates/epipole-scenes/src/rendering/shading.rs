//! Color of a point on a body: paint times light, plus reflections on glossy objects.

use crate::light::{LightMap, Lighting, single};
use crate::objects::body::Body;
use crate::shape::Place;

/// Approximates log₂ of a positive number within 0.09: linear between powers of two.
fn log2(x: f32) -> f32 {
    (x.to_bits() as i32 - (127 << 23)) as f32 * (1.0 / (1 << 23) as f32)
}

/// Inputs of shading from the ray that found a point.
pub(super) struct Look {
    pub(super) x_in_world: [f32; 3],
    pub(super) direction_in_world: [f32; 3],
    /// Width of a pixel at this depth, meters in the body's frame at scale 1.
    pub(super) pixel_m: f32,
    /// Shade factors on the table under a movable object: window and ambient light.
    pub(super) decal: Option<[f32; 2]>,
    /// Whether to interpolate between texture levels.
    pub(super) smooth: bool,
}

#[inline]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns linear red, green and blue.
#[inline]
pub(super) fn color(
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
    // On a slanted surface a pixel's footprint is longer in one direction, so a width between the
    // two is used. The logarithm of the square avoids roots.
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

/// Returns the reflection in this direction: a blurred window with its bars, and the room.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quick_logarithm_is_close() {
        for x in [0.01f32, 0.5, 1.0, 1.4, 2.0, 3.0, 700.0] {
            assert!((log2(x) - libm::log2f(x)).abs() < 0.09, "{x}");
        }
    }
}
