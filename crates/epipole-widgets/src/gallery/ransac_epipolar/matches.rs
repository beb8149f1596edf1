//! Matches of two photographs.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// A feature of photograph 1 and the one of photograph 2 that looks most alike, each the other's
/// nearest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Match {
    /// Column and row in photograph 1, then in photograph 2.
    pub(super) places: [[f64; 2]; 2],
    /// Lowe's ratio: distance of the descriptors over that of the second nearest.
    pub(super) ratio: f32,
    /// Whether it is right, where the truth is known.
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
