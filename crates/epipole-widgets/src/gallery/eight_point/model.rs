//! The eight-point algorithm on matches of the still life, both with and without normalization.
//!
//! The state consists of the settings and the position of the probe. Matches are drawn on first
//! use; the photographs come from a worker, which nothing waits for.

use super::estimate::Estimate;
use super::question::{Answer, Question};
use crate::contract::{
    Asking, Challenge, Compute, Control, Data, Datum, Declared, Event, Handle, Knob, Model,
    Problem, Settings, Slider, Symbol, Toggle, knobs, match_data,
};
use crate::kit::geometry::match_symbols;
use crate::kit::matches::{MAX_USED, Matches, cameras, distance_px, exact_match, line2};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::scenes::PHOTO_SIZE;
use epipole::epipolar::{Epipole, epipoles, fundamental_from_cameras};
use nalgebra::{Matrix3, Point2};
use std::cell::OnceCell;

const COUNT: Slider = Slider::new("count", "Matches")
    .range(8.0, MAX_USED as f64, 1.0)
    .at(16.0);
const NOISE: Slider = Slider::new("noise", "Pixel noise σ")
    .range(0.0, 3.0, 0.1)
    .at(0.5)
    .digits(1)
    .unit("px");
const NORMALIZE: Toggle = Toggle::new("normalize", "Normalize").on();
const RANK2: Toggle = Toggle::new("rank2", "Enforce rank 2").on();
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![COUNT, NOISE, NORMALIZE, RANK2, SEED];

/// Initially on the handle of the mug.
const PROBE: Probe = Probe::new("probe", "first", "Probe in photograph 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .at(479.0, 327.0);

/// The model of `eight-point`.
pub struct EightPoint {
    settings: Settings,
    probe: Probe,
    asked: Computation<Question>,
    estimate: OnceCell<Result<Estimate, String>>,
}

impl EightPoint {
    /// Returns the photographs, or a message why there are none.
    pub(super) fn photographs(&self) -> Result<&Answer, &str> {
        let why = || self.asked.stand_in();
        self.asked.answer().ok_or_else(why)
    }

    /// Returns the estimate, or a message why there is none.
    pub(super) fn estimate(&self) -> Result<&Estimate, &str> {
        let known = self
            .estimate
            .get_or_init(|| self.compute().map_err(|e| format!("There is no F: {e}.")));
        known.as_ref().map_err(String::as_str)
    }

    fn compute(&self) -> Result<Estimate, epipole::Error> {
        let matches = Matches::draw(self.settings.count(&SEED) as u64);
        let used = matches.noisy(self.settings.count(&COUNT), self.noise_px());
        Estimate::new(
            used,
            &matches.held_out,
            self.is_normalized(),
            self.has_rank2(),
        )
    }

    pub(super) fn is_normalized(&self) -> bool {
        self.settings.flag(&NORMALIZE)
    }

    pub(super) fn has_rank2(&self) -> bool {
        self.settings.flag(&RANK2)
    }

    pub(super) fn noise_px(&self) -> f64 {
        self.settings.number(&NOISE)
    }

    /// Returns the mean distance of the lines from their intersection, pixels; `None` if they are
    /// nearly parallel.
    pub(super) fn miss_px(&self) -> Option<f64> {
        Some(self.estimate().ok()?.meeting?.miss_px)
    }

    /// Returns F of the true cameras.
    pub(super) fn truth(&self) -> Option<Matrix3<f64>> {
        let [first, second] = cameras();
        fundamental_from_cameras(&first, &second).ok()
    }

    /// Returns the true epipole in photograph 2.
    pub(super) fn true_epipole2(&self) -> Option<Epipole> {
        Some(epipoles(&self.truth()?).ok()?.1)
    }

    pub(super) fn probe(&self) -> Point2<f64> {
        self.probe.point()
    }

    /// Returns the exact match of the probe, if it is visible in photograph 2.
    pub(super) fn probe_match(&self) -> Option<Point2<f64>> {
        exact_match(&self.probe())
    }

    /// Returns the distance of the probe's match from its epipolar line, pixels.
    pub(super) fn probe_px(&self) -> Option<f64> {
        let found = (self.probe(), self.probe_match()?);
        distance_px(&self.estimate().ok()?.fundamental, &found)
    }
}

impl Declared for EightPoint {
    const NAME: &'static str = "eight-point";
    const TITLE: &'static str = "F from matches";
    const HELP: &'static str = "Drag the probe over photograph 1, or move it with the arrow keys: \
        photograph 2 shows its epipolar line by the F that was found, and its true match. Change the \
        matches and their noise, and switch normalization and rank 2 off and on.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            probe: PROBE,
            asked: Computation::of(Question),
            estimate: OnceCell::new(),
        }
    }
}

