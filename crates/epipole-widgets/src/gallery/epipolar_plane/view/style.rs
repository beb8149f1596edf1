//! Colors and lines of highlighted elements.

use crate::canvas::Stroke;
use crate::gallery::epipolar_plane::model::Lit;
use crate::gallery::epipolar_plane::scenery::Scenery;
use crate::theme::Role;
use epipole::math::Line2;

/// Color of epipolar lines.
pub(super) const LINE: Role = Role::Series(2);

/// Color of highlighted elements.
pub(super) const LIT: Role = Role::Series(3);

/// Returns the stroke of a line, highlighted or not.
pub(super) fn stroke(is_lit: bool) -> Stroke {
    if is_lit {
        Stroke::solid(LIT, 3.0)
    } else {
        Stroke::solid(Role::Ink, 1.5)
    }
}

/// Returns the epipolar lines; none if only the images of P are explained.
pub(super) fn lines(scenery: &Scenery, lit: Lit) -> [Option<Line2>; 2] {
    match lit {
        Lit::Point => [None, None],
        _ => scenery.lines(),
    }
}
