//! Lines and paragraphs of text.

use super::{Align, Canvas, Place, TextStyle, glyphs};
use crate::Rect;
use crate::font::{self, CAP_HEIGHT};
use crate::theme::Role;

impl Canvas {
    /// Draws a line of text with `place` on its baseline.
    pub fn text(&mut self, place: Place, text: &str, style: TextStyle) {
        let width = text_width(text, style.size);
        let left = match style.align {
            Align::Start => place.0,
            Align::Middle => place.0 - width / 2.0,
            Align::End => place.0 - width,
        };
        let place = (left * self.scale, place.1 * self.scale);
        let size = style.size * self.scale;
        let mut draw = |casing: f64, role: Role| {
            let color = self.theme.color(role);
            glyphs::draw(&mut self.pixmap, text, place, size, casing, color);
        };
        if style.cased {
            draw(3.5 * self.scale, Role::Halo);
        }
        draw(0.0, style.role);
    }

    /// Draws a line of text whose capitals are vertically centered on `place`.
    pub fn label(&mut self, place: Place, text: &str, style: TextStyle) {
        self.text(
            (place.0, place.1 + style.size * CAP_HEIGHT / 2.0),
            text,
            style,
        );
    }

    /// Draws text in a rectangle from its top, broken between words. Returns the height used, CSS
    /// pixels.
    pub fn paragraph(&mut self, rect: Rect, text: &str, style: TextStyle) -> f64 {
        let line_height = line_height(style.size);
        let x = match style.align {
            Align::Start => rect.x,
            Align::Middle => rect.center().0,
            Align::End => rect.right(),
        };
        let lines = break_lines(text, style.size, rect.width);
        for (index, line) in lines.iter().enumerate() {
            let y = rect.y + (index as f64 + 0.5) * line_height;
            self.label((x, y), line, style);
        }
        lines.len() as f64 * line_height
    }
}

/// Returns the width of a line of text, CSS pixels.
pub fn text_width(text: &str, size: f64) -> f64 {
    font::width(text) * size
}

/// Returns the height of a paragraph of this width, CSS pixels.
pub fn paragraph_height(text: &str, size: f64, width: f64) -> f64 {
    break_lines(text, size, width).len() as f64 * line_height(size)
}

fn line_height(size: f64) -> f64 {
    (size * 1.4).round()
}

/// Breaks text between words into lines no wider than `width`; a longer word gets its own line.
fn break_lines(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), size) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_broken_between_words() {
        let lines = break_lines("one two three four", 10.0, text_width("one two", 10.0));
        assert_eq!(lines, ["one two", "three", "four"]);
        assert_eq!(break_lines("long", 10.0, 1.0), ["long"]);
        assert!(break_lines(" ", 10.0, 50.0).is_empty());
    }
}
