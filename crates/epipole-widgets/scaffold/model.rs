//! Say what the model knows and which function of the core it calls.

use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider,
    format_number,
};

const RADIUS: Slider = Slider {
    id: "radius",
    label: "Radius",
    unit: "m",
    min: 0.1,
    max: 1.0,
    step: 0.1,
    default: 0.5,
    digits: 1,
    visible: true,
};
const KNOBS: &[Knob] = &[Knob::Slider(&RADIUS)];

/// The model of `new-figure`.
pub struct NewFigure {
    settings: Settings,
    x_m: f64,
    y_m: f64,
}

impl NewFigure {
    pub(super) fn radius_m(&self) -> f64 {
        self.settings.number(&RADIUS)
    }

    fn distance_m(&self) -> f64 {
        libm::hypot(self.x_m, self.y_m)
    }
}

impl Model for NewFigure {
    const NAME: &'static str = "new-figure";
    const TITLE: &'static str = "New figure";
    const HELP: &'static str = "Drag the point, or move it with the arrow keys.";

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            x_m: 0.8,
            y_m: 0.2,
        }
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let place = [self.x_m, self.y_m].map(|value| format_number(value, 2));
        vec![Handle {
            id: "point".to_owned(),
            panel: "plane",
            label: "Point".to_owned(),
            value_text: format!("{} m across, {} m up", place[0], place[1]),
            x: self.x_m,
            y: self.y_m,
            x_range: [-1.0, 1.0],
            y_range: [-1.0, 1.0],
            step: [0.1, 0.1],
            digits: 2,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
            }
            Event::HandleMoved { x, y, .. } => (self.x_m, self.y_m) = (*x, *y),
            _ => {}
        }
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        vec![Readout::number(
            "distance",
            "Distance from the middle",
            self.distance_m(),
            2,
            "m",
        )]
    }

    fn describe(&self) -> String {
        let side = if self.distance_m() <= self.radius_m() {
            "inside"
        } else {
            "outside"
        };
        format!(
            "The point is {} m from the middle, {side} the circle of radius {} m.",
            format_number(self.distance_m(), 2),
            format_number(self.radius_m(), 1)
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[Challenge {
            id: "inside",
            goal: "Bring the point inside the circle.",
            hint: "The point moves, and so does the circle.",
            check: |model| model.distance_m() <= model.radius_m(),
            solution: || {
                vec![Event::HandleMoved {
                    id: "point".to_owned(),
                    x: 0.1,
                    y: 0.1,
                }]
            },
        }]
    }
}
