//! Boards, lenses and calibrated cameras.

use serde::{Deserialize, Serialize};

/// Pattern of a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BoardPattern {
    /// Squares; the marks are inner corners.
    Chessboard,
    /// Disks, every second row shifted.
    Circles,
}

/// A board, but for its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BoardOptions {
    /// Pattern.
    pub pattern: BoardPattern,
    /// Marks in a row.
    pub columns: u32,
    /// Rows of marks.
    pub rows: u32,
}

/// The model of a lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum LensModel {
    /// Five numbers (Brown and Conrady), for usual lenses.
    Brown,
    /// Eight numbers, for wide angles.
    Rational,
    /// Four numbers (Kannala and Brandt), for views of 120° and more.
    Fisheye,
    /// One number (Fitzgibbon), of cameras from files only.
    Division,
}

impl LensModel {
    /// Its name in files and commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brown => "brown",
            Self::Rational => "rational",
            Self::Fisheye => "fisheye",
            Self::Division => "division",
        }
    }

    /// The names of its numbers, in their order.
    pub fn coefficients(self) -> &'static [&'static str] {
        match self {
            Self::Brown => &["k1", "k2", "p1", "p2", "k3"],
            Self::Rational => &["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"],
            Self::Fisheye => &["k1", "k2", "k3", "k4"],
            Self::Division => &["k"],
        }
    }
}

/// Calibration settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CalibrationOptions {
    /// The board.
    pub board: BoardOptions,
    /// The side of a square, or the distance of two rows of disks, meters.
    pub square_m: f64,
    /// The model of the lens.
    pub lens: LensModel,
}

impl Default for CalibrationOptions {
    /// The board of the sample.
    fn default() -> Self {
        Self {
            board: BoardOptions {
                pattern: BoardPattern::Chessboard,
                columns: 9,
                rows: 6,
            },
            square_m: 0.025,
            lens: LensModel::Brown,
        }
    }
}

/// A camera with a known lens.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LensCamera {
    /// Width and height of its photographs, pixels.
    pub size: (u32, u32),
    /// Focal lengths and principal point, pixels.
    pub k: [f64; 4],
    /// The model of its lens.
    pub lens: LensModel,
    /// The numbers of the lens.
    pub coefficients: Vec<f64>,
}

impl LensCamera {
    /// Whether all of its numbers are.
    pub fn is_finite(&self) -> bool {
        self.k
            .iter()
            .chain(&self.coefficients)
            .all(|number| number.is_finite())
    }
}
