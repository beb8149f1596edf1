//! Say what the model knows and which function of the core it calls.

use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, knobs,
};
use crate::kit::probe::Probe;

const RADIUS: Slider = Slider::new("radius", "Radius")
    .range(0.1, 1.0, 0.1)
    .at(0.5)
    .digits(1)
    .unit("m");
const KNOBS: &[Knob] = knobs![RADIUS];
const POINT: Probe = Probe::new("point", "plan", "Point")
    .on_plan([[-1.0, 1.0]; 2])
    .at(0.8, 0.2);

/// The model of `new-figure`.
pub(crate) struct NewFigure {
    settings: Settings,
    pub(super) point: Probe,
}

impl NewFigure {
    pub(super) fn radius_m(&self) -> f64 {
        self.settings.number(&RADIUS)
    }

    pub(super) fn distance_m(&self) -> f64 {
        let (x, z) = self.point.place();
        libm::hypot(x, z)
    }
}

impl Declared for NewFigure {
    const NAME: &'static str = "new-figure";
    const TITLE: &'static str = "New figure";
    const HELP: &'static str = "Drag the point, or move it with the arrow keys.";
    const CHALLENGES: &'static [Challenge<Self>] = &[Challenge {
        id: "inside",
        goal: "Bring the point inside the circle.",
        hint: "The point moves, and so does the circle.",
        why: "The distance from the middle is now less than the radius.",
        check: |model| model.distance_m() <= model.radius_m(),
        solution: || vec![Event::moved("point", 0.1, 0.1)],
    }];

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            point: POINT,
        }
    }
}

impl Model for NewFigure {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.point.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        self.point.update(event);
        Ok(())
    }
}
