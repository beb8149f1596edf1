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
        let (u, v) = self.place(size);
        Handle {
            id: self.id.to_owned(),
            panel: self.panel,
            label: self.label.to_owned(),
            value_text: format!(
                "column {}, row {}",
                format_number(u, 0),
                format_number(v, 0)
            ),
            x: u,
            y: v,
            x_range: [0.0, f64::from(size.0.max(1) - 1)],
            y_range: [0.0, f64::from(size.1.max(1) - 1)],
            step: [step_px, step_px],
            digits: 0,
            removable: false,
        }
    }

    /// Takes an event that moves it; whether it was one.
    pub(crate) fn update(&mut self, event: &Event, size: (u32, u32)) -> bool {
        match event {
            Event::HandleMoved { id, x, y } if id == self.id => self.place = (*x, *y),
            Event::Clicked { panel, x, y } if panel == self.panel => {
                self.place = within((x.round(), y.round()), size);
            }
            _ => return false,
        }
        true
    }
}

fn within((u, v): (f64, f64), (width, height): (u32, u32)) -> (f64, f64) {
    let keep = |value: f64, size: u32| value.clamp(0.0, f64::from(size.max(1) - 1));
    (keep(u, width), keep(v, height))
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
