//! Spaces: three-dimensional panels.

use serde::Serialize;

/// A panel whose contents the reader turns, moves and zooms.
///
/// Its state is two handles and a slider, so that keys, permalinks and tests cover it. Pointers
/// have shortcuts: a drag anywhere in the panel moves the handle `orbit`, a drag with Shift moves
/// `pan`; two fingers move `pan` and, spread, the slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Space {
    /// Name of the panel.
    pub panel: &'static str,
    /// Handle that turns the scene.
    pub orbit: &'static str,
    /// Handle that moves the scene across the panel.
    pub pan: &'static str,
    /// Slider that zooms.
    pub zoom: &'static str,
}
