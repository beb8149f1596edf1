//! Ceramics, fruit and tins.

use super::lettering::Line;
use super::noise::{Noise, blend, dim, split, step, with_gloss};
use super::texture::Texture;
use nalgebra::Vector2;

/// Returns noise around an axis, continuous at s = 1.
fn around(noise: &Noise, s: f32, t: f32, cells: u16) -> f32 {
    noise.tile(s, t, [cells, cells])
}

/// Paints a cream mug with a printed cobalt band; its profile gives radius and height at t.
pub(crate) fn mug(
    noise: &'static Noise,
    profile: impl Fn(f64) -> Vector2<f64> + Send + Sync + 'static,
    height_m: f64,
    floor_m: f64,
) -> Texture {
    let (cream, cobalt, rust) = ([0.72, 0.66, 0.53], [0.030, 0.075, 0.27], [0.55, 0.16, 0.06]);
    let tallest = (0..400)
        .map(|i| f64::from(i) / 400.0)
        .fold((0.0, 0.0), |best: (f64, f64), t| {
            let height = profile(t).y;
            if height > best.1 { (t, height) } else { best }
        })
        .0 as f32;
    Texture::paint(512, 256, true, move |s, t| {
        let at = profile(f64::from(t));
        let h = (at.y / height_m) as f32;
        let glaze = around(noise, s, t, 32) * 0.035 + around(noise, s, t, 128) * 0.025;
        let mut color = dim(cream, 1.0 + glaze);
        let speck = noise.tile(s, t, [256, 128]);
        color = dim(color, 1.0 - 0.55 * step(0.80, 0.93, speck));
        if t < tallest {
            // Bare clay at the foot.
            color = blend(
                [0.40, 0.25, 0.15],
                color,
                step(0.045, 0.06, h + 0.01 * around(noise, s, 0.3, 16)),
            );
            let mut ink = 0.0f32;
            for line in [0.22, 0.30, 0.74, 0.82] {
                ink = ink.max(step(0.016, 0.008, (h - line).abs()));
            }
            if (0.32..0.72).contains(&h) {
                // Twelve lozenges with discs, leaves between them.
                let (index, part) = split(s * 12.0);
                let (px, py) = (part - 0.5, (h - 0.52) / 0.40);
                let lozenge = px.abs() + py.abs() * 0.8;
                let r = (px * px * 1.3 + py * py).sqrt();
                ink = ink.max(step(0.44, 0.40, lozenge) * step(0.27, 0.31, lozenge));
                let dot = step(0.15, 0.11, r);
                let dot_ink = if index & 1 == 0 { rust } else { cobalt };
                color = blend(color, dot_ink, dot);
                let (qx, qy) = (px.abs() - 0.5, py.abs() - 0.33);
                let leaf = (qx * qx * 9.0 + qy * qy * 26.0).sqrt();
                ink = ink.max(step(0.42, 0.34, leaf));
            } else if (0.82..0.95).contains(&h) {
                let (_, part) = split(s * 36.0);
                let wave = (part - 0.5).abs() * 2.0 * 0.05 + 0.855;
                ink = ink.max(step(0.014, 0.007, (h - wave).abs()));
            }
            let brushed = 0.86 + 0.14 * around(noise, s, t, 64);
            color = blend(color, cobalt, ink * brushed);
            color = blend(color, cobalt, step(0.965, 0.98, h));
        } else if at.y < floor_m + 0.002 {
            // Coffee, with a paler rim of foam.
            let foam = noise.octaves_tile(s, at.x as f32 * 20.0, [16, 8], 2);
            color = blend(
                [0.030, 0.014, 0.007],
                [0.24, 0.13, 0.06],
                step(0.2, 0.5, foam),
            );
            return with_gloss(color, 0.8);
        }
        with_gloss(color, 1.0)
    })
}

/// Paints a tall jug in celadon with a dark combed band and a cream neck.
pub(crate) fn jug(
    noise: &'static Noise,
    profile: impl Fn(f64) -> Vector2<f64> + Send + Sync + 'static,
    height_m: f64,
) -> Texture {
    let (celadon, deep, cream) = ([0.16, 0.36, 0.34], [0.035, 0.10, 0.12], [0.62, 0.58, 0.45]);
    Texture::paint(512, 256, true, move |s, t| {
        let at = profile(f64::from(t));
        let h = (at.y / height_m) as f32;
        let run = noise.octaves_tile(s, t, [16, 8], 3);
        // Glaze pools thick and dark below, thin above.
        let mut color = blend(deep, celadon, step(0.0, 0.5, h + 0.30 * run));
        let crackle = (around(noise, s, t, 32) + 0.4 * around(noise, s, t, 64)).abs();
        color = dim(color, 1.0 - 0.30 * step(0.035, 0.0, crackle));
        let (index, part) = split(s * 16.0);
        let mut ink = 0.0f32;
        for line in [0.40, 0.43, 0.65, 0.68] {
            ink = ink.max(step(0.009, 0.005, (h - line + 0.004 * run).abs()));
        }
        if (0.44..0.64).contains(&h) {
            // Fishes of two sizes, in quick brush strokes.
            let flip = if index & 1 == 0 { 1.0 } else { -1.0 };
            let (px, py) = ((part - 0.5) * flip, (h - 0.54) / 0.20 + 0.10 * flip);
            let body = (px * px * 9.0 + py * py * 30.0).sqrt();
            let tail = (px - 0.38).abs() + 0.4 * (py.abs() - 0.6 * (px - 0.3).abs()).max(0.0) * 8.0;
            ink = ink.max(step(1.0, 0.9, body)).max(step(0.12, 0.08, tail));
            let (ox, oy) = (px + 0.22, py - 0.02);
            if (ox * ox + oy * oy).sqrt() < 0.035 {
                ink = 0.0;
            }
            let (_, scale) = split(px * 16.0);
            if body < 0.7 && px > -0.12 && scale < 0.3 {
                ink *= 0.35;
            }
        }
        color = blend(
            color,
            cream,
            0.92 * ink * (0.85 + 0.15 * around(noise, s, t, 128)),
        );
        color = blend(color, cream, step(0.93, 0.95, h + 0.02 * run));
        let fine = around(noise, s, t, 128);
        with_gloss(dim(color, 1.0 + 0.05 * fine), 1.0)
    })
}

