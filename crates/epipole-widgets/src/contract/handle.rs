//! Handles: draggable points in the picture.

use super::control::round_to_digits;
use super::event::Event;
use serde::Serialize;

/// A draggable point, in the world units of its panel.
///
/// A page makes each handle focusable; a drag and the arrow keys give the same event.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Handle {
    /// Permanent name; also its URL parameter, with the value `x,y`.
    pub id: String,
    /// Name of its panel.
    pub panel: &'static str,
    /// Label for screen readers.
    pub label: String,
    /// Position in words, such as "2.80 m away, 0.40 m to the right".
    pub value_text: String,
    /// x in world units.
    pub x: f64,
    /// y in world units.
    pub y: f64,
    /// Smallest and largest x.
    pub x_range: [f64; 2],
    /// Smallest and largest y.
    pub y_range: [f64; 2],
    /// Step of an arrow key along x and y, world units.
    pub step: [f64; 2],
    /// Digits after the decimal point of its position.
    pub digits: usize,
    /// Whether the reader may remove it.
    pub removable: bool,
}

impl Handle {
    /// Creates a handle that moves within ranges of x and y, in steps of one unit by default.
    pub fn new(
        id: impl Into<String>,
        panel: &'static str,
        label: impl Into<String>,
        (x, y): (f64, f64),
        [x_range, y_range]: [[f64; 2]; 2],
    ) -> Self {
        Self {
            id: id.into(),
            panel,
            label: label.into(),
            value_text: String::new(),
            x,
            y,
            x_range,
            y_range,
            step: [1.0; 2],
            digits: 0,
            removable: false,
        }
    }

    /// Sets the position as text.
    #[must_use]
    pub fn told(self, value_text: String) -> Self {
        Self { value_text, ..self }
    }

    /// Sets the step of the arrow keys and the number of digits of the position.
    #[must_use]
    pub fn step(self, step: [f64; 2], digits: usize) -> Self {
        Self {
            step,
            digits,
            ..self
        }
    }

    /// Makes the handle removable if `removable`.
    #[must_use]
    pub fn removable_if(self, removable: bool) -> Self {
        Self { removable, ..self }
    }

    /// Returns the new position after a drag, an arrow key or a click in its panel; `None` if the
    /// event does not move the handle.
    pub fn moved_by(&self, event: &Event) -> Option<(f64, f64)> {
        match event {
            Event::HandleMoved { id, x, y } if *id == self.id => self.admit(*x, *y),
            Event::Clicked { panel, x, y } if panel == self.panel => self.admit(*x, *y),
            _ => None,
        }
    }

    /// Clamps a position to the ranges and rounds it to the digits; `None` for NaN and infinities.
    pub fn admit(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let admit = |value: f64, [low, high]: [f64; 2]| {
            value
                .is_finite()
                .then(|| round_to_digits(value.clamp(low, high), self.digits))
        };
        Some((admit(x, self.x_range)?, admit(y, self.y_range)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drags_and_clicks_in_its_panel_move_it_within_its_ranges() {
        let ranges = [[0.0, 10.0], [-1.0, 1.0]];
        let handle = Handle::new("here", "plane", "Here", (2.0, 0.0), ranges).step([0.5; 2], 1);
        let moved = |event: Event| handle.moved_by(&event);
        assert_eq!(moved(Event::moved("here", 3.26, 4.0)), Some((3.3, 1.0)));
        assert_eq!(moved(Event::clicked("plane", -3.0, 0.5)), Some((0.0, 0.5)));
        assert_eq!(moved(Event::moved("there", 3.0, 0.0)), None);
        assert_eq!(moved(Event::clicked("plot", 3.0, 0.0)), None);
        assert_eq!(moved(Event::clicked("plane", f64::NAN, 0.0)), None);
    }
}
