//! Wood, plaster, and the window.

use super::lettering::Line;
use super::with_gloss;
use crate::synthetic::noise::{Noise, blend, dim, mix, split, step};
use crate::synthetic::texture::Texture;

/// The color of oak at (x, y) metres, the grain along x.
fn oak(noise: &Noise, x: f32, y: f32, board: f32, light: [f32; 3], dark: [f32; 3]) -> [f32; 3] {
    let shift = board * 7.31;
    let bend = noise.octaves(x * 1.9 + shift, y * 9.0 + shift, 2);
    // Year rings, cut lengthwise: bands that wander.
    let ring = (y * 46.0 + bend * 7.5 + noise.value(x * 5.0 + shift, y * 30.0) * 0.4) * 0.5;
    let (_, phase) = split(ring);
    let band = step(0.0, 0.75, phase) * step(1.0, 0.86, phase);
    let fiber = noise.value(x * 26.0 + shift, y * 420.0);
    let fleck = noise.value(x * 60.0, y * 260.0 + shift);
    let pore = step(0.5, 0.85, fleck);
    let tone = 0.42 * band + 0.16 * fiber + 0.22 * noise.value(shift, x * 2.2) + 0.25;
    let color = blend(light, dark, tone.clamp(0.0, 1.0));
    let color = dim(color, 1.0 - 0.42 * pore);
    // No two boards are of one tree.
    dim(color, 1.0 + 0.16 * noise.at(board as i32 * 5, 3))
}

/// A table top of `num_boards` boards along s, with joints, scratches and ring marks.
pub(crate) fn boards(
    noise: &Noise,
    size: [u32; 2],
    extent_m: [f32; 2],
    num_boards: f32,
) -> Texture {
    let (light, dark) = ([0.46, 0.262, 0.128], [0.20, 0.098, 0.042]);
    Texture::paint(size[0], size[1], false, |s, t| {
        let (x, y) = (s * extent_m[0], t * extent_m[1]);
        let (board, within) = split(t * num_boards);
        let mut color = oak(noise, x, y, board as f32, light, dark);
        let width_m = extent_m[1] / num_boards;
        let joint_m = within.min(1.0 - within) * width_m;
        color = dim(color, mix(0.30, 1.0, step(0.0, 0.0032, joint_m)));
        // Wear: pale scratches and a few darker stains.
        let stain = noise.octaves(x * 3.0 + 40.0, y * 3.0, 3);
        color = dim(color, 1.0 - 0.22 * step(0.12, 0.45, stain));
        let scratch = noise.value(x * 9.0 + y * 4.0, (y - 0.35 * x) * 310.0);
        let rare = noise.value(x * 2.3 + 9.0, y * 2.9);
        color = blend(
            color,
            [0.52, 0.36, 0.22],
            0.45 * step(0.72, 0.95, scratch) * step(0.1, 0.5, rare),
        );
        with_gloss(color, 0.55 - 0.3 * step(0.0, 0.4, stain))
    })
}

/// Floor boards along t, seven to a tile.
pub(crate) fn floor(noise: &Noise) -> Texture {
    Texture::paint(256, 256, true, |s, t| {
        let (board, within) = split(s * 7.0);
        let color = oak(
            noise,
            t * 1.2,
            s * 1.0,
            board as f32 + 20.0,
            [0.25, 0.15, 0.085],
            [0.115, 0.062, 0.032],
        );
        let joint = within.min(1.0 - within);
        with_gloss(dim(color, mix(0.25, 1.0, step(0.0, 0.05, joint))), 0.3)
    })
}

