//! Symbols of a chapter's formulas, linked to their marks in the picture.

use super::{Layout, Rect};
use serde::Serialize;

/// A mark in the picture for a symbol of the chapter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Symbol {
    /// The symbol as written in formulas: `P`, `p`, `p'`, `ℓ'`, `e'`.
    pub name: &'static str,
    /// Name of its panel.
    pub panel: &'static str,
    /// Position, in the world units of the panel.
    pub mark: Mark,
}

/// Geometry of a symbol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// A point.
    Point(f64, f64),
    /// A line: a point on it and its direction.
    Line((f64, f64), (f64, f64)),
}

/// A symbol with its position on the page, CSS pixels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct PlacedSymbol {
    name: &'static str,
    /// A point, or one end of a line.
    from: (f64, f64),
    /// The other end.
    to: Option<(f64, f64)>,
}

impl Symbol {
    /// Creates the symbol of a point.
    pub fn point(name: &'static str, panel: &'static str, x: f64, y: f64) -> Self {
        Self {
            name,
            panel,
            mark: Mark::Point(x, y),
        }
    }

    /// Returns its position on the page; `None` if it is outside of its panel.
    pub fn placed(&self, layout: &Layout) -> Option<PlacedSymbol> {
        let panel = layout.panel(self.panel);
        let (name, rect) = (self.name, panel.rect);
        match self.mark {
            Mark::Point(x, y) => {
                let from = panel.canvas_from_world((x, y));
                rect.contains(from).then_some(PlacedSymbol {
                    name,
                    from,
                    to: None,
                })
            }
            Mark::Line((x, y), (dx, dy)) => {
                let start = panel.canvas_from_world((x, y));
                let next = panel.canvas_from_world((x + dx, y + dy));
                let (from, to) = across(rect, start, (next.0 - start.0, next.1 - start.1))?;
                Some(PlacedSymbol {
                    name,
                    from,
                    to: Some(to),
                })
            }
        }
    }
}

/// Clips an infinite line to a rectangle.
fn across(
    rect: Rect,
    (x, y): (f64, f64),
    (dx, dy): (f64, f64),
) -> Option<((f64, f64), (f64, f64))> {
    if ![x, y, dx, dy].iter().all(|value| value.is_finite()) {
        return None;
    }
    let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
    for (at, step, low, high) in [
        (x, dx, rect.x, rect.right()),
        (y, dy, rect.y, rect.bottom()),
    ] {
        if step.abs() < 1e-9 {
            if !(low..=high).contains(&at) {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - at) / step, (high - at) / step);
        first = first.max(a.min(b));
        last = last.min(a.max(b));
    }
    let at = |t: f64| (x + t * dx, y + t * dy);
    (first.is_finite() && last.is_finite() && first < last).then(|| (at(first), at(last)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Panel;

    fn layout() -> Layout {
        let rect = Rect::new(10.0, 20.0, 100.0, 50.0);
        Layout {
            width: 120.0,
            height: 80.0,
            panels: vec![Panel::photograph("first", rect, (100, 50))],
        }
    }

    #[test]
    fn a_point_is_shown_inside_its_panel_only() {
        let at = |x| Symbol::point("p", "first", x, 9.5).placed(&layout());
        assert_eq!(at(49.5).unwrap().from, (60.0, 30.0));
        assert_eq!(at(150.0), None);
        assert_eq!(at(f64::NAN), None);
    }

    #[test]
    fn a_line_ends_at_the_borders() {
        let line = |start, direction| {
            let mark = Mark::Line(start, direction);
            let symbol = Symbol {
                name: "ℓ'",
                panel: "first",
                mark,
            };
            symbol.placed(&layout())
        };
        let level = line((900.0, 9.5), (1.0, 0.0)).unwrap();
        let ends = [level.from.0, level.to.unwrap().0];
        assert!((ends[0] - 10.0).abs() < 1e-6 && (ends[1] - 110.0).abs() < 1e-6);
        assert!((level.from.1 - 30.0).abs() < 1e-9);
        assert_eq!(line((0.0, 90.0), (1.0, 0.0)), None);
        assert_eq!(line((0.0, 0.0), (0.0, 0.0)), None);
        assert_eq!(line((f64::NAN, 0.0), (1.0, 1.0)), None);
    }
}