/// Paints peel with pores, a navel at one end and a stalk's scar at the other; gray parts are
/// tinted.
pub(crate) fn citrus(noise: &'static Noise, ripe: [f32; 3], pale: [f32; 3]) -> Texture {
    Texture::paint(256, 128, true, move |s, t| {
        let cloud = noise.octaves_tile(s, t, [8, 4], 3);
        let pore = noise.tile(s, t, [128, 64]);
        let relief = pore - noise.tile(s + 0.003, t + 0.004, [128, 64]);
        let mut color = blend(ripe, pale, step(-0.3, 0.55, cloud));
        color = dim(color, 1.0 + 0.26 * relief - 0.22 * step(0.45, 0.9, pore));
        let spot = noise.octaves_tile(s, t, [16, 8], 3);
        color = blend(color, [0.20, 0.10, 0.03], 0.6 * step(0.42, 0.52, spot));
        let end = t.min(1.0 - t);
        color = blend([0.12, 0.13, 0.04], color, step(0.012, 0.05, end));
        with_gloss(color, 0.55 + 0.3 * relief)
    })
}

/// Paints an apple's skin: red stripes over yellow, pale dots, green near the stalk.
pub(crate) fn apple(noise: &'static Noise) -> Texture {
    Texture::paint(256, 128, true, move |s, t| {
        let blush = noise.octaves_tile(s, t, [4, 2], 3) + 0.22;
        let stripe = noise.tile(s, t, [64, 4]) + 0.6 * noise.tile(s, t, [128, 8]);
        let red = step(-0.45, 0.35, blush + 0.35 * stripe);
        let mut color = blend([0.62, 0.50, 0.10], [0.48, 0.035, 0.03], red);
        let dot = noise.tile(s, t, [64, 32]);
        color = blend(color, [0.75, 0.62, 0.36], 0.7 * step(0.70, 0.9, dot));
        // t runs from the blossom end at the bottom to the stalk at the top.
        let green = step(0.82, 0.97, t + 0.03 * stripe);
        color = blend(color, [0.30, 0.33, 0.07], 0.8 * green);
        with_gloss(color, 0.8)
    })
}

/// Paints a printed tea tin: a label with letters on a patterned ground.
pub(crate) fn tin(noise: &'static Noise, ground: [f32; 3], word: &str) -> Texture {
    let line = Line::new(word);
    let fine = Line::new("GATHERED BY HAND");
    let gold = [0.76, 0.55, 0.22];
    Texture::paint(128, 256, false, move |s, t| {
        let (x, y) = (s, t * 1.5);
        let rim = x.min(1.0 - x).min(y.min(1.5 - y));
        let (_, fx) = split((x + y) * 9.0);
        let (_, fy) = split((x - y) * 9.0);
        let lattice = fx.min(1.0 - fx).min(fy.min(1.0 - fy));
        let mut color = blend(ground, gold, 0.55 * step(0.10, 0.05, lattice));
        let dot = (fx - 0.5) * (fx - 0.5) + (fy - 0.5) * (fy - 0.5);
        color = blend(color, gold, 0.8 * step(0.025, 0.012, dot));
        color = blend(color, gold, step(0.075, 0.065, rim) * step(0.04, 0.05, rim));
        let (px, py) = (x - 0.5, y - 0.72);
        let plate = (px * px + py * py * 1.6).sqrt();
        color = blend(color, gold, step(0.40, 0.39, plate));
        let paper = dim(
            [0.72, 0.66, 0.52],
            1.0 + 0.08 * noise.octaves(x * 20.0, y * 20.0, 3),
        );
        color = blend(color, paper, step(0.37, 0.36, plate));
        let letter = |line: &Line, top: f32, height: f32| {
            line.at(px / height + line.width() / 2.0, (y - top) / height)
        };
        let ink = letter(&line, 0.61, 0.20).max(letter(&fine, 0.86, 0.042));
        color = blend(color, dim(ground, 0.6), ink);
        let scuff = noise.octaves(x * 12.0, y * 12.0 + 30.0, 4);
        color = dim(color, 1.0 + 0.16 * scuff);
        with_gloss(color, 0.8 - 0.5 * step(0.2, 0.4, scuff))
    })
}
