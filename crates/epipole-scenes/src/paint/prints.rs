//! Cloth and pictures.

use super::lettering::Line;
use super::noise::{Noise, blend, dim, mix, split, step, with_gloss};
use super::texture::Texture;

/// Returns 1 inside of a shape with signed distance `d`, with an edge `soft` wide.
fn inside(d: f32, soft: f32) -> f32 {
    step(soft, -soft, d)
}

/// Paints woven cotton with a block print: a field of flowers in two inks within a double border.
///
/// `aspect` is width over height.
pub(crate) fn block_print(noise: &'static Noise, aspect: f32) -> Texture {
    let (ground, indigo, rust) = (
        [0.66, 0.60, 0.47],
        [0.045, 0.085, 0.24],
        [0.50, 0.115, 0.05],
    );
    Texture::paint(512, 256, false, move |s, t| {
        // In units of the height.
        let (x, y) = (s * aspect, t);
        let rim = x.min(aspect - x).min(y.min(1.0 - y));
        // Irregular, as the block is cut by hand.
        let wobble = 0.010 * noise.value(x * 14.0, y * 14.0);
        let mut color = ground;
        if rim > 0.155 {
            // Half-drop repeat.
            let cell = 0.115;
            let (column, cx) = split((x - aspect / 2.0) / cell);
            let drop = if column & 1 == 0 { 0.0 } else { 0.5 };
            let (row, cy) = split(y / cell + drop);
            let (px, py) = (cx - 0.5 + wobble, cy - 0.5 + wobble);
            let r = (px * px + py * py).sqrt();
            // Eight petals: the cosine of four times the angle, doubled, as a polynomial.
            let (a, b) = (px * px - py * py, 2.0 * px * py);
            let r4 = (r * r * r * r).max(1e-9);
            let eight = 1.0 - 8.0 * a * a * b * b / (r4 * r4);
            let petals = inside(r - (0.27 + 0.085 * eight), 0.02);
            let hole = inside(r - 0.15, 0.02);
            let eye = inside(r - 0.085, 0.02);
            // The ink of a block varies from print to print.
            let print = 0.80 + 0.14 * noise.at(column * 3 + 11, row * 5);
            color = blend(color, indigo, petals * (1.0 - hole) * print);
            color = blend(color, rust, eye * print);
            let (qx, qy) = (px.abs() - 0.5, py.abs() - 0.5);
            let leaf = qx.abs() + 0.6 * qy.abs() - 0.105;
            color = blend(color, rust, 0.85 * inside(leaf, 0.02));
        } else {
            // A running border: lines, triangles, dots.
            let along = if x.min(aspect - x) < y.min(1.0 - y) {
                y
            } else {
                x
            };
            let (index, part) = split(along / 0.052);
            if rim > 0.125 || (0.030..0.046).contains(&rim) {
                color = blend(color, indigo, 0.9);
            } else if rim > 0.055 && rim < 0.118 {
                let slope = ((part - 0.5).abs() * 2.0 - (rim - 0.055) / 0.063) * 0.05;
                let ink = if index & 1 == 0 { rust } else { indigo };
                color = blend(color, ink, 0.88 * inside(slope + wobble * 0.3, 0.002));
            } else if rim < 0.024 {
                color = blend(color, rust, 0.55);
            }
        }
        // Threads of the weave.
        let (wx, wy) = (x * 300.0, y * 300.0);
        let weave = noise.value(wx, y * 40.0) + noise.value(x * 40.0 + 70.0, wy);
        let crease = 0.6 * noise.value(x * 3.0 + y * 2.0, y * 2.0 - x);
        color = dim(color, 1.0 + 0.10 * weave + 0.16 * crease);
        with_gloss(color, 0.0)
    })
}

/// Returns the color of the frame around a picture; `None` where the picture itself is visible.
///
/// (x, y) and the picture's size are in meters.
fn frame(
    noise: &Noise,
    x: f32,
    y: f32,
    size: [f32; 2],
    widths_m: [f32; 2],
    wood: [f32; 3],
) -> Option<[f32; 3]> {
    let (left, right) = (x, size[0] - x);
    let (upper, lower) = (y, size[1] - y);
    let rim = left.min(right).min(upper.min(lower));
    let [moulding, mat] = widths_m;
    if rim < moulding {
        let part = rim / moulding;
        let grain = if upper.min(lower) < left.min(right) {
            noise.value(x * 40.0, y * 500.0)
        } else {
            noise.value(x * 500.0, y * 40.0)
        };
        // A rounded bar, lit from the upper left.
        let round = 1.0 - (2.0 * part - 1.0) * (2.0 * part - 1.0);
        let lit = if rim == left || rim == upper {
            part < 0.5
        } else {
            part > 0.5
        };
        let relief = 0.55 + 0.45 * round + if lit { 0.35 } else { 0.0 };
        return Some(dim(wood, relief * (1.0 + 0.25 * grain)));
    }
    if rim < moulding + mat {
        let depth = rim - moulding;
        let paper = 1.0 + 0.03 * noise.value(x * 300.0, y * 300.0);
        let shade = 0.72 + 0.28 * step(0.0, 0.012, depth);
        let bevel = if mat - depth < 0.003 { 0.75 } else { 1.0 };
        return Some(dim([0.74, 0.71, 0.63], paper * shade * bevel));
    }
    None
}

