//! A drive around a block: scale drift, distance traveled, and loop closure.

use super::drive::{self, Drive, Errors};
use super::question::{Answer, Judged, Kind, Question};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, Toggle, knobs,
};
use crate::kit::question::{Computation, carry_out};

const CLOSURE: Choice = Choice::new(
    "closure",
    "Loop closure",
    &[
        ("none", "None"),
        ("rigid", "Rigid, SE(3)"),
        ("similarity", "Similarity, Sim(3)"),
    ],
)
.at(2);
const DRIFT: Slider = Slider::new("drift", "Scale drift")
    .range(-2.0, 2.0, 0.1)
    .at(1.0)
    .digits(1)
    .unit("%");
const NOISE: Slider = Slider::new("noise", "Step noise")
    .range(0.0, 3.0, 0.1)
    .at(0.5)
    .digits(1)
    .unit("%");
const STEREO: Toggle = Toggle::new("stereo", "Stereo rig");
const STEPS: Slider = Slider::new("steps", "Steps around")
    .range(
        *drive::STEPS.start() as f64,
        *drive::STEPS.end() as f64,
        4.0,
    )
    .at(80.0)
    .more();
const SEED: Slider = Slider::seed(7.0);
const KNOBS: &[Knob] = knobs![CLOSURE, DRIFT, STEREO, NOISE, STEPS, SEED];

/// Handle for the distance traveled.
const TRAVELED: &str = "traveled";
/// Minimum number of steps shown.
const FEWEST: usize = 2;

/// The model of `scale-drift`.
pub(crate) struct ScaleDrift {
    settings: Settings,
    /// Number of steps that the reader has moved back to; `None` for the whole drive.
    stop: Option<usize>,
    /// Whole drive, regardless of the steps traveled.
    pub(super) drive: Drive,
    /// Odometry's estimate of the path traveled so far.
    pub(super) before: Judged,
    pub(super) asked: Computation<Question>,
}

impl ScaleDrift {
    /// Returns the path after loop closure; while the job is pending, that of the last drive.
    pub(super) fn after(&self) -> Option<&Judged> {
        let answer = self.asked.answer().filter(|_| self.is_home())?;
        answer.closed.as_ref().filter(|_| self.kind().is_some())
    }

    /// Returns the measured scale of the start when revisited, relative to the first visit.
    pub(super) fn seen(&self) -> Option<f64> {
        let answer = self.asked.answer().filter(|_| self.is_home());
        answer.and_then(|answer| answer.seen)
    }

    /// Simulates the drive again and requests its trajectory error and loop closure.
    fn refresh(&mut self) {
        let errors = errors_of(&self.settings);
        let (num_steps, traveled) = (self.num_steps(), self.traveled());
        self.drive = Drive::new(num_steps, &errors);
        self.before = before(&self.drive, traveled, self.asked.answer());
        self.asked.ask(Question {
            num_steps,
            traveled,
            errors,
            kind: self.kind(),
        });
    }

    pub(super) fn drift_percent(&self) -> f64 {
        self.settings.number(&DRIFT)
    }

    pub(super) fn is_metric(&self) -> bool {
        self.settings.flag(&STEREO)
    }

    pub(super) fn num_steps(&self) -> usize {
        self.settings.count(&STEPS)
    }

    pub(super) fn traveled(&self) -> usize {
        self.stop.unwrap_or(self.num_steps())
    }

    pub(super) fn is_home(&self) -> bool {
        self.stop.is_none()
    }

    /// Returns the kind of loop closure, if any.
    pub(super) fn kind(&self) -> Option<Kind> {
        [None, Some(Kind::Rigid), Some(Kind::Similarity)][self.settings.chosen(&CLOSURE)]
    }

    /// Returns the trajectory error of the closed path, if it belongs to the current state.
    fn error_after(&self) -> Option<f64> {
        self.after().filter(|_| !self.asked.is_waiting())?.error
    }

