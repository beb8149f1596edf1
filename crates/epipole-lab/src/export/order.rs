//! Contents of an export.

use crate::tasks::{Dense, ImagePoints, Packed, Photograph, Recipe, Reconstructed, Source};

/// Contents of an export.
pub(crate) struct Order<'a> {
    pub(crate) images: &'a [ImagePoints],
    pub(crate) photographs: &'a [Packed],
    pub(crate) found: &'a Reconstructed,
    pub(crate) component: usize,
    pub(crate) meters_per_unit: Option<f64>,
    pub(crate) focal_refined: bool,
    pub(crate) left_out: &'a [(String, String)],
    pub(crate) recipe: &'a Recipe,
    /// Reads the pixels of a photograph that came without.
    pub(crate) read: &'a dyn Fn(&Source) -> Result<Photograph, String>,
    pub(crate) dense: &'a [(String, Dense)],
}
