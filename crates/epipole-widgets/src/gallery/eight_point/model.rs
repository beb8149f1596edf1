//! The eight-point algorithm on matches of the still life, both with and without normalization.
//!
//! The state is the settings and the place of the probe. Matches are drawn when they are first
//! needed, because following rays through the scene is the only part that takes time.

use super::estimate::{Estimate, Meeting, line2};
use super::matches::{MAX_USED, Matches, cameras, exact_match};
use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider, Toggle,
    Value, format_number,
};
use crate::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use crate::words;
use epipole::camera::Camera;
use epipole::epipolar::{EightPoint as Solution, Epipole, epipoles, fundamental_from_cameras};
use epipole::math::svd3;
use nalgebra::{Matrix3, Point2};
use std::cell::OnceCell;

const COUNT: Slider = Slider {
    id: "count",
    label: "Number of matches",
    unit: "",
    min: 8.0,
    max: MAX_USED as f64,
    step: 1.0,
    default: 16.0,
    digits: 0,
    visible: true,
};
const NOISE: Slider = Slider {
    id: "noise",
    label: "Pixel noise σ",
    unit: "px",
    min: 0.0,
    max: 3.0,
    step: 0.1,
    default: 0.5,
    digits: 1,
    visible: true,
};
const NORMALIZE: Toggle = Toggle {
    id: "normalize",
    label: "Normalize the pixels",
    default: true,
};
const RANK2: Toggle = Toggle {
    id: "rank2",
    label: "Enforce rank 2",
    default: true,
};
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = &[
    Knob::Slider(&COUNT),
    Knob::Slider(&NOISE),
    Knob::Toggle(&NORMALIZE),
    Knob::Toggle(&RANK2),
    Knob::Slider(&SEED),
];

/// Where the probe begins: on the handle of the mug.
const PROBE_PX: Point2<f64> = Point2::new(479.0, 327.0);

/// The model of `eight-point`.
pub struct EightPoint {
    settings: Settings,
    probe: Point2<f64>,
    matches: OnceCell<Matches>,
    estimate: OnceCell<Result<Estimate, String>>,
}

impl EightPoint {
    fn matches(&self) -> &Matches {
        let seed = self.settings.count(&SEED) as u64;
        self.matches.get_or_init(|| Matches::draw(seed))
    }

    /// The estimate, or why there is none.
    pub(super) fn estimate(&self) -> Result<&Estimate, &str> {
        let known = self
            .estimate
            .get_or_init(|| self.compute().map_err(|e| format!("There is no F: {e}.")));
        known.as_ref().map_err(String::as_str)
    }

