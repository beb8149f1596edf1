//! Clipping of lines and polygons to a rectangle.

use super::place::Place;
use crate::Rect;

/// Returns the part of a segment inside a rectangle.
///
/// Source: Liang & Barsky 1984, "A new concept and method for line clipping".
pub(super) fn clip_segment(from: Place, to: Place, clip: Rect) -> Option<(Place, Place)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if !(dx.is_finite() && dy.is_finite() && from.0.is_finite() && from.1.is_finite()) {
        return None;
    }
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (p, q) in [
        (-dx, from.0 - clip.x),
        (dx, clip.right() - from.0),
        (-dy, from.1 - clip.y),
        (dy, clip.bottom() - from.1),
    ] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            enter = enter.max(q / p);
        } else {
            leave = leave.min(q / p);
        }
    }
    let at = |s: f64| (from.0 + s * dx, from.1 + s * dy);
    let start = if enter > 0.0 { at(enter) } else { from };
    let end = if leave < 1.0 { at(leave) } else { to };
    (enter <= leave).then_some((start, end))
}

/// Returns the part of a polygon inside a rectangle.
///
/// Source: Sutherland & Hodgman 1974, "Reentrant polygon clipping".
pub(super) fn clip_polygon(places: &[Place], clip: Rect) -> Vec<Place> {
    if places.iter().any(|p| !p.0.is_finite() || !p.1.is_finite()) {
        return Vec::new();
    }
    let sides: [fn(Place, Rect) -> f64; 4] = [
        |p, r| p.0 - r.x,
        |p, r| r.right() - p.0,
        |p, r| p.1 - r.y,
        |p, r| r.bottom() - p.1,
    ];
    let mut inside = places.to_vec();
    for depth in sides {
        let before = std::mem::take(&mut inside);
        for (index, &to) in before.iter().enumerate() {
            let from = before[(index + before.len() - 1) % before.len()];
            let (d0, d1) = (depth(from, clip), depth(to, clip));
            if (d0 >= 0.0) != (d1 >= 0.0) {
                let s = d0 / (d0 - d1);
                inside.push((from.0 + s * (to.0 - from.0), from.1 + s * (to.1 - from.1)));
            }
            if d1 >= 0.0 {
                inside.push(to);
            }
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLIP: Rect = Rect {
        x: 0.0,
        y: 0.0,
        width: 10.0,
        height: 10.0,
    };

    #[test]
    fn segments_are_cut_at_the_clip_rectangle() {
        let cut = clip_segment((-10.0, 5.0), (20.0, 5.0), CLIP);
        assert_eq!(cut, Some(((0.0, 5.0), (10.0, 5.0))));
        assert_eq!(clip_segment((-1.0, -1.0), (-5.0, 20.0), CLIP), None);
        assert_eq!(clip_segment((f64::NAN, 0.0), (1.0, 1.0), CLIP), None);
        assert_eq!(clip_segment((f64::INFINITY, 0.0), (1.0, 1.0), CLIP), None);
    }

    #[test]
    fn polygons_are_cut_at_the_clip_rectangle() {
        let cut = clip_polygon(
            &[(-5.0, -5.0), (15.0, -5.0), (15.0, 15.0), (-5.0, 15.0)],
            CLIP,
        );
        let area = cut
            .iter()
            .zip(cut.iter().cycle().skip(1))
            .map(|(a, b)| a.0 * b.1 - b.0 * a.1)
            .sum::<f64>()
            / 2.0;
        assert_eq!(area, 100.0);
    }
}
