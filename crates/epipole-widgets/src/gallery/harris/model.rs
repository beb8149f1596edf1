//! The picture, its Harris response, the corners above a threshold, and a probe.

use super::question::{Answer, Question, STILL_LIFE_SIZE, Source};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, PhotoSlot,
    Problem, Settings, Slider, knobs,
};
use crate::kit::picture::{Own, slot};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::scenes::SQUARE_SIZE;
use epipole::feature::WindowTensor;
use image::RgbImage;

const SOURCE: Choice = Choice::new(
    "source",
    "Image",
    &[
        ("square", "Square"),
        ("still-life", "Still life"),
        ("own", "Your photograph"),
    ],
);
const OWN: usize = 2;
const THRESHOLD: Slider = Slider::new("threshold", "Threshold")
    .range(1.0, 90.0, 1.0)
    .at(20.0)
    .unit("%");
const K: Slider = Slider::new("k", "Harris constant k")
    .range(0.01, 0.2, 0.01)
    .at(0.04)
    .digits(2);
const WINDOW: Slider = Slider::new("window", "Window")
    .range(3.0, 15.0, 2.0)
    .at(7.0)
    .unit("px");
const KNOBS: &[Knob] = knobs![SOURCE, THRESHOLD, K, WINDOW];

const SLOTS: &[PhotoSlot] = &[slot(640)];
/// Minimum side of a photograph, pixels: the largest window must fit.
const MIN_SIDE_PX: u32 = 16;
/// Larger eigenvalue below which a pixel's neighborhood is flat, not an edge, gray levels squared.
const FLAT: f64 = 400.0;

/// Classification of a pixel's neighborhood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Flat,
    Edge,
    Corner,
}

/// The structure tensor at the probe, its eigenvalues, response and verdict.
pub(super) struct Probed {
    pub(super) tensor: WindowTensor,
    pub(super) lambda1: f64,
    pub(super) lambda2: f64,
    pub(super) response: f64,
    pub(super) verdict: Verdict,
}

/// Initially on a corner of the square.
const PROBE: Probe = Probe::new("probe", "picture", "Probe")
    .over(SQUARE_SIZE)
    .step(2.0)
    .at(150.0, 143.0);

/// The model of `harris`.
pub struct Harris {
    settings: Settings,
    own: Own<1>,
    pub(super) probe: Probe,
    pub(super) asked: Computation<Question>,
}

impl Harris {
    /// Returns width and height of the picture, pixels, even before it is available.
    pub(super) fn size(&self) -> (u32, u32) {
        match self.settings.chosen(&SOURCE) {
            0 => SQUARE_SIZE,
            1 => STILL_LIFE_SIZE,
            _ => self.own.get(0).map_or(SQUARE_SIZE, |own| own.size()),
        }
    }

    pub(super) fn threshold_percent(&self) -> f64 {
        self.settings.number(&THRESHOLD)
    }

    /// Returns the minimum response of a corner.
    fn threshold(&self, answer: &Answer) -> f32 {
        self.threshold_percent() as f32 / 100.0 * answer.strongest()
    }

    /// Returns the corners: local maxima above the threshold, strongest first.
    pub(super) fn corners(&self) -> &[(u32, u32)] {
        let Some(answer) = self.asked.answer() else {
            return &[];
        };
        let threshold = self.threshold(answer);
        let strong = |&(u, v): &(u32, u32)| answer.response.get_pixel(u, v).0[0] >= threshold;
        &answer.peaks[..answer.peaks.partition_point(strong)]
    }

    pub(super) fn probe(&self) -> Option<Probed> {
        let (question, answer) = self.asked.answered()?;
        let tensor = question.tensor(answer, self.probe.pixel())?;
        let (lambda1, lambda2) = tensor.eigenvalues();
        let response = tensor.harris(f64::from(question.k));
        let verdict = if response >= f64::from(self.threshold(answer)) {
            Verdict::Corner
        } else if response < 0.0 && lambda1 > FLAT {
            Verdict::Edge
        } else {
            Verdict::Flat
        };
        Some(Probed {
            tensor,
            lambda1,
            lambda2,
            response,
            verdict,
        })
    }

    fn ask(&mut self) {
        let source = match self.settings.chosen(&SOURCE) {
            0 => Source::Pattern,
            1 => Source::StillLife,
            _ => match self.own.get(0) {
                Some(own) => Source::Own(own.clone()),
                None => return self.asked.refuse("No photograph has been chosen yet."),
            },
        };
        self.asked.ask(Question {
            source,
            k: self.settings.number(&K) as f32,
            window_px: self.settings.count(&WINDOW),
        });
    }

    /// Resets the probe and drops the last result, because the picture has changed.
    fn begin(&mut self) {
        self.probe = match self.settings.chosen(&SOURCE) {
            0 => PROBE,
            _ => PROBE.in_middle(self.size()),
        };
        self.asked.forget();
        self.ask();
    }
}

impl Declared for Harris {
    const NAME: &'static str = "harris";
    const TITLE: &'static str = "Where are the corners?";
    const HELP: &'static str = "Drag the probe over the picture, or move it with the arrow keys, \
        and read the structure tensor under it. Click to put it elsewhere.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            probe: PROBE,
            asked: Computation::default(),
        };
        model.begin();
        model
    }
}

impl Model for Harris {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.probe.update(event) {
            return Ok(());
        }
        match self.settings.update(event)? {
            Some(id) if id == SOURCE.id => self.begin(),
            Some(id) if id != THRESHOLD.id => self.ask(),
            _ => {}
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn wants_photos(&self) -> bool {
        self.settings.chosen(&SOURCE) == OWN && self.own.get(0).is_none()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        self.settings.choose(&SOURCE, OWN);
        self.begin();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<Harris>] = &[
    Challenge {
        id: "edge",
        goal: "Put the probe where the response is negative.",
        hint: "One large eigenvalue and one small one.",
        why: "Along an edge only one eigenvalue is large, so the determinant is small and k (tr M)² \
              outweighs it.",
        check: |model| {
            let probe = model.probe();
            probe.is_some_and(|probe| probe.verdict == Verdict::Edge)
        },
        solution: || vec![Event::moved("probe", 165.0, 102.0)],
    },
    Challenge {
        id: "hundred",
        goal: "Find a hundred corners or more in the still life.",
        hint: "Lower the bar.",
        why: "The threshold is a fraction of the strongest response, and one very strong corner had \
              hidden all the weaker ones.",
        check: |model| model.settings.chosen(&SOURCE) == 1 && model.corners().len() >= 100,
        solution: || {
            vec![
                Event::set(&SOURCE, "still-life"),
                Event::set(&THRESHOLD, 2.0),
            ]
        },
    },
];