    fn go_to(&mut self, step: f64) {
        let step = step.max(FEWEST as f64).round() as usize;
        self.stop = (step < self.num_steps()).then_some(step);
    }
}

/// Returns the first `traveled` steps of odometry's estimate, with the error if known.
fn before(drive: &Drive, traveled: usize, answer: Option<&Answer>) -> Judged {
    Judged {
        poses: drive.believed[..=traveled].to_vec(),
        scale: drive.scale[..=traveled].to_vec(),
        error: answer.and_then(|answer| answer.error),
    }
}

fn errors_of(settings: &Settings) -> Errors {
    Errors {
        rate: settings.number(&DRIFT) / 100.0,
        noise: settings.number(&NOISE) / 100.0,
        is_metric: settings.flag(&STEREO),
        seed: settings.count(&SEED) as u64,
    }
}

impl Declared for ScaleDrift {
    const NAME: &'static str = "scale-drift";
    const TITLE: &'static str = "Coming home with the wrong scale";
    const HELP: &'static str = "Change how much the scale drifts, and how the loop is closed. Drag the \
        handle below the plot back and forth to drive around the block.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        let num_steps = settings.count(&STEPS);
        let drive = Drive::new(num_steps, &errors_of(&settings));
        let mut model = Self {
            settings,
            stop: None,
            before: before(&drive, num_steps, None),
            drive,
            asked: Computation::default(),
        };
        model.refresh();
        model
    }
}

impl Model for ScaleDrift {
    fn controls(&self) -> Vec<Control> {
        // A rig that measures the scale does not drift in scale.
        let drifts = !self.is_metric();
        (self.settings).controls_enabled(|id| id != DRIFT.id || drifts)
    }

    fn handles(&self) -> Vec<Handle> {
        let (traveled, all) = (self.traveled(), self.num_steps());
        let told = match self.is_home() {
            true => format!("all {all} steps, home again"),
            false => format!("{traveled} of {all} steps"),
        };
        let (place, ranges) = (
            (traveled as f64, 0.0),
            [[FEWEST as f64, all as f64], [0.0; 2]],
        );
        let handle = Handle::new(TRAVELED, "track", "Steps traveled", place, ranges);
        vec![handle.told(told).step([1.0, 0.0], 0)]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
                if let Some(stop) = self.stop {
                    self.go_to(stop as f64);
                }
            }
            Event::HandleMoved { x, .. } | Event::Clicked { x, .. } => self.go_to(*x),
            _ => return Ok(()),
        }
        self.refresh();
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        self.before.error = self.asked.answer().and_then(|answer| answer.error);
    }
}

