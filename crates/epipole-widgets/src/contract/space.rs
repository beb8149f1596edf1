//! Spaces: panels that show things in three dimensions.

use serde::Serialize;

/// A panel whose contents the reader turns, moves and enlarges.
///
/// All of its state is in two handles and a slider, so that the keys, the permalink and the tests
/// have it already. A pointer only finds them faster: a drag from anywhere in the panel moves the
/// handle `orbit`, one with Shift moves `pan`; two fingers move `pan` and, spread, the slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Space {
    /// The panel.
    pub panel: &'static str,
    /// The handle that turns things.
    pub orbit: &'static str,
    /// The handle that moves them across the panel.
    pub pan: &'static str,
    /// The slider that enlarges them.
    pub zoom: &'static str,
}
