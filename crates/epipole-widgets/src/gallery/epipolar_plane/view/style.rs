//! Color and lines of what is lit up.

use crate::canvas::Stroke;
use crate::theme::Role;

/// Color of epipolar lines.
pub(super) const LINE: Role = Role::Series(2);

/// Color of what is lit up.
pub(super) const LIT: Role = Role::Series(3);

/// Returns the stroke of a line, highlighted or not.
pub(super) fn stroke(is_lit: bool) -> Stroke {
    if is_lit {
        Stroke::solid(LIT, 3.0)
    } else {
        Stroke::solid(Role::Ink, 1.5)
    }
}
