//! Settings of the disparity search, and a probe.

use super::question::{Answer, Method, Question};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, Toggle, knobs,
};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::rectified::SIZE;

const METHOD: Choice = Choice::new(
    "method",
    "Method",
    &[("bm", "Block matching"), ("sgm", "Semi-global")],
);
const WINDOW: Slider = Slider::new("window", "Window")
    .range(5.0, 21.0, 2.0)
    .at(11.0)
    .unit("px");
const RANGE: Slider = Slider::new("range", "Search range")
    .range(16.0, 96.0, 8.0)
    .at(48.0)
    .unit("px");
const BASELINE: Slider = Slider::new("baseline", "Baseline")
    .range(0.02, 0.2, 0.02)
    .at(0.08)
    .digits(2)
    .unit("m");
const CHECKS: Toggle = Toggle::new("checks", "Drop uncertain").on();
const KNOBS: &[Knob] = knobs![METHOD, WINDOW, RANGE, BASELINE, CHECKS];

/// Initially on the mug, visible to both cameras.
const PROBE: Probe = Probe::new("probe", "left", "Probe")
    .over(SIZE)
    .step(2.0)
    .at(228.0, 165.0);

/// The model of `disparity-map`.
pub(crate) struct DisparityMap {
    settings: Settings,
    pub(super) probe: Probe,
    pub(super) asked: Computation<Question>,
}

/// Computed and true disparity at the probe, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Probed {
    pub(super) found_px: Option<f32>,
    pub(super) truth_px: f32,
    pub(super) is_hidden: bool,
}

impl DisparityMap {
    pub(super) fn probed(&self, answer: &Answer) -> Option<Probed> {
        let (u, v) = self.probe.pixel();
        Some(Probed {
            found_px: answer.found.get(u, v),
            truth_px: answer.pair.truth.get(u, v)?,
            is_hidden: answer.pair.is_hidden(u, v),
        })
    }

    /// Returns the side of the matching window, pixels; `None` for semi-global matching.
    pub(super) fn window_px(&self) -> Option<u32> {
        let window_px = self.settings.number(&WINDOW) as u32;
        (self.settings.chosen(&METHOD) == 0).then_some(window_px)
    }

    fn ask(&mut self) {
        self.asked.ask(Question {
            baseline_m: self.settings.number(&BASELINE),
            method: match self.window_px() {
                Some(window_px) => Method::Blocks(window_px),
                None => Method::SemiGlobal,
            },
            num_disparities: self.settings.number(&RANGE) as u32,
            checks: self.settings.flag(&CHECKS),
        });
    }

    fn is_answered(&self, check: impl Fn(&Question, &Answer) -> bool) -> bool {
        let answered = self.asked.answered();
        answered.is_some_and(|(question, answer)| check(question, answer))
    }
}

impl Declared for DisparityMap {
    const NAME: &'static str = "disparity-map";
    const TITLE: &'static str = "A disparity for every pixel";
    const HELP: &'static str = "Change how matches are looked for. Drag the probe over the left \
        photograph, or move it with the arrow keys, and compare what was found with what is true.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            probe: PROBE,
            asked: Computation::default(),
        };
        model.ask();
        model
    }
}

impl Model for DisparityMap {
    fn controls(&self) -> Vec<Control> {
        let has_window = self.window_px().is_some();
        (self.settings).controls_enabled(|id| id != WINDOW.id || has_window)
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.probe.update(event) {
            return Ok(());
        }
        if self.settings.update(event)?.is_some() {
            self.ask();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<DisparityMap>] = &[
    Challenge {
        id: "too-near",
        goal: "Make the nearest objects too near for the search.",
        hint: "Their disparity must be larger than all that are looked for.",
        why: "The search range sets the nearest depth that can be found at all: Z = f B / d.",
        check: |model| model.is_answered(|question, answer| !question.reaches_nearest(answer)),
        solution: || vec![Event::set(&RANGE, 16.0)],
    },
    Challenge {
        id: "sharp",
        goal: "With block matching, get under 1.3% bad answers.",
        hint: "Which windows reach across fewer edges?",
        why: "A small window smears less across the outlines of things, and pays with fewer answers.",
        check: |model| {
            model.is_answered(|question, answer| {
                matches!(question.method, Method::Blocks(_)) && answer.scores.bad < 0.013
            })
        },
        solution: || vec![Event::set(&WINDOW, 5.0)],
    },
    Challenge {
        id: "wide",
        goal: "With a baseline of 0.20 m, answer for 99% of what both cameras see.",
        hint: "Twice the baseline, twice the disparity.",
        why: "A longer baseline stretches all disparities, so the search must reach farther, and views \
              that differ more need a method that looks beyond its window.",
        check: |model| {
            model.is_answered(|question, answer| {
                question.baseline_m == BASELINE.max && answer.scores.coverage >= 0.99
            })
        },
        solution: || {
            vec![
                Event::set(&METHOD, "sgm"),
                Event::set(&BASELINE, BASELINE.max),
                Event::set(&RANGE, 96.0),
            ]
        },
    },
];
