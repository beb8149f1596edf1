//! Styles of marks: lines, markers and text.

use crate::theme::Role;

/// Style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Meaning, which gives the color.
    pub role: Role,
    /// Width, CSS pixels.
    pub width: f64,
    /// Pattern.
    pub dash: Dash,
    /// Whether it has a casing, for visibility on a photograph.
    pub cased: bool,
}

impl Stroke {
    /// A solid line.
    pub const fn solid(role: Role, width: f64) -> Self {
        Self {
            role,
            width,
            dash: Dash::Solid,
            cased: false,
        }
    }

    /// The same line, dashed.
    pub const fn dashed(self) -> Self {
        Self {
            dash: Dash::Dashed,
            ..self
        }
    }

    /// The same line, dotted.
    pub const fn dotted(self) -> Self {
        Self {
            dash: Dash::Dotted,
            ..self
        }
    }

    /// The same line, dashed if `dashed`.
    pub fn dashed_if(self, dashed: bool) -> Self {
        if dashed { self.dashed() } else { self }
    }

    /// The same line, dotted if `dotted`.
    pub fn dotted_if(self, dotted: bool) -> Self {
        if dotted { self.dotted() } else { self }
    }

    /// The line of one of several curves: they differ in hue and in pattern.
    pub fn of_series(series: usize, width: f64) -> Self {
        let stroke = Self::solid(Role::Series(series as u8), width);
        match series % 3 {
            0 => stroke,
            1 => stroke.dashed(),
            _ => stroke.dotted(),
        }
    }

    /// The same line with a casing.
    pub const fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}

/// The pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// One piece.
    Solid,
    /// Long pieces.
    Dashed,
    /// Short pieces.
    Dotted,
}

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// A filled disk.
    Disk,
    /// A circle.
    Ring,
    /// A filled square.
    Square,
    /// A filled diamond.
    Diamond,
    /// A filled triangle, tip up.
    Triangle,
    /// Two crossed strokes, ×.
    Cross,
    /// Two crossed strokes, +.
    Plus,
}

impl Shape {
    /// The shape that goes with [`Role::Series`], so that hue is never the only channel.
    pub fn of_series(index: usize) -> Self {
        [
            Self::Disk,
            Self::Square,
            Self::Diamond,
            Self::Triangle,
            Self::Ring,
            Self::Plus,
        ][index % 6]
    }
}

/// Horizontal alignment of a text relative to its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// Style of a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// Meaning, which gives the color.
    pub role: Role,
    /// Size, CSS pixels.
    pub size: f64,
    /// Horizontal alignment.
    pub align: Align,
    /// Whether it has a casing, for legibility on a photograph or across lines.
    pub cased: bool,
}

impl TextStyle {
    /// Text that begins at its place.
    pub fn new(role: Role, size: f64) -> Self {
        Self {
            role,
            size,
            align: Align::Start,
            cased: false,
        }
    }

    /// The same text around its place.
    pub fn middle(self) -> Self {
        Self {
            align: Align::Middle,
            ..self
        }
    }

    /// The same text before its place.
    pub fn end(self) -> Self {
        Self {
            align: Align::End,
            ..self
        }
    }

    /// The same text with a casing.
    pub fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}
