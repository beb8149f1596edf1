//! Text, drawn from glyphs that are rasterized once.
//!
//! Filling and stroking outlines is costly, and a figure shows the same few characters in every
//! frame. So each is rasterized once per size and quarter pixel, and then only blended.

use super::coverage::Coverage;
use super::place::At;
use super::stamp::{STEPS, Stamp, StampCache, pixel_and_step, stamp_width};
use super::strokes::Cap;
use crate::font::{self, Pen};
use crate::theme::Rgb;
use std::cell::RefCell;
use tiny_skia::Pixmap;

/// Maximum distance of a curve from its line segments, pixels.
const FLATNESS: f32 = 0.05;

thread_local! {
    static CACHE: RefCell<StampCache<Key>> = const { RefCell::new(StampCache::new()) };
}

/// Cache key of a glyph, in device pixels.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    character: char,
    /// Bits of the size.
    size: u32,
    /// Bits of the casing's width; 0 for the glyph itself.
    casing: u32,
    /// Subpixel position, in steps.
    step: u8,
}

/// Draws text. All arguments are in device pixels.
///
/// * `left`, `baseline`: start of the text; the baseline is rounded to a row of pixels
/// * `casing`: width of the casing to draw instead of the text; 0 for the text
pub(super) fn draw(
    pixmap: &mut Pixmap,
    text: &str,
    (left, baseline): (f64, f64),
    size: f64,
    casing: f64,
    color: Rgb,
) {
    let most = 1e6;
    if !(size > 0.0 && size < 1e4 && left.abs() < most && baseline.abs() < most) {
        return;
    }
    let y = baseline.round() as i32;
    CACHE.with_borrow_mut(|cache| {
        let mut pen_x = left;
        for character in text.chars() {
            let (x, step) = pixel_and_step(pen_x);
            let key = Key {
                character,
                size: (size as f32).to_bits(),
                casing: (casing as f32).to_bits(),
                step,
            };
            cache.stamp(key, rasterize).blend(pixmap, (x, y), color);
            pen_x += font::width(character.encode_utf8(&mut [0; 4])) * size;
        }
    });
}

fn rasterize(key: Key) -> Stamp {
    let (size, casing) = (f32::from_bits(key.size), f32::from_bits(key.casing));
    let x = f64::from(key.step) / f64::from(STEPS);
    let mut pen = Contours::default();
    font::draw(
        key.character.encode_utf8(&mut [0; 4]),
        x,
        0.0,
        f64::from(size),
        &mut pen,
    );
    cover(pen.0, casing)
}

/// Covers the inside of an outline, or the casing around it.
fn cover(mut contours: Vec<Vec<At>>, casing: f32) -> Stamp {
    let places = || contours.iter().flatten();
    if places().next().is_none() {
        return Stamp::default();
    }
    let lowest = |of: fn(&At) -> f32| places().map(of).fold(f32::INFINITY, f32::min);
    let highest = |of: fn(&At) -> f32| places().map(of).fold(f32::NEG_INFINITY, f32::max);
    let margin = 0.5 * casing + 1.0;
    let left = (lowest(|at| at.0) - margin).floor();
    let top = (lowest(|at| at.1) - margin).floor();
    let width = stamp_width((highest(|at| at.0) + margin - left).ceil() as usize);
    let height = (highest(|at| at.1) + margin - top).ceil() as usize;
    for at in contours.iter_mut().flatten() {
        *at = (at.0 - left, at.1 - top);
    }
    let mut coverage = Coverage::default().sized(width, height);
    coverage.add_contours(&contours.iter().map(Vec::as_slice).collect::<Vec<_>>());
    if casing > 0.0 {
        for contour in &contours {
            for (from, to) in contour.iter().zip(contour.iter().cycle().skip(1)) {
                coverage.add_segment(*from, *to, casing, Cap::Round);
            }
        }
    }
    Stamp {
        left: left as i32,
        top: top as i32,
        width,
        alpha: coverage.into_alpha(),
        over: Vec::new(),
    }
}

/// Outlines as closed polygons.
#[derive(Default)]
struct Contours(Vec<Vec<At>>);

impl Contours {
    fn add(&mut self, at: At) {
        if let Some(contour) = self.0.last_mut() {
            contour.push(at);
        }
    }
}

