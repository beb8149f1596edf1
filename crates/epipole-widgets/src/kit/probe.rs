//! A handle that the reader moves over a photograph, a top view or any other panel.
//!
//! A figure declares it like a slider:
//!
//! ```text
//! const PROBE: Probe = Probe::new("probe", "first", "Probe in photograph 1")
//!     .over(SIZE)
//!     .step(4.0)
//!     .at(217.0, 324.0);
//! ```

use crate::contract::{Event, Handle, format_number};
use nalgebra::Point2;

/// A handle and its position. A click in its panel also moves it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Probe {
    id: &'static str,
    panel: &'static str,
    label: &'static str,
    place: (f64, f64),
    ranges: [[f64; 2]; 2],
    step: f64,
    digits: usize,
    words: fn((f64, f64)) -> String,
}

/// Step of the arrow keys in a top view, meters, and decimals of the position.
const ON_PLAN: (f64, usize) = (0.05, 2);

impl Probe {
    /// Creates a probe without a range.
    pub(crate) const fn new(id: &'static str, panel: &'static str, label: &'static str) -> Self {
        Self {
            id,
            panel,
            label,
            place: (0.0, 0.0),
            ranges: [[0.0; 2]; 2],
            step: 1.0,
            digits: 0,
            words: |place| place_words(place, 0),
        }
    }

    /// Sets the range to a photograph of this size; positions are pixels.
    pub(crate) const fn over(self, size: (u32, u32)) -> Self {
        let ranges = ranges(size);
        Self { ranges, ..self }
    }

    /// Sets the ranges in a [`plan`](crate::kit::plan): meters to the right and away.
    pub(crate) const fn on_plan(self, ranges: [[f64; 2]; 2]) -> Self {
        let (step, digits) = ON_PLAN;
        Self {
            ranges,
            step,
            digits,
            words: meters,
            ..self
        }
    }

    /// Sets the ranges in the panel's world.
    pub(crate) const fn within(self, ranges: [[f64; 2]; 2]) -> Self {
        Self { ranges, ..self }
    }

    /// Sets the step of the arrow keys, world units.
    pub(crate) const fn step(self, step: f64) -> Self {
        Self { step, ..self }
    }

    /// Sets the digits of the position.
    pub(crate) const fn digits(self, digits: usize) -> Self {
        Self { digits, ..self }
    }

    /// Sets the function that formats the position as text.
    pub(crate) const fn told(self, words: fn((f64, f64)) -> String) -> Self {
        Self { words, ..self }
    }

    /// Sets the position.
    pub(crate) const fn at(self, x: f64, y: f64) -> Self {
        let place = (x, y);
        Self { place, ..self }
    }

    /// Sets the position to the middle of a photograph of this size.
    pub(crate) fn in_middle(self, (width, height): (u32, u32)) -> Self {
        self.over((width, height))
            .at(f64::from(width / 2), f64::from(height / 2))
    }

    pub(crate) const fn id(&self) -> &'static str {
        self.id
    }

    /// Returns the position, clamped to its ranges.
    pub(crate) fn place(&self) -> (f64, f64) {
        let ((x, y), [across, down]) = (self.place, self.ranges);
        let keep = |value: f64, [low, high]: [f64; 2]| value.clamp(low, high);
        (keep(x, across), keep(y, down))
    }

    /// Moves it to a position, clamped and rounded; ignores NaN.
    pub(crate) fn put(&mut self, x: f64, y: f64) {
        self.place = self.handle().admit(x, y).unwrap_or(self.place);
    }

    /// Returns the position as a point.
    pub(crate) fn point(&self) -> Point2<f64> {
        let (x, y) = self.place();
        Point2::new(x, y)
    }

    /// Returns the pixel under it.
    pub(crate) fn pixel(&self) -> (u32, u32) {
        let (u, v) = self.place();
        (u as u32, v as u32)
    }

    /// Formats its position as text.
    pub(crate) fn text(&self) -> String {
        (self.words)(self.place())
    }

    pub(crate) fn handle(&self) -> Handle {
        Handle::new(self.id, self.panel, self.label, self.place(), self.ranges)
            .told(self.text())
            .step([self.step; 2], self.digits)
    }

    /// Applies an event; returns whether the event moves it.
    pub(crate) fn update(&mut self, event: &Event) -> bool {
        let moved = self.handle().moved_by(event);
        self.place = moved.unwrap_or(self.place);
        moved.is_some()
    }
}

/// Returns the column and row ranges of a photograph of this size, for a handle over it.
pub(crate) const fn ranges((width, height): (u32, u32)) -> [[f64; 2]; 2] {
    const fn range(size: u32) -> [f64; 2] {
        [0.0, size.saturating_sub(1) as f64]
    }
    [range(width), range(height)]
}

/// Formats a position in a photograph, such as "column 12, row 30".
pub(crate) fn place_words((u, v): (f64, f64), digits: usize) -> String {
    let [column, row] = [u, v].map(|value| format_number(value, digits));
    format!("column {column}, row {row}")
}

/// Formats a position in a top view, such as "2.00 m away, 0.30 m to the right".
fn meters((x, z): (f64, f64)) -> String {
    let side = if x < 0.0 { "left" } else { "right" };
    let [away, aside] = [z, x.abs()].map(|value| format_number(value, 2));
    format!("{away} m away, {aside} m to the {side}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_is_dragged_clicked_and_kept_inside() {
        let mut probe = Probe::new("probe", "left", "Probe").over((30, 20));
        assert!(probe.update(&Event::moved("probe", 5.0, 6.0)));
        assert_eq!(probe.handle().value_text, "column 5, row 6");
        assert!(probe.update(&Event::clicked("left", 29.4, -0.5)));
        assert_eq!(probe.pixel(), (29, 0));
        assert!(!probe.update(&Event::clicked("right", 1.0, 1.0)));
        assert!(!probe.update(&Event::moved("other", 1.0, 1.0)));
        // A smaller photograph clamps the position; the larger one restores it.
        assert_eq!(probe.over((10, 10)).place(), (9.0, 0.0));
        assert_eq!(probe.over((10, 10)).over((30, 20)).place(), (29.0, 0.0));
        assert_eq!(probe.in_middle((31, 20)).place(), (15.0, 10.0));
        probe.put(3.3, 77.0);
        probe.put(f64::NAN, 0.0);
        assert_eq!(probe.place(), (3.0, 19.0));
    }

    #[test]
    fn on_a_plan_it_says_where_it_is() {
        let ranges = [[-1.0, 1.0], [0.5, 3.0]];
        let mut probe = Probe::new("point", "top", "P").on_plan(ranges).at(0.3, 2.0);
        assert_eq!(probe.text(), "2.00 m away, 0.30 m to the right");
        assert!(probe.update(&Event::moved("point", -0.502, 7.0)));
        assert_eq!(probe.point(), Point2::new(-0.5, 3.0));
        assert!(probe.handle().value_text.ends_with("0.50 m to the left"));
    }
}
