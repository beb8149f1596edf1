//! Markers of the methods, the color of the uncertainty region, and scale bars.

use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Rect, format_number};
use crate::kit::grid::SMALL;
use crate::theme::Role;

/// Color of the uncertainty region.
pub(super) const REGION: Role = Role::Series(3);
/// Marker of each method.
pub(super) const SHAPES: [Shape; 4] = [Shape::Cross, Shape::Plus, Shape::Triangle, Shape::Diamond];
/// Role of all estimates, which are distinguished by shape.
pub(super) const METHOD_ROLE: Role = Role::Ink;

/// Draws a scale bar of a round length, at most a quarter of the width, in the upper or lower left
/// corner.
///
/// * `per_unit`: CSS pixels per unit, and the unit's name
pub(super) fn draw_bar(
    canvas: &mut Canvas,
    rect: Rect,
    (per_unit, unit): (f64, &str),
    is_above: bool,
) {
    let wanted = 0.25 * rect.width / per_unit;
    if !(wanted.is_finite() && wanted > 0.0) {
        return;
    }
    let power = libm::exp10(libm::floor(libm::log10(wanted)));
    let round = [5.0, 2.0, 1.0].into_iter().find(|n| n * power <= wanted);
    let length = round.unwrap_or(1.0) * power;
    let digits = if length < 1.0 { 1 } else { 0 };
    let y = if is_above {
        rect.y + 23.0
    } else {
        rect.bottom() - 8.0
    };
    let place = (rect.x + 8.0, y);
    let end = (place.0 + length * per_unit, place.1);
    canvas.line(place, end, Stroke::solid(Role::Ink, 2.0));
    let style = TextStyle::new(Role::Ink, SMALL).cased();
    let style = TextStyle {
        align: Align::Start,
        ..style
    };
    let text = format!("{} {unit}", format_number(length, digits));
    canvas.label((place.0, place.1 - 11.0), &text, style);
}