    fn compute(&self) -> Result<Estimate, epipole::Error> {
        let matches = self.matches();
        let used = matches.noisy(self.settings.count(&COUNT), self.settings.number(&NOISE));
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

    pub(super) fn cameras(&self) -> [Camera; 2] {
        cameras()
    }

    /// F of the cameras themselves.
    pub(super) fn truth(&self) -> Option<Matrix3<f64>> {
        let [first, second] = cameras();
        fundamental_from_cameras(&first, &second).ok()
    }

    /// The true epipole in photograph 2.
    pub(super) fn true_epipole2(&self) -> Option<Epipole> {
        Some(epipoles(&self.truth()?).ok()?.1)
    }

    pub(super) fn probe(&self) -> Point2<f64> {
        self.probe
    }

    /// The exact match of the probe, if photograph 2 shows it.
    pub(super) fn probe_match(&self) -> Option<Point2<f64>> {
        exact_match(&self.probe)
    }

    fn probe_px(&self) -> Option<f64> {
        let line = line2(&self.estimate().ok()?.fundamental, &self.probe)?;
        Some(line.signed_distance(&self.probe_match()?).abs())
    }

    fn handle(&self) -> Handle {
        Handle {
            id: "probe".to_owned(),
            panel: "first",
            label: "Probe in photograph 1".to_owned(),
            value_text: format!("column {:.1}, row {:.1}", self.probe.x, self.probe.y),
            x: self.probe.x,
            y: self.probe.y,
            x_range: [0.0, f64::from(PHOTO_WIDTH) - 1.0],
            y_range: [0.0, f64::from(PHOTO_HEIGHT) - 1.0],
            step: [4.0, 4.0],
            digits: 1,
            removable: false,
        }
    }

    fn put_probe(&mut self, x: f64, y: f64) {
        if let Some((x, y)) = self.handle().admit(x, y) {
            self.probe = Point2::new(x, y);
        }
    }
}

impl Model for EightPoint {
    const NAME: &'static str = "eight-point";
    const TITLE: &'static str = "F from matches";
    const HELP: &'static str = "Drag the probe over photograph 1, or move it with the arrow keys: \
        photograph 2 shows its line by the F that was found, and its true match. Change the number \
        of matches and their noise, and switch normalization and rank 2 off and on.";

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            probe: PROBE_PX,
            matches: OnceCell::new(),
            estimate: OnceCell::new(),
        }
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                let has_changed = self.settings.set(id, value)? == Some(true);
                if has_changed {
                    self.estimate.take();
                }
                if has_changed && id == SEED.id {
                    self.matches.take();
                }
            }
            Event::HandleMoved { x, y, .. } | Event::Clicked { x, y, .. } => self.put_probe(*x, *y),
            _ => {}
        }
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        let estimate = match self.estimate() {
            Ok(estimate) => estimate,
            Err(sentence) => return vec![Readout::words("state", "State", sentence)],
        };
        let solution = estimate.chosen();
        let sigma = &solution.singular_values;
        let values = [0, 7, 8].map(|k| words::magnitude(sigma[k], sigma[0]));
        let of_f = svd3(&estimate.fundamental).singular_values;
        let third = of_f[2] / of_f[0].max(f64::MIN_POSITIVE);
        let condition = |solution: &Solution| words::magnitude(solution.condition_number, 0.0);
        let number = |id, label, value| Readout::number(id, label, value, 2, "px");
        vec![
            Readout::words(
                "condition-raw",
                "Condition number, raw pixels",
                condition(&estimate.raw),
            ),
            Readout::words(
                "condition",
                "Condition number, normalized",
                condition(&estimate.normalized),
            ),
            Readout::words("values", "σ₁, σ₈, σ₉ of the rows", values.join(", ")),
            Readout::words(
                "third",
                "Third singular value of F over its first",
                words::magnitude(third, 1.0),
            ),
            Readout::words("meeting", "The lines", meeting_words(estimate.meeting)),
            number("used", "Mean distance, matches used", estimate.used_px),
            number(
                "held-out",
                "Mean distance, held-out points",
                estimate.held_out_px,
            ),
            match self.probe_px() {
                Some(distance) => number("probe-px", "Match of the probe from its line", distance),
                None => Readout::words(
                    "probe-px",
                    "Match of the probe from its line",
                    "not seen in photograph 2",
                ),
            },
        ]
    }

    fn describe(&self) -> String {
        let estimate = match self.estimate() {
            Ok(estimate) => estimate,
            Err(sentence) => return sentence.to_owned(),
        };
        let solution = estimate.chosen();
        format!(
            "F from {} matches with {} px of noise, {}, condition number {}. {}. Held-out points are \
             {} px from their lines on average.",
            estimate.used.len(),
            format_number(self.settings.number(&NOISE), 1),
            if self.is_normalized() {
                "normalized"
            } else {
                "not normalized"
            },
            words::magnitude(solution.condition_number, 0.0),
            match estimate.meeting {
                Some(meeting) if meeting.miss_px < 1e-6 =>
                    "All epipolar lines meet in the epipole".to_owned(),
                Some(meeting) => format!(
                    "Its rank is 3, so the epipolar lines miss one another, by {} px on average",
                    format_number(meeting.miss_px, 2)
                ),
                None => "The epipolar lines are nearly parallel".to_owned(),
            },
            format_number(estimate.held_out_px, 2),
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        CHALLENGES
    }
}

/// Whether and where the lines meet.
fn meeting_words(meeting: Option<Meeting>) -> String {
    match meeting {
        Some(meeting) if meeting.miss_px < 1e-6 => {
            format!("meet in {}", words::pixel(&meeting.place))
        }
        Some(meeting) => format!(
            "miss one another by {} px",
            format_number(meeting.miss_px, 2)
        ),
        None => "are nearly parallel".to_owned(),
    }
}

const CHALLENGES: &[Challenge<EightPoint>] = &[
    Challenge {
        id: "miss",
        goal: "Make the epipolar lines miss one another by more than 1 px.",
        hint: "Which step of the algorithm makes them meet?",
        check: |model| {
            let meeting = model.estimate().ok().and_then(|estimate| estimate.meeting);
            meeting.is_some_and(|meeting| meeting.miss_px > 1.0)
        },
        solution: || vec![flag(&RANK2, false), number(&NOISE, 2.0)],
    },
    Challenge {
        id: "more",
        goal: "With a noise of 1 px or more, bring held-out points within 0.7 px of their lines.",
        hint: "Errors of many matches average out.",
        check: |model| {
            model.settings.number(&NOISE) >= 1.0
                && model
                    .estimate()
                    .is_ok_and(|estimate| estimate.held_out_px < 0.7)
        },
        solution: || vec![number(&NOISE, 1.0), number(&COUNT, 60.0)],
    },
    Challenge {
        id: "raw",
        goal: "Find a state in which held-out points are more than 5 px from their lines.",
        hint: "Few matches, more noise, and pixels as they are.",
        check: |model| {
            model
                .estimate()
                .is_ok_and(|estimate| estimate.held_out_px > 5.0)
        },
        solution: || {
            vec![
                flag(&NORMALIZE, false),
                number(&COUNT, 10.0),
                number(&NOISE, 3.0),
            ]
        },
    },
];

fn number(slider: &Slider, value: f64) -> Event {
    Event::Set {
        id: slider.id.to_owned(),
        value: Value::Number(value),
    }
}

fn flag(toggle: &Toggle, value: bool) -> Event {
    Event::Set {
        id: toggle.id.to_owned(),
        value: Value::Flag(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(events: &[Event]) -> EightPoint {
        let mut model = EightPoint::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn without_noise_the_truth_is_found() {
        for is_normalized in [true, false] {
            let model = changed(&[number(&NOISE, 0.0), flag(&NORMALIZE, is_normalized)]);
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
        let without = changed(&[flag(&RANK2, false)]);
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