impl Pen for Contours {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.push(vec![(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add((x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let Some(&(x0, y0)) = self.0.last().and_then(|contour| contour.last()) else {
            return;
        };
        // The error of a piece, one of n, is a quarter of the curve's second difference over n².
        let bend = ((x0 - 2.0 * x1 + x).abs()).max((y0 - 2.0 * y1 + y).abs());
        let num_pieces = (0.25 * bend / FLATNESS).sqrt().ceil().clamp(1.0, 64.0);
        for piece in 1..=num_pieces as u32 {
            let t = piece as f32 / num_pieces;
            let s = 1.0 - t;
            let between = |a: f32, b: f32, c: f32| s * s * a + 2.0 * s * t * b + t * t * c;
            self.add((between(x0, x1, x), between(y0, y1, y)));
        }
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scale of the reference along each side.
    const FINER: u32 = 8;

    fn drawn(text: &str, place: (f64, f64), casing: f64) -> Vec<u8> {
        let mut pixmap = Pixmap::new(60, 30).unwrap();
        pixmap.fill(tiny_skia::Color::WHITE);
        draw(&mut pixmap, text, place, 20.0, casing, [0, 0, 0]);
        pixmap.data().to_vec()
    }

    #[test]
    fn a_cached_glyph_equals_a_new_one() {
        let first = drawn("e₂ = 0", (3.3, 20.0), 0.0);
        CACHE.with_borrow_mut(StampCache::forget);
        assert_eq!(first, drawn("e₂ = 0", (3.3, 20.0), 0.0));
        assert_eq!(first, drawn("e₂ = 0", (3.3, 20.0), 0.0));
        assert!(first.iter().any(|&byte| byte < 40));
    }

    /// Returns the coverage by tiny-skia's own fill or stroke of an eight times larger outline,
    /// averaged, 0 to 255 per pixel.
    fn by_tiny_skia(character: char, size: f64, casing: f32) -> Vec<u8> {
        use tiny_skia::{FillRule, LineCap, LineJoin, Mask, PathBuilder, Stroke, Transform};
        struct Path(PathBuilder);
        impl Pen for Path {
            fn move_to(&mut self, x: f32, y: f32) {
                self.0.move_to(x, y);
            }
            fn line_to(&mut self, x: f32, y: f32) {
                self.0.line_to(x, y);
            }
            fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
                self.0.quad_to(x1, y1, x, y);
            }
            fn close(&mut self) {
                self.0.close();
            }
        }
        let mut pen = Path(PathBuilder::new());
        let times = f64::from(FINER);
        let (x, y) = (20.0 * times, 40.0 * times);
        font::draw(&character.to_string(), x, y, size * times, &mut pen);
        let path = pen.0.finish().unwrap();
        let mut mask = Mask::new(80 * FINER, 60 * FINER).unwrap();
        mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
        if casing > 0.0 {
            let stroke = Stroke {
                width: casing * FINER as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                ..Stroke::default()
            };
            let outline = path.stroke(&stroke, 1.0).unwrap();
            mask.fill_path(&outline, FillRule::Winding, true, Transform::identity());
        }
        let sum = |u: u32, v: u32| -> u32 {
            let rows = v * FINER..(v + 1) * FINER;
            let row = |v: u32| {
                let start = (v * 80 * FINER + u * FINER) as usize;
                let part = &mask.data()[start..start + FINER as usize];
                part.iter().map(|&alpha| u32::from(alpha)).sum::<u32>()
            };
            rows.map(row).sum()
        };
        let pixels = (0..60).flat_map(|v| (0..80).map(move |u| (u, v)));
        pixels
            .map(|(u, v)| (sum(u, v) / (FINER * FINER)) as u8)
            .collect()
    }

    #[test]
    fn glyphs_are_those_of_another_rasterizer() {
        for (character, size, casing) in [
            ('R', 13.0, 0.0),
            ('e', 13.0, 0.0),
            ('8', 26.0, 0.0),
            ('λ', 26.0, 0.0),
            ('%', 24.0, 0.0),
            ('g', 26.0, 7.0),
            ('4', 13.0, 3.5),
        ] {
            let expected = by_tiny_skia(character, size, casing);
            let mut pixmap = Pixmap::new(80, 60).unwrap();
            pixmap.fill(tiny_skia::Color::BLACK);
            let white = [255, 255, 255];
            let text = character.to_string();
            draw(
                &mut pixmap,
                &text,
                (20.0, 40.0),
                size,
                f64::from(casing),
                white,
            );
            let ours = pixmap.data().chunks(4).map(|pixel| pixel[0]);
            let off: Vec<f64> = (ours.zip(&expected))
                .map(|(a, b)| (f64::from(a) - f64::from(*b)).abs())
                .collect();
            let inked = expected.iter().filter(|&&alpha| alpha > 0).count() as f64;
            let mean = off.iter().sum::<f64>() / inked;
            let most = off.iter().copied().fold(0.0, f64::max);
            // Casings are covered by distance, which gives slightly less at the joints of pieces.
            let limit = if casing > 0.0 { 64.0 } else { 24.0 };
            assert!(
                mean < 4.0 && most < limit,
                "{character}: {mean} and {most} of 255"
            );
        }
    }

    #[test]
    fn the_casing_is_around_the_text() {
        let dark = |bytes: Vec<u8>| bytes.iter().filter(|&&byte| byte < 128).count();
        assert!(dark(drawn("o", (20.0, 20.0), 4.0)) > dark(drawn("o", (20.0, 20.0), 0.0)));
    }

    #[test]
    fn text_over_the_edge_is_cut() {
        for place in [
            (-8.0, 2.0),
            (55.0, 33.0),
            (1e9, 0.0),
            (f64::NAN, 0.0),
            (-500.0, -500.0),
        ] {
            drawn("edge", place, 3.0);
        }
    }
}
