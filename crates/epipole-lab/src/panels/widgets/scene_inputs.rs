//! Inputs of the scene of the 3D view.

use crate::project::{CropBox, Key, PhotoId, PointSet};
use crate::session::{Floor, Layers};
use epipole_canvas::theme::Theme;

/// Meaning of a point's color.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Coloring {
    /// Colors of the photographs.
    #[default]
    Photographs,
    /// Reprojection error.
    Error,
    /// Track length: number of photographs that see it.
    Track,
}

/// Inputs of the current scene; it is rebuilt when they change.
#[derive(PartialEq)]
pub(super) struct Made {
    pub(super) key: Key,
    pub(super) component: usize,
    pub(super) coloring: Coloring,
    pub(super) theme: Theme,
    /// Number of photographs shown in their frusta.
    pub(super) photographs: usize,
    pub(super) layers: Layers,
    /// Whether cameras are shown.
    pub(super) cameras: bool,
    /// Meters per unit, if the grid is shown.
    pub(super) grid: Option<f64>,
    /// Photograph through whose camera the view looks.
    pub(super) through: Option<PhotoId>,
    pub(super) crop: Option<CropBox>,
    pub(super) deleted: PointSet,
    pub(super) selected: PointSet,
    /// Number of cameras so far, during a reconstruction.
    pub(super) growing: Option<usize>,
    pub(super) dense: Vec<Key>,
    pub(super) floor: Option<Floor>,
}
