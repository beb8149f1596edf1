//! Wood, plaster, and the window.

use super::lettering::Line;
use super::noise::{Noise, blend, dim, mix, split, step, with_gloss};
use super::texture::Texture;

/// Returns the color of oak at (x, y) meters, with the grain along x.
fn oak(noise: &Noise, x: f32, y: f32, board: f32, light: [f32; 3], dark: [f32; 3]) -> [f32; 3] {
    let shift = board * 7.31;
    let bend = noise.octaves(x * 1.9 + shift, y * 9.0 + shift, 2);
    // Growth rings, cut lengthwise: irregular bands.
    let ring = (y * 46.0 + bend * 7.5 + noise.value(x * 5.0 + shift, y * 30.0) * 0.4) * 0.5;
    let (_, phase) = split(ring);
    let band = step(0.0, 0.75, phase) * step(1.0, 0.86, phase);
    let fiber = noise.value(x * 26.0 + shift, y * 420.0);
    let fleck = noise.value(x * 38.0, y * 400.0 + shift);
    let pore = step(0.45, 0.85, fleck);
    let tone = 0.40 * band + 0.18 * fiber + 0.20 * bend + 0.28;
    let color = blend(light, dark, tone.clamp(0.0, 1.0));
    let color = dim(color, 1.0 - 0.40 * pore);
    // Boards differ in color.
    dim(color, 1.0 + 0.16 * noise.at(board as i32 * 5, 3))
}

/// Paints a table top of `num_boards` boards along s, with joints, scratches and ring marks.
pub(crate) fn boards(
    noise: &'static Noise,
    size: [u32; 2],
    extent_m: [f32; 2],
    num_boards: f32,
) -> Texture {
    let (light, dark) = ([0.46, 0.262, 0.128], [0.20, 0.098, 0.042]);
    Texture::paint(size[0], size[1], false, move |s, t| {
        let (x, y) = (s * extent_m[0], t * extent_m[1]);
        let (board, within) = split(t * num_boards);
        let mut color = oak(noise, x, y, board as f32, light, dark);
        let width_m = extent_m[1] / num_boards;
        let joint_m = within.min(1.0 - within) * width_m;
        color = dim(color, mix(0.30, 1.0, step(0.0, 0.0032, joint_m)));
        // Wear: pale scratches and a few darker stains.
        let stain = noise.octaves(x * 3.0 + 40.0, y * 3.0, 2);
        color = dim(color, 1.0 - 0.22 * step(0.12, 0.45, stain));
        if stain < -0.1 {
            let scratch = noise.value(x * 9.0 + y * 4.0, (y - 0.35 * x) * 310.0);
            let ink = 0.45 * step(0.72, 0.95, scratch) * step(-0.1, -0.3, stain);
            color = blend(color, [0.52, 0.36, 0.22], ink);
        }
        with_gloss(color, 0.55 - 0.3 * step(0.0, 0.4, stain))
    })
}

/// Returns the color of oak in a tile, with the grain along t.
fn oak_tile(
    noise: &Noise,
    [s, t]: [f32; 2],
    board: i32,
    light: [f32; 3],
    dark: [f32; 3],
) -> [f32; 3] {
    // A different part of the noise for each board; the period in t is kept, so that the tile
    // repeats.
    let (s, t) = (s + 0.37 * board as f32, t + 0.21 * board as f32);
    let bend = noise.octaves_tile(s, t, [16, 2], 2);
    let (_, phase) = split(s * 37.0 + bend * 4.0);
    let band = step(0.0, 0.75, phase) * step(1.0, 0.86, phase);
    let fiber = noise.tile(s * 2.0, t, [256, 16]);
    let pore = step(0.45, 0.85, noise.tile(s * 1.7, t, [256, 32]));
    let tone = 0.40 * band + 0.20 * fiber + 0.25 * bend + 0.28;
    let color = blend(light, dark, tone.clamp(0.0, 1.0));
    dim(
        color,
        (1.0 - 0.38 * pore) * (1.0 + 0.16 * noise.at(board * 5, 3)),
    )
}

/// Paints floor boards along t, seven per tile.
pub(crate) fn floor(noise: &'static Noise) -> Texture {
    let (light, dark) = ([0.25, 0.15, 0.085], [0.115, 0.062, 0.032]);
    Texture::paint(256, 256, true, move |s, t| {
        let (board, within) = split(s * 7.0);
        let color = oak_tile(noise, [s, t], board + 20, light, dark);
        let joint = within.min(1.0 - within);
        with_gloss(dim(color, mix(0.25, 1.0, step(0.0, 0.05, joint))), 0.3)
    })
}

