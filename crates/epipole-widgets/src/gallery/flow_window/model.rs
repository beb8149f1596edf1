//! A window of a photograph, its true motion to the next frame, and the settings for tracking it.

use super::flow::{Flow, LARGEST_HALF, REACH, Setup};
use super::question::{Question, SIZE};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, format_number, knobs,
};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use nalgebra::Vector2;

const WINDOW: Slider = Slider::new("window", "Window")
    .range(5.0, (2 * LARGEST_HALF + 1) as f64, 2.0)
    .at(15.0)
    .unit("px");
const STEPS: Slider = Slider::new("steps", "Steps").range(1.0, 10.0, 1.0).at(6.0);
const LEVELS: Slider = Slider::new("levels", "Pyramid levels")
    .range(1.0, 3.0, 1.0)
    .at(1.0);
const SHOW: Choice = Choice::new(
    "show",
    "Show",
    &[("equations", "Equations"), ("difference", "Difference")],
);
const NOISE: Slider = Slider::new("noise", "Noise σ")
    .range(0.0, 10.0, 0.5)
    .at(4.0)
    .digits(1)
    .unit("levels")
    .more();
const GAIN: Slider = Slider::new("gain", "Brighter by")
    .range(-20.0, 20.0, 1.0)
    .at(0.0)
    .unit("%")
    .more();
const KNOBS: &[Knob] = knobs![WINDOW, STEPS, LEVELS, SHOW, NOISE, GAIN];

/// Initially on a corner of the picture's frame.
const PLACE: Probe = Probe::new("place", "photo", "Window")
    .within([room(SIZE.0), room(SIZE.1)])
    .at(145.0, 73.0);
const fn room(size: u32) -> [f64; 2] {
    let margin = LARGEST_HALF + 1;
    [margin as f64, (size - 1 - margin) as f64]
}
/// The true motion from frame 1 to frame 2.
const MOTION: Probe = Probe::new("motion", "plane", "True motion")
    .within([[-(REACH as f64), REACH as f64]; 2])
    .step(0.1)
    .digits(1)
    .told(|(du, dv)| {
        let [du, dv] = [du, dv].map(|shift| format_number(shift, 1));
        format!("{du} px right, {dv} px down")
    })
    .at(1.2, -0.8);

/// Error above which tracking has failed, pixels.
const ASTRAY_PX: f64 = 1.0;

/// Content of the plane of motions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    Equations,
    Difference,
}

/// The model of `flow-window`.
pub(crate) struct FlowWindow {
    settings: Settings,
    pub(super) place: Probe,
    pub(super) motion: Probe,
    pub(super) asked: Computation<Question>,
    photograph: Option<GrayImage32>,
    flow: Result<Flow, String>,
    /// Version of the flow, for the cache of the view's map.
    pub(super) version: u64,
}

impl FlowWindow {
    /// Returns the window's flow, or a message why there is none.
    pub(super) fn flow(&self) -> Result<&Flow, &str> {
        self.flow.as_ref().map_err(String::as_str)
    }

    pub(super) fn setup(&self) -> Setup {
        let (du, dv) = self.motion.place();
        Setup {
            place: self.place.pixel(),
            half: self.settings.count(&WINDOW) as u32 / 2,
            motion: Vector2::new(du, dv),
            noise: (self.settings.number(&NOISE) / 255.0) as f32,
            gain: (1.0 + self.settings.number(&GAIN) / 100.0) as f32,
            num_levels: self.settings.count(&LEVELS),
            num_steps: self.settings.count(&STEPS),
        }
    }

    pub(super) fn shown(&self) -> Shown {
        [Shown::Equations, Shown::Difference][self.settings.chosen(&SHOW)]
    }

    /// Returns the motion found, pixels; `None` if the window was lost.
    pub(super) fn found(&self) -> Option<Vector2<f64>> {
        self.flow().ok()?.found(&self.setup())
    }

    /// Returns the distance of the motion found from the true one, pixels.
    pub(super) fn error_px(&self) -> Option<f64> {
        Some((self.found()? - self.setup().motion).norm())
    }