/// The top of the long table: one metre along t with marks every decimetre, to be repeated.
pub(crate) fn measured_boards(noise: &Noise, width_m: f32) -> Texture {
    let (light, dark) = ([0.46, 0.275, 0.14], [0.23, 0.118, 0.054]);
    Texture::paint(1024, 512, true, |s, t| {
        let (x, along) = (s * width_m, t);
        let (board, within) = split(s * 9.0);
        // The noise repeats every 256 units, so whole multiples close the tile along t.
        let around = along * 256.0 / 24.0;
        let mut color = oak(noise, around, x, board as f32 + 3.0, light, dark);
        let joint = within.min(1.0 - within) * width_m / 9.0;
        color = dim(color, mix(0.35, 1.0, step(0.0, 0.004, joint)));
        // Inlaid light squares down the middle, as on a measuring board.
        let middle = (x - width_m / 2.0).abs();
        let (decimetre, part) = split(along * 10.0);
        let pale = [0.62, 0.50, 0.34];
        let ebony = [0.055, 0.040, 0.032];
        if (0.80..0.86).contains(&(middle / (width_m / 2.0))) {
            let inlay = if decimetre % 2 == 0 { pale } else { ebony };
            let grain = 0.9 + 0.12 * noise.value(x * 40.0, along * 256.0);
            color = dim(inlay, grain);
        } else if middle / (width_m / 2.0) < 0.80 {
            // A fine line at each decimetre, a wide one at each metre.
            let distance_m = part.min(1.0 - part) * 0.1;
            let metre = decimetre == 0 && part < 0.5 || decimetre == 9 && part > 0.5;
            let half_m = if metre { 0.006 } else { 0.0022 };
            let ink = 1.0 - step(half_m, half_m + 0.0015, distance_m);
            color = blend(color, ebony, 0.8 * ink);
        }
        with_gloss(color, 0.5)
    })
}

/// A brass plate with a number of one or two digits.
pub(crate) fn number(noise: &Noise, metres: u32) -> Texture {
    let line = Line::new(&metres.to_string());
    Texture::paint(64, 64, false, |s, t| {
        let rim = s.min(1.0 - s).min(t.min(1.0 - t));
        let brushed = 1.0 + 0.12 * noise.value(s * 6.0, t * 90.0 + metres as f32);
        let brass = dim([0.62, 0.44, 0.17], brushed);
        let ink = line.at((s - 0.5) / 0.62 + line.width() / 2.0, (t - 0.19) / 0.62);
        let color = blend(brass, [0.05, 0.035, 0.02], ink);
        let color = dim(color, mix(0.35, 1.0, step(0.03, 0.06, rim)));
        with_gloss(color, 1.0 - ink)
    })
}

/// Lime-washed plaster: clouds, trowel strokes lit from the left, flecks and hair cracks.
pub(crate) fn plaster(noise: &Noise, size: [u32; 2], extent_m: [f32; 2]) -> Texture {
    let (pale, deep, under) = (
        [0.43, 0.455, 0.395],
        [0.285, 0.335, 0.315],
        [0.50, 0.40, 0.29],
    );
    Texture::paint(size[0], size[1], true, |s, t| {
        let (x, y) = (s * extent_m[0], t * extent_m[1]);
        let cloud = noise.octaves(x * 2.1, y * 2.1, 3);
        let mut color = blend(pale, deep, step(-0.5, 0.5, cloud));
        // Relief: the difference of a height between two near places, as raking light shows it.
        let (u, v) = (x * 21.0 + cloud * 2.0, y * 27.0);
        let relief = noise.value(u, v) - noise.value(u + 0.30, v + 0.22);
        let fine = noise.value(x * 95.0, y * 95.0);
        color = dim(color, 1.0 + 0.30 * relief + 0.085 * fine);
        // Chips where the older coat shows.
        let chip = noise.octaves(x * 8.0 + 31.0, y * 8.0 + 7.0, 3);
        color = blend(color, under, 0.7 * step(0.40, 0.47, chip));
        let crack =
            (noise.value(x * 3.1 + 90.0, y * 3.1) + 0.35 * noise.value(x * 17.0, y * 17.0)).abs();
        color = dim(color, 1.0 - 0.35 * step(0.016, 0.0, crack));
        with_gloss(color, 0.0)
    })
}

/// A bright window of six panes, with a hint of a garden behind.
pub(crate) fn window(noise: &Noise) -> Texture {
    Texture::paint(128, 128, false, |s, t| {
        let (_, across) = split(s * 2.0);
        let (_, down) = split(t * 3.0);
        let bar = across.min(1.0 - across).min(down.min(1.0 - down) * 0.8);
        let tree = noise.octaves(s * 9.0, t * 9.0, 4) + 1.5 * (t - 0.72);
        let sky = blend([0.95, 1.0, 1.05], [0.62, 0.80, 1.0], 1.0 - t);
        let view = blend(sky, [0.42, 0.55, 0.30], 0.8 * step(-0.05, 0.25, tree));
        let wood = [0.30, 0.27, 0.22];
        let rim = s.min(1.0 - s).min(t.min(1.0 - t));
        let glass = step(0.05, 0.075, bar) * step(0.03, 0.045, rim);
        with_gloss(blend(wood, view, glass), 0.0)
    })
}
