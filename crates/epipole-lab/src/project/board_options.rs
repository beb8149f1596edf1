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

/// Layout of a board, without its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BoardOptions {
    /// Pattern of the marks.
    pub pattern: BoardPattern,
    /// Number of marks in a row.
    pub columns: u32,
    /// Number of rows.
    pub rows: u32,
}

/// Distortion model of a lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum LensModel {
    /// Five parameters (Brown-Conrady), for usual lenses.
    Brown,
    /// Eight parameters, for wide-angle lenses.
    Rational,
    /// Four parameters (Kannala-Brandt), for fields of view of 120° and more.
    Fisheye,
    /// One parameter (Fitzgibbon), only in cameras from files.
    Division,
}

impl LensModel {
    /// Returns its name in files and commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brown => "brown",
            Self::Rational => "rational",
            Self::Fisheye => "fisheye",
            Self::Division => "division",
        }
    }

    /// Returns the names of its parameters, in order.
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
    /// Side of a square, or distance of two rows of disks, meters.
    pub square_m: f64,
    /// Distortion model.
    pub lens: LensModel,
}

impl Default for CalibrationOptions {
    /// Returns the board of the sample.
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

/// Calibrated camera.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LensCamera {
    /// Width and height of its photographs, pixels.
    pub size: (u32, u32),
    /// Focal lengths and principal point, pixels.
    pub k: [f64; 4],
    /// Distortion model.
    pub lens: LensModel,
    /// Distortion parameters.
    pub coefficients: Vec<f64>,
}

impl LensCamera {
    /// Whether all of its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.k
            .iter()
            .chain(&self.coefficients)
            .all(|number| number.is_finite())
    }
}
