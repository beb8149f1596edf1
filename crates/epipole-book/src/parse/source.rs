//! Text whose parts keep their file and line.

use crate::problems::Place;
use std::ops::Range;

/// Text assembled from content files.
#[derive(Debug, Clone, Default)]
pub struct Source {
    text: String,
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    start: usize,
    place: Place,
    /// Whether line feeds of the piece are line feeds of the file.
    verbatim: bool,
}

impl Source {
    /// Creates a text copied from a file, beginning at `place`.
    pub fn new(text: impl Into<String>, place: Place) -> Source {
        Source {
            text: text.into(),
            pieces: vec![Piece {
                start: 0,
                place,
                verbatim: true,
            }],
        }
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns file and line of the byte at `offset`.
    pub fn place(&self, offset: usize) -> Place {
        let offset = offset.min(self.text.len());
        let index = self
            .pieces
            .partition_point(|piece| piece.start <= offset)
            .saturating_sub(1);
        let Some(piece) = self.pieces.get(index) else {
            return Place::new("", 1);
        };
        let mut place = piece.place.clone();
        if piece.verbatim {
            let passed = &self.text.as_bytes()[piece.start..offset];
            place.line += passed.iter().filter(|&&byte| byte == b'\n').count();
        }
        place
    }

    /// Appends text generated from the content at `place`.
    pub fn push(&mut self, text: &str, place: Place) {
        self.pieces.push(Piece {
            start: self.text.len(),
            place,
            verbatim: false,
        });
        self.text.push_str(text);
    }

    /// Appends a part of another source.
    pub fn push_slice(&mut self, other: &Source, range: Range<usize>) {
        let base = self.text.len();
        let first_place = other.place(range.start);
        let first = other
            .pieces
            .partition_point(|piece| piece.start <= range.start);
        let verbatim = first > 0 && other.pieces[first - 1].verbatim;
        self.pieces.push(Piece {
            start: base,
            place: first_place,
            verbatim,
        });
        for piece in &other.pieces[first..] {
            if piece.start < range.end {
                let start = base + piece.start - range.start;
                self.pieces.push(Piece {
                    start,
                    ..piece.clone()
                });
            }
        }
        self.text.push_str(&other.text[range]);
    }

    /// Returns a part of this source.
    pub fn slice(&self, range: Range<usize>) -> Source {
        let mut part = Source::default();
        part.push_slice(self, range);
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_survive_slicing_and_splicing() {
        let file = Source::new("one\ntwo\nthree\nfour\n", Place::new("a.md", 1));
        assert_eq!(file.place(4).line, 2);
        let mut spliced = file.slice(0..4);
        spliced.push("inserted\ntext\n", Place::new("a.md", 2));
        spliced.push_slice(&file, 8..19);
        assert_eq!(spliced.text(), "one\ninserted\ntext\nthree\nfour\n");
        let line_of = |word: &str| spliced.place(spliced.text().find(word).unwrap()).line;
        assert_eq!(
            (
                line_of("one"),
                line_of("text"),
                line_of("three"),
                line_of("four")
            ),
            (1, 2, 3, 4)
        );
    }

    #[test]
    fn an_empty_source_has_a_place() {
        assert_eq!(Source::default().place(3).line, 1);
    }
}
