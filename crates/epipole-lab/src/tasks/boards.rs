//! Boards, lenses and calibrated cameras, as they travel.

use super::Photograph;
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
}

impl LensModel {
    /// Its name in files and commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brown => "brown",
            Self::Rational => "rational",
            Self::Fisheye => "fisheye",
        }
    }

    /// The names of its numbers, in their order.
    pub fn coefficients(self) -> &'static [&'static str] {
        match self {
            Self::Brown => &["k1", "k2", "p1", "p2", "k3"],
            Self::Rational => &["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"],
            Self::Fisheye => &["k1", "k2", "k3", "k4"],
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

/// A board that was looked for in a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoardFound {
    /// The photograph, reduced for the screen.
    pub picture: Photograph,
    /// For each mark, row by row, its pixel in the photograph of full size, or none where something
    /// hides it; no marks at all if the board was not found.
    pub marks: Vec<Option<[f64; 2]>>,
    /// Why it was not found.
    pub problem: Option<String>,
    /// Marks along the longer and the shorter side of another grid that was found in its place.
    pub other_grid: Option<(u32, u32)>,
}

impl BoardFound {
    /// Position of a mark in the downscaled photograph.
    pub fn in_picture(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let full = self.picture.full_size;
        // Pixel centers are whole numbers, so a photograph begins half a pixel before the first.
        let moved = |at: f64, small: u32, full: u32| {
            (at + 0.5) * f64::from(small) / f64::from(full.max(1)) - 0.5
        };
        [
            moved(u, self.picture.width, full.0),
            moved(v, self.picture.height, full.1),
        ]
    }

    /// Number of visible marks.
    pub fn num_seen(&self) -> usize {
        self.marks.iter().flatten().count()
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

/// Calibration results for one photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ViewFound {
    /// Root mean square of its reprojection errors, pixels.
    pub rms_px: f64,
    /// Marks seen.
    pub num_marks: u32,
    /// Rotation of camera from board, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Translation of camera from board, meters.
    pub translation: [f64; 3],
}

/// A calibrated camera, and how sure it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// The camera.
    pub camera: LensCamera,
    /// Root mean square of all reprojection errors, pixels.
    pub rms_px: f64,
    /// One standard deviation of focal lengths and principal point, pixels.
    pub std_dev_k: [f64; 4],
    /// One standard deviation of each number of the lens.
    pub std_dev_lens: Vec<f64>,
    /// The share of the photograph that boards reach.
    pub coverage: f64,
    /// Of each photograph that was given.
    pub views: Vec<Option<ViewFound>>,
    /// Reasons why it is less accurate than the errors suggest: index of the photograph, if it is
    /// about one, and a sentence.
    pub warnings: Vec<(Option<u32>, String)>,
}