    fn follow(&mut self) {
        self.flow = match &self.photograph {
            Some(photograph) => Flow::new(photograph, &self.setup())
                .map_err(|error| format!("The window has no flow: {error}.")),
            None => Err(self.asked.sentence()),
        };
        self.version += 1;
    }
}

impl Declared for FlowWindow {
    const NAME: &'static str = "flow-window";
    const TITLE: &'static str = "Where did this window go?";
    const HELP: &'static str = "Drag the window over the photograph, or move it with the arrow keys. The handle \
        on the right is the true motion to the next frame: drag it, and see where the equations put it.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let asked = Computation::of(Question);
        Self {
            settings: Settings::new(KNOBS),
            place: PLACE,
            motion: MOTION,
            flow: Err(asked.sentence()),
            asked,
            photograph: None,
            version: 0,
        }
    }
}

impl Model for FlowWindow {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.place.handle(), self.motion.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let is_moved = self.motion.update(event) || self.place.update(event);
        if is_moved || self.settings.update(event)?.is_some() {
            self.follow();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        let photograph = self.asked.answer();
        self.photograph =
            photograph.map(|photograph| rgb_to_gray_f32(photograph.image(), &BT601_WEIGHTS));
        self.follow();
    }
}

const CHALLENGES: &[Challenge<FlowWindow>] = &[
    Challenge {
        id: "aperture",
        goal: "Find a place where all steep pixels agree, and the answer is more than 1 px wrong.",
        hint: "Along what can a window slide without a change?",
        why: "Along an edge all pixels give the same equation. The motion across it is right; the one along \
              it is whatever noise says.",
        check: |model| {
            let is_one_sided = |flow: &Flow| {
                let (large, small) = flow.tensor.eigenvalues();
                small < 0.03 * large && large > 1e-3
            };
            let is_astray = model.error_px().is_some_and(|error| error > ASTRAY_PX);
            model.setup().gain == 1.0 && is_astray && model.flow().is_ok_and(is_one_sided)
        },
        solution: || {
            vec![
                Event::moved(PLACE.id(), 118.0, 74.0),
                Event::moved(MOTION.id(), 4.0, -0.8),
            ]
        },
    },
    Challenge {
        id: "far",
        goal: "Find a motion that one level misses by more than 1 px on this corner.",
        hint: "Taylor's line holds for small steps. How far does the corner reach?",
        why: "The first step uses a gradient that says nothing about what is farther away than the blur of the \
              edge. A pyramid makes the motion small first.",
        check: |model| {
            let setup = model.setup();
            let is_lost = model.found().is_none();
            let is_astray = model.error_px().is_some_and(|error| error > ASTRAY_PX);
            let is_here = model.place.place() == PLACE.place() && model.photograph.is_some();
            is_here && setup.num_levels == 1 && setup.num_steps >= 6 && (is_lost || is_astray)
        },
        solution: || vec![Event::moved(MOTION.id(), 6.0, -6.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settled;

    #[test]
    fn the_corner_is_followed_to_a_tenth_of_a_pixel() {
        let model: FlowWindow = settled(&[]);
        assert!(model.error_px().unwrap() < 0.1, "{:?}", model.error_px());
        assert!(!CHALLENGES.iter().any(|challenge| (challenge.check)(&model)));
    }

    #[test]
    fn a_pyramid_finds_what_one_level_misses() {
        let far = Event::moved(MOTION.id(), 6.0, -6.0);
        let one: FlowWindow = settled(std::slice::from_ref(&far));
        assert!(one.error_px().is_none_or(|error| error > ASTRAY_PX));
        let three: FlowWindow = settled(&[far, Event::set(&LEVELS, 3.0), Event::set(&STEPS, 10.0)]);
        assert!(three.error_px().unwrap() < 0.1, "{:?}", three.error_px());
    }

    #[test]
    fn a_change_of_light_breaks_the_equations() {
        let model: FlowWindow = settled(&[Event::set(&GAIN, 20.0)]);
        assert!(
            model.error_px().is_none_or(|error| error > 0.3),
            "{:?}",
            model.error_px()
        );
    }

    #[test]
    fn there_are_words_before_the_photograph() {
        let model = FlowWindow::new();
        assert_eq!(model.describe(), "Taking the photograph.");
        assert!(model.flow().is_err() && model.error_px().is_none());
    }
}