const CHALLENGES: &[Challenge<ScaleDrift>] = &[
    Challenge {
        id: "unnoticed",
        goal: "Stop on the way where everything comes out one and a half times too large.",
        hint: "Drag the handle below the plot. Does anything on the way tell you?",
        why: "Every step agrees with its neighbors, so no photograph on the way objects to the wrong \
              scale.",
        check: |model| !model.is_home() && (1.45..1.55).contains(&model.before.scale_at_end()),
        solution: || vec![Event::moved(TRAVELED, 40.0, 0.0)],
    },
    Challenge {
        id: "half",
        goal: "Come home with everything half as large as at the start.",
        hint: "The drift can be negative, and it compounds.",
        why: "Scale compounds: less than one percent a step, 80 times over, halves everything.",
        check: |model| model.is_home() && (0.47..0.53).contains(&model.before.scale_at_end()),
        solution: || vec![Event::set(&DRIFT, -0.9)],
    },
    Challenge {
        id: "rigid",
        goal: "Keep the noise, close the loop rigidly, and get the error below 0.1 steps.",
        hint: "Rigid motions are enough where the scale does not drift. What measures it?",
        why: "A stereo rig measures every step in meters, so only place and direction drift, and \
              rigid motions undo that.",
        check: |model| {
            let is_noisy = model.settings.number(&NOISE) >= NOISE.default;
            let error = model.error_after();
            is_noisy && model.kind() == Some(Kind::Rigid) && error.is_some_and(|e| e < 0.1)
        },
        solution: || vec![Event::set(&STEREO, true), Event::set(&CLOSURE, "rigid")],
    },
    Challenge {
        id: "uneven",
        goal: "Find a path that similarities leave off by half a step or more.",
        hint: "The graph spreads evenly what it learns at home. What is not even?",
        why: "One loop tells only the sum of all errors; where on the way each of them happened stays \
              unknown.",
        check: |model| {
            let error = model.error_after();
            model.kind() == Some(Kind::Similarity) && error.is_some_and(|e| e > 0.5)
        },
        solution: || vec![Event::set(&NOISE, 3.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settled;

    fn stop_at(x: f64) -> Event {
        Event::moved(TRAVELED, x, 0.0)
    }

    #[test]
    fn the_default_shows_what_closing_the_loop_repairs() {
        let model: ScaleDrift = settled(&[]);
        let before = &model.before;
        assert!((2.0..2.6).contains(&before.scale_at_end()));
        let (before, after) = (before.error.unwrap(), model.error_after().unwrap());
        assert!(after < 0.1 * before, "{before} to {after}");
    }

    #[test]
    fn rigid_motions_close_the_gap_and_solve_nothing() {
        let model: ScaleDrift = settled(&[Event::set(&CLOSURE, "rigid")]);
        let closed = model.after().unwrap();
        assert!(closed.gap() < 0.1 && closed.scale_at_end() > 2.0);
        assert!(!CHALLENGES.iter().any(|challenge| (challenge.check)(&model)));
    }

    #[test]
    fn an_answer_to_an_older_state_solves_nothing() {
        let mut model: ScaleDrift = settled(&[]);
        let before = model.error_after().unwrap();
        assert!(before < 0.1, "{before}");
        let rigid = Event::set(&CLOSURE, "rigid");
        model.update(&rigid).unwrap();
        assert_eq!(model.error_after(), None);
        assert!(!model.describe().contains("takes the trajectory error"));
        assert!(settled::<ScaleDrift>(&[rigid]).error_after().unwrap() > 0.5);
    }

    #[test]
    fn whoever_is_home_stays_home_when_the_way_becomes_longer() {
        let longer = Event::set(&STEPS, 120.0);
        let model: ScaleDrift = settled(&[stop_at(80.0), longer.clone()]);
        assert_eq!((model.traveled(), model.is_home()), (120, true));
        let model: ScaleDrift = settled(&[stop_at(60.0), longer]);
        assert_eq!((model.traveled(), model.is_home()), (60, false));
        let model: ScaleDrift = settled(&[stop_at(60.0), Event::set(&STEPS, 40.0)]);
        assert_eq!((model.traveled(), model.is_home()), (40, true));
    }

    #[test]
    fn equal_states_say_the_same_whatever_came_before() {
        let there = [Event::set(&DRIFT, -2.0), stop_at(20.0)];
        let back = [Event::set(&DRIFT, 1.0), stop_at(80.0)];
        let model: ScaleDrift = settled(&[there, back].concat());
        let fresh: ScaleDrift = settled(&[]);
        assert_eq!(model.before, fresh.before);
        assert_eq!(model.after(), fresh.after());
        assert_eq!(model.readouts(), fresh.readouts());
    }

    #[test]
    fn the_worst_of_all_drifts_still_gives_numbers() {
        for drift in [DRIFT.min, DRIFT.max] {
            for closure in ["rigid", "similarity"] {
                let model: ScaleDrift = settled(&[
                    Event::set(&DRIFT, drift),
                    Event::set(&NOISE, NOISE.max),
                    Event::set(&STEPS, STEPS.max),
                    Event::set(&CLOSURE, closure),
                ]);
                let closed = model.after().unwrap();
                assert!(closed.scale.iter().all(|scale| scale.is_finite()));
                assert!(closed.gap() < 1.0, "{drift}, {closure}: {}", closed.gap());
            }
        }
    }
}