impl Model for EightPoint {
    /// Returns the matches used to estimate F.
    fn data(&self) -> Data {
        let Ok(estimate) = self.estimate() else {
            return Data::new();
        };
        let matches = estimate.used.iter().map(|(one, two)| (one, two));
        let mut data = Data::from(match_data(matches));
        data.insert("fundamental", Datum::matrix(&estimate.fundamental));
        data
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    /// Returns the symbols of the probe.
    fn symbols(&self) -> Vec<Symbol> {
        let estimate = self.estimate().ok();
        let line = estimate.and_then(|found| line2(&found.fundamental, &self.probe()));
        match_symbols([Some(self.probe()), self.probe_match()], line)
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.probe.update(event) {
            return Ok(());
        }
        if self.settings.update(event)?.is_some() {
            self.estimate.take();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<EightPoint>] = &[
    Challenge {
        id: "miss",
        goal: "Make the epipolar lines miss one another by more than 2 px.",
        hint: "Which step makes them meet?",
        why: "An F of rank 3 sends no pixel to zero, so its lines have no common point; noise drives \
              them apart.",
        check: |model| model.miss_px().is_some_and(|miss_px| miss_px > 2.0),
        solution: || vec![Event::set(&RANK2, false), Event::set(&NOISE, 3.0)],
    },
    Challenge {
        id: "exact",
        goal: "Without enforcing rank 2, make the lines meet within 0.05 px.",
        hint: "Where does the third singular value come from?",
        why: "Exact matches give rank 2 by themselves: the third singular value is made of noise.",
        check: |model| !model.has_rank2() && model.miss_px().is_some_and(|miss_px| miss_px < 0.05),
        solution: || vec![Event::set(&RANK2, false), Event::set(&NOISE, 0.0)],
    },
    Challenge {
        id: "more",
        goal: "With 1 px of noise or more, bring held-out points within 0.7 px.",
        hint: "Errors of many matches average out.",
        why: "Eight matches are fitted exactly, noise and all; sixty outvote one another's errors.",
        check: |model| {
            let estimate = model.estimate();
            model.noise_px() >= 1.0 && estimate.is_ok_and(|estimate| estimate.held_out_px < 0.7)
        },
        solution: || vec![Event::set(&NOISE, 1.0), Event::set(&COUNT, MAX_USED as f64)],
    },
    Challenge {
        id: "raw",
        goal: "With 60 matches, push held-out points beyond 5 px.",
        hint: "More matches do not help pixels as they are.",
        why: "In raw pixels the entries of a row run from 1 to 400,000, least squares serves the large \
              ones, and no number of matches averages that away.",
        check: |model| {
            let is_far = |estimate: &Estimate| estimate.held_out_px > 5.0;
            model.settings.count(&COUNT) == MAX_USED && model.estimate().is_ok_and(is_far)
        },
        solution: || {
            vec![
                Event::set(&NORMALIZE, false),
                Event::set(&COUNT, MAX_USED as f64),
                Event::set(&NOISE, 3.0),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::Question as _;

    fn changed(events: &[Event]) -> EightPoint {
        let mut model = EightPoint::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn nothing_waits_for_the_photographs() {
        let mut model = EightPoint::new();
        assert!(model.job().is_some() && model.estimate().is_ok());
        assert_eq!(model.photographs().err(), Some(Question::LABEL));
        let (readouts, words) = (model.readouts(), model.describe());
        model.job_done(Ok(vec![1, 2, 3]));
        let problem = model.photographs().err().unwrap();
        assert!(problem.starts_with("There are no photographs"));
        assert_eq!((model.readouts(), model.describe()), (readouts, words));
    }

    #[test]
    fn without_noise_the_truth_is_found() {
        for is_normalized in [true, false] {
            let model = changed(&[
                Event::set(&NOISE, 0.0),
                Event::set(&NORMALIZE, is_normalized),
            ]);
            let estimate = model.estimate().unwrap();
            assert!(estimate.held_out_px < 1e-5, "{}", estimate.held_out_px);
            let truth = model.truth().unwrap();
            let off = (estimate.fundamental - truth)
                .norm()
                .min((estimate.fundamental + truth).norm());
            assert!(off < 1e-6, "{off}");
        }
    }

    #[test]
    fn rank_2_makes_the_lines_meet_in_the_epipole() {
        let model = EightPoint::new();
        let estimate = model.estimate().unwrap();
        let meeting = estimate.meeting.unwrap();
        assert!(meeting.miss_px < 1e-6);
        let Epipole::Finite(epipole) = epipoles(&estimate.fundamental).unwrap().1 else {
            panic!("it is finite");
        };
        assert!((meeting.place - epipole).norm() < 1e-5);
        let without = changed(&[Event::set(&RANK2, false)]);
        let estimate = without.estimate().unwrap();
        assert!(estimate.fundamental.determinant().abs() > 0.0);
        assert!(estimate.meeting.unwrap().miss_px > 0.1);
    }

    #[test]
    fn normalization_improves_the_condition_a_thousand_times() {
        let model = EightPoint::new();
        let estimate = model.estimate().unwrap();
        let ratio = estimate.raw.condition_number / estimate.normalized.condition_number;
        assert!(ratio > 1000.0, "{ratio}");
    }
}
