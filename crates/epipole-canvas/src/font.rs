//! The embedded font: outlines and widths of characters.

use std::sync::OnceLock;
use ttf_parser::{GlyphId, OutlineBuilder, RawFace, Tag, cmap, glyf, head, hhea, hmtx, loca, maxp};

/// Height of a capital letter of size 1.
pub(crate) const CAP_HEIGHT: f64 = 0.698;

/// The font tables needed here. `ttf_parser::Face` would add all others to the module.
struct Font {
    units_per_em: u16,
    letters: cmap::Subtable<'static>,
    advances: hmtx::Table<'static>,
    outlines: glyf::Table<'static>,
}

impl Font {
    fn parse() -> Option<Self> {
        let file = RawFace::parse(crate::FONT, 0).ok()?;
        let table = |name| file.table(Tag::from_bytes(name));
        let head = head::Table::parse(table(b"head")?)?;
        let hhea = hhea::Table::parse(table(b"hhea")?)?;
        let num_glyphs = maxp::Table::parse(table(b"maxp")?)?.number_of_glyphs;
        let places =
            loca::Table::parse(num_glyphs, head.index_to_location_format, table(b"loca")?)?;
        let letters = cmap::Table::parse(table(b"cmap")?)?;
        Some(Self {
            units_per_em: head.units_per_em,
            letters: letters
                .subtables
                .into_iter()
                .find(|list| list.is_unicode())?,
            advances: hmtx::Table::parse(hhea.number_of_metrics, num_glyphs, table(b"hmtx")?)?,
            outlines: glyf::Table::parse(places, table(b"glyf")?)?,
        })
    }

    fn glyph_index(&self, character: char) -> Option<GlyphId> {
        self.letters.glyph_index(character.into())
    }
}

fn font() -> &'static Font {
    static FONT: OnceLock<Font> = OnceLock::new();
    FONT.get_or_init(|| Font::parse().expect("the embedded font is valid; a test reads it"))
}

/// Returns the glyph of a character, or a question mark if the font lacks it.
fn glyph(character: char) -> GlyphId {
    let font = font();
    font.glyph_index(character)
        .or_else(|| font.glyph_index('?'))
        .unwrap_or(GlyphId(0))
}

/// Returns the width of one character of size 1.
fn advance(character: char) -> f64 {
    let units = font().advances.advance(glyph(character)).unwrap_or(0);
    f64::from(units) / f64::from(font().units_per_em)
}

/// Returns the width of a line of text of size 1.
pub(crate) fn width(text: &str) -> f64 {
    text.chars().map(advance).sum()
}

/// Receives the outline of a line of text, y down.
pub(crate) trait Pen {
    fn move_to(&mut self, x: f32, y: f32);
    fn line_to(&mut self, x: f32, y: f32);
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32);
    fn close(&mut self);
}

/// Draws a line of text with `pen`, the left end of its baseline at (x, y).
pub(crate) fn draw(text: &str, x: f64, y: f64, size: f64, pen: &mut dyn Pen) {
    let scale = (size / f64::from(font().units_per_em)) as f32;
    let mut left = x;
    for character in text.chars() {
        let mut placed = Placed {
            pen,
            x: left as f32,
            y: y as f32,
            scale,
        };
        // `None` means a character without an outline, such as a space.
        let _ = font().outlines.outline(glyph(character), &mut placed);
        left += advance(character) * size;
    }
}

struct Placed<'a> {
    pen: &'a mut dyn Pen,
    x: f32,
    y: f32,
    scale: f32,
}

impl Placed<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, self.y - y * self.scale)
    }
}

impl OutlineBuilder for Placed<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.pen.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.pen.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.pen.quad_to(x1, y1, x, y);
    }

    /// Never called, as TrueType outlines have no cubic curves.
    fn curve_to(&mut self, _x1: f32, _y1: f32, _x2: f32, _y2: f32, x: f32, y: f32) {
        self.line_to(x, y);
    }

    fn close(&mut self) {
        self.pen.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_figures_write() {
        let text = "Aa0 ½?−×′₁₂²°λσεθΣ→≤≥≈∞·";
        let missing: Vec<char> = text
            .chars()
            .filter(|&c| c != '½' && font().glyph_index(c).is_none())
            .collect();
        assert!(missing.is_empty(), "missing {missing:?}");
        assert!(width("WW") > 1.5 && width("WW") < 2.2);
    }

    #[test]
    fn capitals_are_as_high_as_stated() {
        let bounds = font().outlines.bbox(glyph('H')).unwrap();
        let height = f64::from(bounds.y_max) / f64::from(font().units_per_em);
        assert!((height - CAP_HEIGHT).abs() < 0.002, "{height}");
    }
}
