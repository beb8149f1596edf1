//! Where the reader looks at a thing in three dimensions from: state, handles and words.
//!
//! A model holds an [`Orbit`] and lists [`ZOOM`] and [`RECENTER`] among its controls. A panel of
//! [`SPACE`] has degrees as its world: across, how far the scene is turned about its vertical
//! axis; down, how far above it the reader is. So a drag to the right turns what is in front to
//! the right, and one downwards turns it down.

use crate::contract::{
    Axis, Button, ButtonRole, Event, Handle, Panel, Problem, Rect, Settings, Slider, Space, Value,
    format_number,
};

/// The panel with its handles and its slider.
pub(crate) const SPACE: Space = Space {
    panel: "space",
    orbit: "orbit",
    pan: "pan",
    zoom: "zoom",
};

/// How near the reader is.
pub(crate) const ZOOM: Slider = Slider::new(SPACE.zoom, "Zoom")
    .range(0.5, 6.0, 0.1)
    .at(1.0)
    .digits(1)
    .unit("×")
    .more();

/// Back to where the reader was at first.
pub(crate) const RECENTER: Button =
    Button::new("recenter", "Reset viewpoint", ButtonRole::Action).more();

/// Half of the panel's width, degrees.
pub(crate) const HALF_TURN_DEG: f64 = 180.0;
/// Half of its height, degrees.
pub(crate) const HALF_RISE_DEG: f64 = 90.0;
/// Beyond this the scene's vertical axis points at the reader.
const HIGHEST_DEG: f64 = 85.0;

/// A direction to look from, and where in the panel the middle of the scene is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Orbit {
    home: (f64, f64),
    turned: (f64, f64),
    panned: (f64, f64),
}

impl Orbit {
    /// The scene turned by `turn_deg`, seen from `rise_deg` above.
    pub(crate) fn new(turn_deg: f64, rise_deg: f64) -> Self {
        let home = (turn_deg, rise_deg);
        Self {
            home,
            turned: home,
            panned: (0.0, 0.0),
        }
    }

    /// How far the scene is turned, degrees; positive moves what is in front to the right.
    pub(crate) fn turn_deg(&self) -> f64 {
        self.turned.0
    }

    /// How far above the scene the reader is, degrees.
    pub(crate) fn rise_deg(&self) -> f64 {
        self.turned.1
    }

    /// Where the middle of the scene is shown, in the panel's world.
    pub(crate) fn middle(&self) -> (f64, f64) {
        self.panned
    }

    /// The panel of the space, in its place on the page.
    pub(crate) fn panel(rect: Rect) -> Panel {
        let axis = |half: f64| Axis {
            start: -half,
            end: half,
        };
        Panel {
            id: SPACE.panel,
            rect,
            x_axis: axis(HALF_TURN_DEG),
            y_axis: axis(HALF_RISE_DEG),
            clickable: false,
        }
    }

    /// The two handles: one turns the scene, one moves it across the panel.
    pub(crate) fn handles(&self) -> [Handle; 2] {
        let handle = |id: &str, label: &str, value_text, (x, y), half_y: f64, step| Handle {
            id: id.to_owned(),
            panel: SPACE.panel,
            label: label.to_owned(),
            value_text,
            x,
            y,
            x_range: [-HALF_TURN_DEG, HALF_TURN_DEG],
            y_range: [-half_y, half_y],
            step,
            digits: 0,
            removable: false,
        };
        let share = |value: f64, half: f64| format_number(50.0 * (1.0 + value / half), 0);
        let (x, y) = self.panned;
        let place = format!(
            "{} % across, {} % down",
            share(x, HALF_TURN_DEG),
            share(y, HALF_RISE_DEG)
        );
        [
            handle(
                SPACE.orbit,
                "Viewpoint",
                self.words(),
                self.turned,
                HIGHEST_DEG,
                [5.0, 5.0],
            ),
            handle(
                SPACE.pan,
                "Scene center",
                place,
                self.panned,
                HALF_RISE_DEG,
                [5.0, 5.0],
            ),
        ]
    }

    /// Where the reader looks from, such as "35° to the left, 20° above".
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

    /// Takes an event of the space; whether it was one. `settings` hold [`ZOOM`].
    ///
    /// # Errors
    /// A value that the zoom does not take.
    pub(crate) fn update(
        &mut self,
        event: &Event,
        settings: &mut Settings,
    ) -> Result<bool, Problem> {
        match event {
            Event::HandleMoved { id, x, y } if id == SPACE.orbit => self.turned = (*x, *y),
            Event::HandleMoved { id, x, y } if id == SPACE.pan => self.panned = (*x, *y),
            Event::Set { id, value } if id == ZOOM.id => {
                settings.set(id, value)?;
            }
            Event::Press { id } if id == RECENTER.id => {
                settings.set(ZOOM.id, &Value::Number(ZOOM.default))?;
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
    use crate::contract::Knob;

    #[test]
    fn events_turn_move_enlarge_and_return() {
        let mut settings = Settings::new(&[Knob::Slider(&ZOOM)]);
        let mut orbit = Orbit::new(-35.0, 20.0);
        let fresh = orbit;
        let moved = |id: &str, x, y| Event::HandleMoved {
            id: id.to_owned(),
            x,
            y,
        };
        assert_eq!(
            orbit.update(&moved("orbit", 90.0, 0.0), &mut settings),
            Ok(true)
        );
        assert_eq!(orbit.words(), "90° to the left, level");
        assert_eq!(
            orbit.update(&moved("pan", 18.0, -9.0), &mut settings),
            Ok(true)
        );
        assert_eq!(orbit.handles()[1].value_text, "55 % across, 45 % down");
        assert_eq!(
            orbit.update(&moved("probe", 1.0, 1.0), &mut settings),
            Ok(false)
        );
        let zoom = |value| Event::Set {
            id: "zoom".to_owned(),
            value: Value::Number(value),
        };
        assert_eq!(orbit.update(&zoom(3.0), &mut settings), Ok(true));
        assert!(orbit.update(&zoom(100.0), &mut settings).is_err());
        assert_eq!(settings.number(&ZOOM), 3.0);
        let press = Event::Press {
            id: RECENTER.id.to_owned(),
        };
        assert_eq!(orbit.update(&press, &mut settings), Ok(true));
        assert_eq!((orbit, settings.number(&ZOOM)), (fresh, 1.0));
    }
}