/// Paints a framed landscape: hills behind hills, a lake and a low sun.
pub(crate) fn landscape(noise: &'static Noise, size: [f32; 2]) -> Texture {
    const SIDE: u32 = 256;
    // Skyline of each ridge, one value per column.
    let skylines: [Vec<f32>; 5] = std::array::from_fn(|ridge| {
        let depth = ridge as f32 / 4.0;
        let skyline = (0..SIDE).map(|x| {
            let s = (x as f32 + 0.5) / SIDE as f32;
            let place = s * (2.4 + 1.6 * depth) + 13.0 * depth;
            let rise = noise.octaves(place, 3.3 * depth + 1.0, 5);
            0.44 + 0.30 * depth - 0.17 * rise * (1.3 - 0.6 * depth)
        });
        skyline.collect()
    });
    Texture::paint(SIDE, SIDE, false, move |s, t| {
        let (x, y) = (s * size[0], t * size[1]);
        if let Some(color) = frame(noise, x, y, size, [0.028, 0.05], [0.20, 0.105, 0.045]) {
            return with_gloss(color, 0.5);
        }
        let sky = blend([0.20, 0.36, 0.55], [0.95, 0.62, 0.34], step(0.12, 0.56, t));
        let cloud = noise.octaves(s * 5.0 + 3.0, t * 17.0, 4);
        let mut color = blend(sky, [0.98, 0.86, 0.70], 0.75 * step(0.0, 0.45, cloud));
        let (dx, dy) = ((s - 0.66) * size[0], (t - 0.47) * size[1]);
        let sun = (dx * dx + dy * dy).sqrt();
        color = blend(color, [1.0, 0.93, 0.66], step(0.026, 0.020, sun));
        for (ridge, skyline) in skylines.iter().enumerate().rev() {
            let depth = ridge as f32 / 4.0;
            let height = skyline[(s * SIDE as f32) as usize];
            if t > height {
                let far = blend([0.36, 0.40, 0.52], [0.045, 0.105, 0.055], depth);
                let trees = noise.octaves(s * 34.0, (t - height) * 46.0 + 9.0 * depth, 3);
                color = dim(far, 1.0 + (0.25 + 0.6 * depth) * trees);
                break;
            }
        }
        // The lake mirrors the sky in broken strokes.
        let shore = 0.73 + 0.03 * noise.value(s * 5.0, 0.5);
        if t > shore && t < 0.86 + 0.04 * noise.value(s * 4.0 + 5.0, 2.0) {
            let stroke = noise.value(s * 16.0, t * 120.0);
            color = blend(
                [0.16, 0.25, 0.34],
                [0.93, 0.68, 0.42],
                step(-0.1, 0.7, stroke),
            );
        }
        let brush = noise.value(s * 120.0 + t * 30.0, t * 60.0 - s * 20.0);
        with_gloss(dim(color, 0.82 * (1.0 + 0.14 * brush)), 0.5)
    })
}

