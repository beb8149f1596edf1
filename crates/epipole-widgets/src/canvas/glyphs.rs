//! Text, drawn from glyphs that are rasterized once.
//!
//! Outlines are costly to fill and far more costly to stroke, and a figure shows the same few
//! characters in every frame. So each is rasterized once for a size and a quarter of a pixel, and
//! then only blended.

use super::stamp::{Kept, STEPS, Stamp, pixel_and_step};
use crate::font::{self, Pen};
use crate::theme::Rgb;
use std::cell::RefCell;
use tiny_skia::{FillRule, LineCap, LineJoin, Mask, Path, PathBuilder, Pixmap, Stroke, Transform};

thread_local! {
    static KEPT: RefCell<Kept<Key>> = const { RefCell::new(Kept::new()) };
}

/// What a glyph looks like, in device pixels.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    character: char,
    /// Bits of the size.
    size: u32,
    /// Bits of the casing's width; 0 for the glyph itself.
    casing: u32,
    /// Place within the pixel, in steps.
    step: u8,
}

/// Draws text; everything in device pixels.
///
/// * `left`, `baseline`: where it begins; the baseline is moved to the nearest row of pixels
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
    KEPT.with_borrow_mut(|kept| {
        let mut pen_x = left;
        for character in text.chars() {
            let (x, step) = pixel_and_step(pen_x);
            let key = Key {
                character,
                size: (size as f32).to_bits(),
                casing: (casing as f32).to_bits(),
                step,
            };
            kept.stamp(key, rasterize).blend(pixmap, (x, y), color);
            pen_x += font::width(character.encode_utf8(&mut [0; 4])) * size;
        }
    });
}

fn rasterize(key: Key) -> Stamp {
    outline(key)
        .and_then(|path| cover(&path))
        .unwrap_or_default()
}

fn outline(key: Key) -> Option<Path> {
    let mut pen = PathPen(PathBuilder::new());
    let (size, casing) = (f32::from_bits(key.size), f32::from_bits(key.casing));
    let x = f64::from(key.step) / f64::from(STEPS);
    let text = key.character.encode_utf8(&mut [0; 4]).to_owned();
    font::draw(&text, x, 0.0, f64::from(size), &mut pen);
    let path = pen.0.finish()?;
    if casing == 0.0 {
        return Some(path);
    }
    let stroke = Stroke {
        width: casing,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    path.stroke(&stroke, 1.0)
}

fn cover(path: &Path) -> Option<Stamp> {
    let bounds = path.bounds();
    let (left, top) = (bounds.left().floor() - 1.0, bounds.top().floor() - 1.0);
    let width = (bounds.right() - left).ceil() + 1.0;
    let height = (bounds.bottom() - top).ceil() + 1.0;
    let mut mask = Mask::new(width as u32, height as u32)?;
    let shift = Transform::from_translate(-left, -top);
    mask.fill_path(path, FillRule::Winding, true, shift);
    Some(Stamp {
        left: left as i32,
        top: top as i32,
        width: width as usize,
        alpha: mask.data().to_vec(),
    })
}

struct PathPen(PathBuilder);

impl Pen for PathPen {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(text: &str, place: (f64, f64), casing: f64) -> Vec<u8> {
        let mut pixmap = Pixmap::new(60, 30).unwrap();
        pixmap.fill(tiny_skia::Color::WHITE);
        draw(&mut pixmap, text, place, 20.0, casing, [0, 0, 0]);
        pixmap.data().to_vec()
    }

    #[test]
    fn a_kept_glyph_is_the_same_as_a_new_one() {
        let first = drawn("e₂ = 0", (3.3, 20.0), 0.0);
        KEPT.with_borrow_mut(Kept::forget);
        assert_eq!(first, drawn("e₂ = 0", (3.3, 20.0), 0.0));
        assert_eq!(first, drawn("e₂ = 0", (3.3, 20.0), 0.0));
        assert!(first.iter().any(|&byte| byte < 40));
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
