//! Covers, spines and leaves of books.

use super::lettering::Line;
use super::noise::{Noise, blend, dim, mix, step, with_gloss};
use super::texture::Texture;

/// Paints gray bookcloth, to be tinted.
pub(crate) fn linen(noise: &'static Noise) -> Texture {
    Texture::paint(128, 128, true, move |s, t| {
        let weave = noise.tile(s, t, [128, 32]) + noise.tile(s + 0.5, t, [32, 128]);
        let worn = noise.octaves_tile(s, t, [8, 8], 3);
        let value = 0.62 * (1.0 + 0.20 * weave + 0.30 * worn);
        with_gloss([value; 3], 0.2)
    })
}

/// Paints the edges of a book's leaves, lines along s.
pub(crate) fn pages(noise: &'static Noise) -> Texture {
    Texture::paint(64, 128, true, move |s, t| {
        let leaf = noise.tile(s, t, [4, 128]) + 0.5 * noise.tile(s, t, [16, 64]);
        let stain = noise.octaves_tile(s, t, [4, 8], 3);
        let color = dim([0.66, 0.58, 0.43], 1.0 + 0.28 * leaf + 0.25 * stain);
        with_gloss(color, 0.0)
    })
}

/// Paints a spine: cloth in a color, raised bands, a label with the title and a gilt ornament.
///
/// `aspect` is length over thickness; the title runs along it.
pub(crate) fn book_spine(
    noise: &'static Noise,
    cloth: [f32; 3],
    label: [f32; 3],
    title: &str,
    aspect: f32,
    seed: f32,
) -> Texture {
    let line = Line::new(title);
    let gold = [0.78, 0.56, 0.20];
    Texture::paint(512, 64, false, move |s, t| {
        let (x, y) = (s * aspect, t);
        let weave = noise.value(x * 70.0, y * 24.0 + seed) + noise.value(x * 24.0, y * 70.0 + seed);
        let worn = noise.octaves(x * 1.7 + seed, y * 2.0, 4);
        // Rounded, with light from above.
        let round = 1.16 - 0.55 * (y - 0.25).max(0.0) - 0.9 * (0.10 - y).max(0.0);
        let mut color = dim(cloth, (1.0 + 0.11 * weave + 0.30 * worn) * round);
        let mut gloss = 0.25;
        for band in [0.055, 0.10, 0.90, 0.945] {
            let d = (s - band).abs() * aspect;
            color = blend(color, dim(gold, round), 0.85 * step(0.05, 0.03, d));
        }
        // Two ornaments of dots.
        for center in [0.155, 0.845] {
            let (px, py) = ((s - center) * aspect, y - 0.5);
            let r = (px * px + py * py).sqrt();
            let ring = step(0.05, 0.02, (r - 0.24).abs());
            let (a, b) = (px * py, px * px - py * py);
            let star = step(0.012, 0.004, (a * b).abs() * 3.0) * step(0.24, 0.20, r);
            color = blend(color, dim(gold, round), ring.max(0.8 * star));
        }
        // The title is set as large as the label allows.
        let size = 0.36f32.min(0.52 * aspect / line.width());
        let half = (line.width() * size + 0.5) / 2.0;
        let middle = (s - 0.5) * aspect;
        if middle.abs() < half && (0.14..0.86).contains(&y) {
            color = dim(label, round * (1.0 + 0.12 * weave));
            let rim = (half - middle.abs()).min((y - 0.14).min(0.86 - y));
            color = blend(
                color,
                dim(gold, round),
                step(0.075, 0.05, rim) * step(0.02, 0.035, rim),
            );
            let ink = line.at(middle / size + line.width() / 2.0, (y - 0.5) / size + 0.5);
            let rubbed = step(-0.75, -0.3, noise.octaves(x * 9.0, y * 9.0 + seed, 3));
            color = blend(color, dim(gold, round), ink * mix(0.5, 1.0, rubbed));
            gloss = mix(gloss, 1.0, ink);
        }
        with_gloss(color, gloss)
    })
}

/// Paints the front of a cover: cloth, a gilt frame, a medallion and rubbed corners.
pub(crate) fn book_cover(noise: &'static Noise, cloth: [f32; 3], title: &str) -> Texture {
    let line = Line::new(title);
    let gold = [0.72, 0.52, 0.20];
    Texture::paint(256, 256, false, move |s, t| {
        let weave = noise.value(s * 200.0, t * 50.0) + noise.value(s * 50.0, t * 150.0);
        let worn = noise.octaves(s * 5.0, t * 4.0, 4);
        let mut color = dim(cloth, 1.0 + 0.13 * weave + 0.35 * worn);
        let rim = s.min(1.0 - s).min(0.75 * t.min(1.0 - t));
        let mut ink =
            step(0.009, 0.005, (rim - 0.06).abs()).max(step(0.006, 0.003, (rim - 0.08).abs()));
        let (px, py) = ((s - 0.5) * 1.35, t - 0.5);
        let r = (px * px + py * py).sqrt();
        for ring in [0.14, 0.20, 0.215] {
            ink = ink.max(step(0.008, 0.003, (r - ring).abs()));
        }
        // Viewing rays of two eyes, which meet in the medallion.
        for sign in [-1.0f32, 1.0] {
            let off = px - sign * (py + 0.14) * 0.45;
            if r < 0.14 {
                ink = ink.max(step(0.010, 0.005, off.abs()));
            }
        }
        ink = ink.max(line.at(
            (s - 0.5) * 1.35 / 0.085 + line.width() / 2.0,
            (t - 0.13) / 0.085,
        ));
        let rubbed = mix(
            0.45,
            1.0,
            step(-0.5, 0.1, noise.octaves(s * 20.0, t * 20.0, 3)),
        );
        color = blend(color, gold, ink * rubbed);
        color = blend(
            color,
            [0.50, 0.42, 0.30],
            0.5 * step(0.02, 0.0, rim + 0.02 * worn),
        );
        with_gloss(color, mix(0.25, 1.0, ink))
    })
}
