//! Matches of two photographs.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// A match: mutual nearest neighbors of two photographs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Match {
    /// Column and row in photograph 1, then in photograph 2.
    pub(super) places: [[f64; 2]; 2],
    /// Ratio of the distances to the nearest and the second nearest descriptor (Lowe).
    pub(super) ratio: f32,
    /// Whether the match is correct, if the truth is known.
    pub(super) is_right: Option<bool>,
}

impl Match {
    pub(super) fn pixel1(&self) -> Point2<f64> {
        self.places[0].into()
    }

    pub(super) fn pixel2(&self) -> Point2<f64> {
        self.places[1].into()
    }
}
