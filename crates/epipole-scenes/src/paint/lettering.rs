//! Letters for book spines, boxes and the marks of the long table.

use super::noise::{mix, split, step};

/// Columns and rows of a letter; one empty column follows it.
const COLUMNS: i32 = 5;
const ROWS: i32 = 7;

/// Returns seven rows of five bits, the leftmost column in the highest bit.
#[rustfmt::skip]
fn rows(letter: char) -> [u8; 7] {
    match letter {
        'A' => [0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001],
        'B' => [0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110],
        'C' => [0b01111, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b01111],
        'D' => [0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110],
        'E' => [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111],
        'F' => [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000],
        'G' => [0b01111, 0b10000, 0b10000, 0b10011, 0b10001, 0b10001, 0b01111],
        'H' => [0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001],
        'I' => [0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        'K' => [0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001],
        'L' => [0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111],
        'M' => [0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001],
        'N' => [0b10001, 0b11001, 0b10101, 0b10101, 0b10011, 0b10001, 0b10001],
        'O' => [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110],
        'P' => [0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000],
        'R' => [0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001],
        'S' => [0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110],
        'T' => [0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100],
        'U' => [0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110],
        'V' => [0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b01010, 0b00100],
        'W' => [0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001],
        'X' => [0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b01010, 0b10001],
        'Y' => [0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100],
        '0' => [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b01110, 0b10000, 0b11110, 0b10001, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0, 0, 0, 0, 0, 0b00110, 0b00110],
        '-' => [0, 0, 0, 0b01110, 0, 0, 0],
        _ => [0; 7],
    }
}

/// Letters in a line that is one unit high.
#[derive(Debug)]
pub(crate) struct Line {
    letters: Vec<[u8; 7]>,
}

impl Line {
    /// Sets a text in capitals, digits, points and hyphens; other characters leave a gap.
    pub(crate) fn new(text: &str) -> Self {
        Self {
            letters: text.chars().map(rows).collect(),
        }
    }

    /// Returns the width, in heights.
    pub(crate) fn width(&self) -> f32 {
        let columns = (COLUMNS + 1) * self.letters.len() as i32 - 1;
        columns as f32 / ROWS as f32
    }

    fn ink(&self, column: i32, row: i32) -> f32 {
        if column < 0 || !(0..ROWS).contains(&row) {
            return 0.0;
        }
        let (letter, within) = (column / (COLUMNS + 1), column % (COLUMNS + 1));
        self.letters.get(letter as usize).map_or(0.0, |rows| {
            let bit = COLUMNS - 1 - within;
            if bit < 0 {
                0.0
            } else {
                f32::from(rows[row as usize] >> bit & 1)
            }
        })
    }

    /// Returns the ink at (x, y), in heights from the line's upper left corner: 0 or 1 with soft,
    /// rounded edges.
    pub(crate) fn at(&self, x: f32, y: f32) -> f32 {
        if !(-0.2..=1.2).contains(&y) || x < -0.2 || x > self.width() + 0.2 {
            return 0.0;
        }
        let (column, fx) = split(x * ROWS as f32 - 0.5);
        let (row, fy) = split(y * ROWS as f32 - 0.5);
        let upper = mix(self.ink(column, row), self.ink(column + 1, row), fx);
        let lower = mix(self.ink(column, row + 1), self.ink(column + 1, row + 1), fx);
        step(0.32, 0.62, mix(upper, lower, fy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_i_is_a_bar() {
        let line = Line::new("I");
        assert!((line.width() - 5.0 / 7.0).abs() < 1e-6);
        assert_eq!(line.at(2.5 / 7.0, 0.5), 1.0);
        assert_eq!(line.at(0.5 / 7.0, 0.5), 0.0);
        assert_eq!(line.at(9.0, 0.5), 0.0);
        assert_eq!(Line::new("?").at(0.3, 0.5), 0.0);
    }
}
