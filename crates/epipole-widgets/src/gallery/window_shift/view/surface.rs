//! The squared change under every shift, as a net in three dimensions.

use super::super::measure::{Found, REACH};
use crate::canvas::{Canvas, Place, Stroke, TextStyle};
use crate::contract::Rect;
use crate::kit::grid::SMALL;
use crate::theme::{Role, mix};

/// Squared change at the top of the surface, gray levels squared.
const TOP: f64 = 11_000.0;

/// The squared change as a net over the shifts, seen from above and in front.
pub(super) fn draw(canvas: &mut Canvas, rect: Rect, (shift_u, shift_v): (f64, f64), found: &Found) {
    let reach = REACH as i32;
    let (half_width, half_depth) = (rect.width * 0.47, rect.height * 0.2);
    let ground = rect.bottom() - half_depth - 10.0;
    let height = ground - half_depth - rect.y - 4.0;
    let project = |du: f64, dv: f64, change: f64| -> Place {
        let (x, y) = (du / f64::from(reach), dv / f64::from(reach));
        (
            rect.center().0 + 0.5 * (x - y) * half_width,
            ground + 0.5 * (x + y) * half_depth - (change / TOP).min(1.05) * height,
        )
    };
    let corner = |du: i32, dv: i32| project(f64::from(du), f64::from(dv), found.change(du, dv));
    let [surface, change] = [Role::Surface, Role::Candidate].map(|role| canvas.theme().color(role));
    // Far cells first, so that near ones cover them.
    for diagonal in -2 * reach..2 * reach {
        for du in (-reach).max(diagonal - reach + 1)..reach.min(diagonal + reach + 1) {
            let dv = diagonal - du;
            let cell = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let places = cell.map(|(x, y)| corner(du + x, dv + y));
            let changes = cell.map(|(x, y)| found.change(du + x, dv + y));
            let mean = changes.iter().sum::<f64>() / 4.0;
            let share = (mean.sqrt() / 150.0).min(1.0);
            canvas.polygon_color(&places, mix(surface, change, 0.1 + 0.6 * share as f32));
            // The sides towards the viewer are drawn with the cells that lie there.
            let [back, right, front, left] = places;
            let mut sides = vec![left, back, right];
            if du == reach - 1 {
                sides.push(front);
            }
            if dv == reach - 1 {
                sides.insert(0, front);
            }
            canvas.polyline(&sides, Stroke::solid(Role::Ink, 0.5));
        }
    }
    let style = TextStyle::new(Role::Ink, SMALL);
    let edge = f64::from(reach);
    let (right, down) = (project(edge, 0.0, 0.0), project(0.0, edge, 0.0));
    canvas.label((right.0 + 6.0, rect.bottom() - 10.0), "right", style);
    canvas.label((down.0 - 6.0, rect.bottom() - 10.0), "down", style.end());
    let change = found.change(shift_u as i32, shift_v as i32);
    let place = project(shift_u, shift_v, change);
    canvas.line(
        project(shift_u, shift_v, 0.0),
        place,
        Stroke::solid(Role::Grip, 2.0).cased(),
    );
    canvas.disk(place, 4.5, Role::Halo, 1.0);
    canvas.disk(place, 3.5, Role::Grip, 1.0);
}
