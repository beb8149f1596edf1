//! A place that the reader drags over a photograph, or clicks.

use crate::contract::{Event, Handle, format_number};

/// A place in a photograph, whole pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Probe {
    id: &'static str,
    panel: &'static str,
    label: &'static str,
    place: (f64, f64),
}

impl Probe {
    /// A handle of its own in a panel that shows a photograph.
    pub(crate) fn new(id: &'static str, panel: &'static str, label: &'static str) -> Self {
        Self {
            id,
            panel,
            label,
            place: (0.0, 0.0),
        }
    }

    /// The same probe elsewhere, pixels.
    pub(crate) fn at(self, u: f64, v: f64) -> Self {
        let place = (u, v);
        Self { place, ..self }
    }

    /// Where it is, pixels. A photograph of another size may have moved it.
    pub(crate) fn place(&self, size: (u32, u32)) -> (f64, f64) {
        within(self.place, size)
    }

    /// The pixel under it.
    pub(crate) fn pixel(&self, size: (u32, u32)) -> (u32, u32) {
        let (u, v) = self.place(size);
        (u as u32, v as u32)
    }

    /// Its handle over a photograph of this size; an arrow key moves it by `step_px`.
    pub(crate) fn handle(&self, size: (u32, u32), step_px: f64) -> Handle {
        let place = self.place(size);
        Handle::new(self.id, self.panel, self.label, place, ranges(size))
            .told(place_words(place, 0))
            .step([step_px; 2], 0)
    }

    /// Takes an event that moves it; whether it was one.
    pub(crate) fn update(&mut self, event: &Event, size: (u32, u32)) -> bool {
        let moved = self.handle(size, 1.0).moved_by(event);
        self.place = moved.unwrap_or(self.place);
        moved.is_some()
    }
}

/// The columns and the rows of a photograph of this size, for a handle over it.
pub(crate) fn ranges((width, height): (u32, u32)) -> [[f64; 2]; 2] {
    [width, height].map(|size| [0.0, f64::from(size.max(1) - 1)])
}

/// A place in a photograph, such as "column 12, row 30".
pub(crate) fn place_words((u, v): (f64, f64), digits: usize) -> String {
    let [column, row] = [u, v].map(|value| format_number(value, digits));
    format!("column {column}, row {row}")
}

fn within((u, v): (f64, f64), size: (u32, u32)) -> (f64, f64) {
    let [columns, rows] = ranges(size);
    (u.clamp(columns[0], columns[1]), v.clamp(rows[0], rows[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_is_dragged_clicked_and_kept_inside() {
        let size = (30, 20);
        let mut probe = Probe::new("probe", "left", "Probe").at(12.0, 3.0);
        assert!(probe.update(&Event::moved("probe", 5.0, 6.0), size));
        assert_eq!(probe.handle(size, 2.0).value_text, "column 5, row 6");
        assert!(probe.update(&Event::clicked("left", 29.4, -0.5), size));
        assert_eq!(probe.pixel(size), (29, 0));
        assert!(!probe.update(&Event::clicked("right", 1.0, 1.0), size));
        assert!(!probe.update(&Event::moved("other", 1.0, 1.0), size));
        assert_eq!(probe.place((10, 10)), (9.0, 0.0));
    }
}