/// Paints a framed composition of tilted, colored rectangles and discs.
pub(crate) fn geometric(noise: &'static Noise, size: [f32; 2]) -> Texture {
    const COLORS: [[f32; 3]; 7] = [
        [0.62, 0.10, 0.055],
        [0.72, 0.42, 0.06],
        [0.055, 0.14, 0.34],
        [0.66, 0.61, 0.50],
        [0.09, 0.27, 0.24],
        [0.035, 0.032, 0.036],
        [0.52, 0.26, 0.15],
    ];
    Texture::paint(256, 256, false, move |s, t| {
        let (x, y) = (s * size[0], t * size[1]);
        if let Some(color) = frame(noise, x, y, size, [0.018, 0.035], [0.035, 0.032, 0.030]) {
            return with_gloss(color, 0.5);
        }
        let (u, v) = (s * 7.0 + 0.7 * t, t * 8.0 - 0.6 * s);
        let (column, fx) = split(u);
        let (row, fy) = split(v);
        let pick = |seed: i32| {
            let value = noise.at(column * 7 + seed, row * 3 + 2 * seed);
            ((value * 0.5 + 0.5) * 6.99) as usize
        };
        let mut color = COLORS[pick(1)];
        if noise.at(column + 50, row + 9) > 0.1 {
            let r = ((fx - 0.5) * (fx - 0.5) + (fy - 0.5) * (fy - 0.5)).sqrt();
            color = blend(color, COLORS[pick(4)], inside(r - 0.33, 0.02));
            color = blend(color, COLORS[pick(6)], inside(r - 0.16, 0.02));
        } else if noise.at(column + 20, row + 70) > 0.0 {
            color = blend(color, COLORS[pick(3)], inside(fx - fy, 0.02));
        }
        let seam = fx.min(1.0 - fx).min(fy.min(1.0 - fy));
        color = blend([0.60, 0.56, 0.47], color, step(0.02, 0.05, seam));
        let canvas = noise.value(s * 128.0, t * 60.0) + noise.value(s * 60.0, t * 128.0 + 9.0);
        let dry = noise.octaves(s * 21.0, t * 9.0, 3);
        with_gloss(dim(color, 0.9 * (1.0 + 0.09 * canvas + 0.22 * dry)), 0.4)
    })
}

/// Paints a framed chart of the sky: circles, spokes, stars and a title.
pub(crate) fn star_chart(noise: &'static Noise, size: [f32; 2]) -> Texture {
    let title = Line::new("PARALLAX");
    let small = Line::new("SIX MONTHS . TWO VIEWS");
    Texture::paint(256, 256, false, move |s, t| {
        let (x, y) = (s * size[0], t * size[1]);
        if let Some(color) = frame(noise, x, y, size, [0.022, 0.012], [0.34, 0.22, 0.09]) {
            return with_gloss(color, 0.5);
        }
        let paper = noise.octaves(s * 6.0, t * 6.0, 4);
        let ground = blend(
            [0.030, 0.060, 0.135],
            [0.055, 0.105, 0.19],
            step(-0.4, 0.4, paper),
        );
        let gold = [0.80, 0.62, 0.30];
        let (px, py) = ((s - 0.5) * size[0], (t - 0.43) * size[1]);
        let r = (px * px + py * py).sqrt() / (0.38 * size[0]);
        let mut ink = 0.0f32;
        for ring in [0.34, 0.62, 0.96, 1.0] {
            ink = ink.max(inside((r - ring).abs() - 0.007, 0.006));
        }
        if (0.34..0.96).contains(&r) {
            // Twelve spokes: products of lines through the center.
            for (a, b) in [
                (1.0, 0.0),
                (0.866, 0.5),
                (0.5, 0.866),
                (0.0, 1.0),
                (0.5, -0.866),
                (0.866, -0.5),
            ] {
                let off: f32 = (px * a + py * b) / size[0];
                ink = ink.max(0.7 * inside(off.abs() - 0.0018, 0.002));
            }
        }
        // Stars of several magnitudes, and the path of the nearest one.
        let (column, fx) = split(s * 26.0);
        let (row, fy) = split(t * 26.0 * size[1] / size[0]);
        let magnitude = noise.at(column + 100, row + 33);
        if magnitude > 0.25 && r < 0.95 {
            let (ox, oy) = (
                0.5 + 0.28 * noise.at(column + 7, row),
                0.5 + 0.28 * noise.at(column, row + 7),
            );
            let d = ((fx - ox) * (fx - ox) + (fy - oy) * (fy - oy)).sqrt();
            ink = ink.max(inside(d - 0.26 * magnitude, 0.06));
        }
        let (ex, ey) = (px / size[0] + 0.02, py / size[1] * 2.4);
        let oval = (ex * ex + ey * ey).sqrt();
        ink = ink.max(inside((oval - 0.09).abs() - 0.006, 0.004));
        let letter = |line: &Line, top: f32, height: f32| {
            line.at(
                (s - 0.5) * size[0] / (height * size[1]) + line.width() / 2.0,
                (t - top) / height,
            )
        };
        ink = ink
            .max(letter(&title, 0.80, 0.055))
            .max(0.8 * letter(&small, 0.875, 0.022));
        let worn = mix(
            0.75,
            1.0,
            step(-0.6, 0.2, noise.octaves(s * 30.0, t * 30.0, 3)),
        );
        with_gloss(dim(blend(ground, gold, ink * worn), 1.1), 0.5)
    })
}