/// Paints the top of the long table: one repeating meter along t, with marks every decimeter.
pub(crate) fn measured_boards(noise: &'static Noise, width_m: f32) -> Texture {
    let (light, dark) = ([0.44, 0.262, 0.132], [0.22, 0.112, 0.05]);
    let (pale, ebony) = ([0.60, 0.48, 0.32], [0.045, 0.033, 0.027]);
    Texture::paint(1024, 512, true, move |s, t| {
        let (board, within) = split(s * 9.0);
        let joint_m = within.min(1.0 - within) * width_m / 9.0;
        let mut color = oak_tile(noise, [s, t], board, light, dark);
        color = dim(color, mix(0.35, 1.0, step(0.0, 0.004, joint_m)));
        // Inlaid squares in two rows, alternately dark and light as on a measuring rod, and a line
        // across at every meter.
        let (decimeter, part) = split(t * 10.0);
        let side = (2.0 * s - 1.0).abs();
        if (0.44..0.49).contains(&side) {
            let inlay = if decimeter % 2 == 0 { pale } else { ebony };
            color = dim(inlay, 1.0 + 0.12 * noise.tile(s, t, [256, 64]));
            let seam_m =
                (part.min(1.0 - part) * 0.1).min((side - 0.44).min(0.49 - side) * width_m / 2.0);
            color = dim(color, mix(0.4, 1.0, step(0.0, 0.003, seam_m)));
        } else if side < 0.44 {
            let distance_m = t.min(1.0 - t);
            color = blend(color, ebony, 0.75 * step(0.0065, 0.005, distance_m));
        }
        with_gloss(color, 0.5)
    })
}

/// Paints a brass plate with a number of one or two digits.
pub(crate) fn number(noise: &'static Noise, meters: u32) -> Texture {
    let line = Line::new(&meters.to_string());
    Texture::paint(64, 64, false, move |s, t| {
        let rim = s.min(1.0 - s).min(t.min(1.0 - t));
        let brushed = 1.0 + 0.12 * noise.value(s * 6.0, t * 90.0 + meters as f32);
        let brass = dim([0.62, 0.44, 0.17], brushed);
        let ink = line.at((s - 0.5) / 0.62 + line.width() / 2.0, (t - 0.19) / 0.62);
        let color = blend(brass, [0.05, 0.035, 0.02], ink);
        let color = dim(color, mix(0.35, 1.0, step(0.03, 0.06, rim)));
        with_gloss(color, 1.0 - ink)
    })
}

/// Paints repeating lime-washed plaster: clouds, trowel strokes in raking light, flecks of an older
/// coat and spatter.
pub(crate) fn plaster(noise: &'static Noise) -> Texture {
    let (pale, deep, under) = (
        [0.40, 0.44, 0.39],
        [0.245, 0.305, 0.295],
        [0.50, 0.41, 0.30],
    );
    Texture::paint(512, 512, true, move |s, t| {
        let cloud = noise.octaves_tile(s, t, [4, 4], 4);
        let mut color = blend(pale, deep, step(-0.5, 0.5, cloud));
        // Relief in raking light: the height difference between two near positions.
        let (u, v) = (s + 0.02 * cloud, t + 0.3 * s);
        let height =
            |u: f32, v: f32| noise.tile(u, v, [32, 64]) + 0.5 * noise.tile(u + 0.4, v, [64, 128]);
        let relief = height(u, v) - height(u + 0.008, v + 0.004);
        let grain = noise.tile(s, t, [256, 256]);
        color = dim(color, 1.0 + 0.16 * relief + 0.10 * grain);
        // Flecks where the older coat shows, and dark and light spatter.
        let fleck = noise.octaves_tile(s, t, [32, 32], 3);
        color = blend(color, under, 0.55 * step(0.43, 0.52, fleck));
        let spatter = noise.tile(s + 0.2, t + 0.7, [128, 128]);
        let rare = noise.tile(s, t, [16, 16]);
        color = dim(
            color,
            1.0 - 0.32 * step(0.5, 0.9, spatter) * step(-0.2, 0.4, rare),
        );
        color = dim(color, 1.0 + 0.26 * step(-0.6, -0.85, spatter));
        with_gloss(color, 0.0)
    })
}

/// Paints a bright window of six panes, with a hint of a garden behind.
pub(crate) fn window(noise: &'static Noise) -> Texture {
    Texture::paint(128, 128, false, move |s, t| {
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
