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
    /// Creates a solid line.
    pub const fn solid(role: Role, width: f64) -> Self {
        Self {
            role,
            width,
            dash: Dash::Solid,
            cased: false,
        }
    }

    /// Returns the line dashed.
    pub const fn dashed(self) -> Self {
        Self {
            dash: Dash::Dashed,
            ..self
        }
    }

    /// Returns the line dotted.
    pub const fn dotted(self) -> Self {
        Self {
            dash: Dash::Dotted,
            ..self
        }
    }

    /// Returns the line dashed if `dashed`.
    pub fn dashed_if(self, dashed: bool) -> Self {
        if dashed { self.dashed() } else { self }
    }

    /// Returns the line dotted if `dotted`.
    pub fn dotted_if(self, dotted: bool) -> Self {
        if dotted { self.dotted() } else { self }
    }

    /// Creates the line of one of several curves, which differ in hue and pattern.
    pub fn of_series(series: usize, width: f64) -> Self {
        let stroke = Self::solid(Role::Series(series as u8), width);
        match series % 3 {
            0 => stroke,
            1 => stroke.dashed(),
            _ => stroke.dotted(),
        }
    }

    /// Returns the line with a casing.
    pub const fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}

/// Pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Continuous.
    Solid,
    /// Long dashes.
    Dashed,
    /// Short dashes.
    Dotted,
}

/// Shape of a marker.
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
    /// Returns the shape for [`Role::Series`], so that hue is never the only channel.
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
    /// Starts at the position.
    Start,
    /// Centered on the position.
    Middle,
    /// Ends at the position.
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
    /// Creates text that starts at its position.
    pub fn new(role: Role, size: f64) -> Self {
        Self {
            role,
            size,
            align: Align::Start,
            cased: false,
        }
    }

    /// Returns the style centered on its position.
    pub fn middle(self) -> Self {
        Self {
            align: Align::Middle,
            ..self
        }
    }

    /// Returns the style that ends at its position.
    pub fn end(self) -> Self {
        Self {
            align: Align::End,
            ..self
        }
    }

    /// Returns the style with a casing.
    pub fn cased(self) -> Self {
        Self {
            cased: true,
            ..self
        }
    }
}
