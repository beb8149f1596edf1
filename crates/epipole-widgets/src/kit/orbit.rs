//! Viewpoint of a three-dimensional panel: state, handles and description.
//!
//! A model holds an [`Orbit`] and appends its controls and handles to its own. The world of a panel
//! of [`SPACE`] is in degrees: horizontally the rotation of the scene about its vertical axis,
//! vertically the elevation of the reader above it. A drag to the right therefore rotates the front
//! of the scene to the right, and a drag downwards tilts it down.

use crate::contract::{
    Button, ButtonRole, Control, Event, Handle, Knob, Panel, Problem, Rect, Settings, Slider,
    Space, format_number,
};

/// The panel with its handles and its slider.
pub(crate) const SPACE: Space = Space {
    panel: "space",
    orbit: "orbit",
    pan: "pan",
    zoom: "zoom",
};

/// Zoom of the viewpoint.
const ZOOM: Slider = Slider::new(SPACE.zoom, "Zoom")
    .range(0.5, 6.0, 0.1)
    .at(1.0)
    .digits(1)
    .unit("×")
    .more();

/// Button that returns to the initial viewpoint.
const RECENTER: Button = Button::new("recenter", "Reset viewpoint", ButtonRole::Action).more();

/// Half of the panel's width, degrees.
pub(crate) const HALF_TURN_DEG: f64 = 180.0;
/// Half of the panel's height, degrees.
pub(crate) const HALF_RISE_DEG: f64 = 90.0;
/// Maximum elevation, degrees; beyond it the scene's vertical axis would point at the reader.
const HIGHEST_DEG: f64 = 85.0;

/// A viewing direction, a zoom, and the position of the scene's center in the panel.
#[derive(Debug, Clone)]
pub(crate) struct Orbit {
    home: (f64, f64),
    turned: (f64, f64),
    panned: (f64, f64),
    settings: Settings,
}

impl Orbit {
    /// Creates a viewpoint with the scene rotated by `turn_deg`, seen from an elevation of
    /// `rise_deg`.
    pub(crate) fn new(turn_deg: f64, rise_deg: f64) -> Self {
        let home = (turn_deg, rise_deg);
        Self {
            home,
            turned: home,
            panned: (0.0, 0.0),
            settings: Settings::new(&[Knob::Slider(&ZOOM)]),
        }
    }

    /// Sets the zoom.
    #[cfg(test)]
    pub(crate) fn zoomed(mut self, zoom: f64) -> Self {
        self.update(&Event::set(&ZOOM, zoom)).unwrap();
        self
    }

    /// Returns the rotation of the scene, degrees; positive moves its front to the right.
    pub(crate) fn turn_deg(&self) -> f64 {
        self.turned.0
    }

    /// Returns the elevation of the reader above the scene, degrees.
    pub(crate) fn rise_deg(&self) -> f64 {
        self.turned.1
    }

    /// Returns the scale relative to the initial one.
    pub(crate) fn zoom(&self) -> f64 {
        self.settings.number(&ZOOM)
    }

    /// Returns the position of the scene's center, in the panel's world.
    pub(crate) fn middle(&self) -> (f64, f64) {
        self.panned
    }

    /// Creates the panel of the 3D view.
    pub(crate) fn panel(rect: Rect) -> Panel {
        let axis = |half: f64| [-half, half];
        Panel::new(SPACE.panel, rect, axis(HALF_TURN_DEG), axis(HALF_RISE_DEG))
    }

    /// Returns the zoom slider and the button that resets the viewpoint.
    pub(crate) fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        controls.push(RECENTER.control(true, false));
        controls
    }

    /// Returns the two handles: one rotates the scene, one pans it.
    pub(crate) fn handles(&self) -> [Handle; 2] {
        let handle = |id, label, told, place, half_y: f64| {
            let ranges = [HALF_TURN_DEG, half_y].map(|half| [-half, half]);
            let handle = Handle::new(id, SPACE.panel, label, place, ranges);
            handle.told(told).step([5.0; 2], 0)
        };
        let share = |value: f64, half: f64| format_number(50.0 * (1.0 + value / half), 0);
        let (across, down) = self.panned;
        let [across, down] = [share(across, HALF_TURN_DEG), share(down, HALF_RISE_DEG)];
        let place = format!("{across}% across, {down}% down");
        let (view, center) = ("Viewpoint", "Scene center");
        [
            handle(SPACE.orbit, view, self.words(), self.turned, HIGHEST_DEG),
            handle(SPACE.pan, center, place, self.panned, HALF_RISE_DEG),
        ]
    }

    /// Describes the viewing direction, such as "35° to the left, 20° above".
    pub(crate) fn words(&self) -> String {
        let (turn, rise) = self.turned;
        let words = |value: f64, positive: &str, negative: &str, zero: &str| match value {
            0.0 => zero.to_owned(),
            _ => {
                let side = if value > 0.0 { positive } else { negative };
                format!("{}° {side}", format_number(value.abs(), 0))
            }
        };
        format!(
            "{}, {}",
            words(turn, "to the left", "to the right", "straight ahead"),
            words(rise, "above", "below", "level")
        )
    }

    /// Describes the viewing direction and zoom, such as "35° to the left, 20° above, 1.0 ×".
    pub(crate) fn seen_from(&self) -> String {
        format!("{}, {} ×", self.words(), format_number(self.zoom(), 1))
    }

    /// Applies an event of the 3D view; returns false for other events.
    ///
    /// # Errors
    /// For an invalid value of the zoom.
    pub(crate) fn update(&mut self, event: &Event) -> Result<bool, Problem> {
        match event {
            Event::HandleMoved { id, x, y } if id == SPACE.orbit => self.turned = (*x, *y),
            Event::HandleMoved { id, x, y } if id == SPACE.pan => self.panned = (*x, *y),
            Event::Set { id, value } if id == ZOOM.id => {
                self.settings.set(id, value)?;
            }
            Event::Press { id } if id == RECENTER.id => {
                *self = Self::new(self.home.0, self.home.1);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_turn_move_enlarge_and_return() {
        let mut orbit = Orbit::new(-35.0, 20.0);
        let fresh = orbit.seen_from();
        assert_eq!(orbit.update(&Event::moved("orbit", 90.0, 0.0)), Ok(true));
        assert_eq!(orbit.words(), "90° to the left, level");
        assert_eq!(orbit.update(&Event::moved("pan", 18.0, -9.0)), Ok(true));
        assert_eq!(orbit.handles()[1].value_text, "55% across, 45% down");
        assert_eq!(orbit.update(&Event::moved("probe", 1.0, 1.0)), Ok(false));
        assert_eq!(orbit.update(&Event::set(&ZOOM, 3.0)), Ok(true));
        assert!(orbit.update(&Event::set(&ZOOM, 100.0)).is_err());
        assert_eq!(orbit.seen_from(), "90° to the left, level, 3.0 ×");
        assert_eq!(orbit.update(&Event::press(RECENTER.id)), Ok(true));
        assert_eq!((orbit.seen_from(), orbit.middle()), (fresh, (0.0, 0.0)));
    }
}
