//! A thing that the reader moves over a view from above.

use crate::contract::{Event, Handle, format_number};

/// How far an arrow key moves a pin, meters.
const STEP_M: f64 = 0.05;

/// A place on a plan: meters to the right, meters away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pin {
    id: &'static str,
    panel: &'static str,
    label: &'static str,
    place: (f64, f64),
    ranges: [[f64; 2]; 2],
}

impl Pin {
    /// A pin in a panel of [`plan`](crate::kit::plan), to be moved within these ranges.
    pub(crate) fn new(
        id: &'static str,
        panel: &'static str,
        label: &'static str,
        place: (f64, f64),
        ranges: [[f64; 2]; 2],
    ) -> Self {
        Self {
            id,
            panel,
            label,
            place,
            ranges,
        }
    }

    /// Where it is: meters to the right, meters away.
    pub(crate) fn place(&self) -> (f64, f64) {
        self.place
    }

    /// Its handle.
    pub(crate) fn handle(&self) -> Handle {
        let (x, z) = self.place;
        let side = if x < 0.0 { "left" } else { "right" };
        let told = format!(
            "{} m away, {} m to the {side}",
            format_number(z, 2),
            format_number(x.abs(), 2)
        );
        Handle::new(self.id, self.panel, self.label, self.place, self.ranges)
            .told(told)
            .step([STEP_M; 2], 2)
    }

    /// Takes an event that moves it; whether it was one.
    pub(crate) fn update(&mut self, event: &Event) -> bool {
        match event {
            Event::HandleMoved { id, x, y } if id == self.id => self.place = (*x, *y),
            _ => return false,
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_says_where_it_is() {
        let mut pin = Pin::new("point", "top", "P", (0.3, 2.0), [[-1.0, 1.0], [0.5, 3.0]]);
        assert_eq!(pin.handle().value_text, "2.00 m away, 0.30 m to the right");
        assert!(pin.update(&Event::moved("point", -0.5, 1.0)));
        assert!(!pin.update(&Event::moved("other", 0.0, 1.0)));
        assert_eq!(pin.place(), (-0.5, 1.0));
        assert!(pin.handle().value_text.ends_with("0.50 m to the left"));
    }
}
