//! A drive around a block: how its scale drifts, how far it has come, and how its loop is closed.

use super::answer::Answer;
use super::closing::Kind;
use super::drive::Errors;
use super::knobs::{CLOSURE, DRIFT, KNOBS, NOISE, SEED, STEPS, STEREO};
use super::request::{self, Request};
use super::words;
use crate::contract::{
    Challenge, Control, Event, Handle, Job, JobResult, Model, Problem, Progress, Readout, Settings,
    Value,
};

/// The fewest steps that can be looked at.
const FEWEST: usize = 2;

/// The model of `scale-drift`.
pub(crate) struct ScaleDrift {
    settings: Settings,
    /// Steps that the reader has gone back to; `None` all the way home, however long that is.
    stop: Option<usize>,
    answer: Answer,
    pending: Option<Job>,
}

impl ScaleDrift {
    /// What follows from the state. While the job is out, errors and the closed path are the last.
    pub(super) fn answer(&self) -> &Answer {
        &self.answer
    }

    /// Whether the job is out.
    pub(super) fn is_waiting(&self) -> bool {
        self.pending.is_some()
    }

    /// Drives anew, and asks for the path to be judged and its loop to be closed.
    fn refresh(&mut self) {
        let errors = errors_of(&self.settings);
        let (num_steps, traveled) = (self.num_steps(), self.traveled());
        let last = Answer::open(num_steps, traveled, &errors);
        let last = std::mem::replace(&mut self.answer, last);
        self.answer.before.error = last.before.error;
        if self.is_home() {
            self.answer.seen = last.seen;
            self.answer.after = last.after.filter(|_| self.kind().is_some());
        }
        let request = Request {
            num_steps,
            traveled,
            errors,
            kind: self.kind(),
        };
        self.pending = Some(request.job());
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

    /// How the loop is to be closed, if at all.
    pub(super) fn kind(&self) -> Option<Kind> {
        [None, Some(Kind::Rigid), Some(Kind::Similarity)][self.settings.chosen(&CLOSURE)]
    }

    /// The trajectory error of the closed path, once it is that of this state.
    fn error_after(&self) -> Option<f64> {
        if self.is_waiting() {
            return None;
        }
        let after = self.answer().after.as_ref()?;
        after.as_ref().ok()?.error
    }

    fn go_to(&mut self, step: f64) {
        let step = step.max(FEWEST as f64).round() as usize;
        self.stop = (step < self.num_steps()).then_some(step);
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

impl Model for ScaleDrift {
    const NAME: &'static str = "scale-drift";
    const TITLE: &'static str = "Coming home with the wrong scale";
    const HELP: &'static str = "Change how much the scale drifts, and how the loop is closed. Drag the \
        handle below the plot back and forth to drive around the block.";

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        let num_steps = settings.count(&STEPS);
        let mut model = Self {
            answer: Answer::open(num_steps, num_steps, &errors_of(&settings)),
            settings,
            stop: None,
            pending: None,
        };
        model.refresh();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        for control in &mut controls {
            // A rig that measures the scale has none that drifts.
            control.enabled = control.id != DRIFT.id || !self.is_metric();
        }
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let (traveled, all) = (self.traveled(), self.num_steps());
        vec![Handle {
            id: "traveled".to_owned(),
            panel: "track",
            label: "Steps traveled".to_owned(),
            value_text: match self.is_home() {
                true => format!("all {all} steps, home again"),
                false => format!("{traveled} of {all} steps"),
            },
            x: traveled as f64,
            y: 0.0,
            x_range: [FEWEST as f64, all as f64],
            y_range: [0.0, 0.0],
            step: [1.0, 0.0],
            digits: 0,
            removable: false,
        }]
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

    fn job(&self) -> Option<Job> {
        self.pending.clone()
    }

    fn compute(request: &[u8], _: Progress<'_>) -> JobResult {
        request::compute(request)
    }

    fn job_done(&mut self, result: JobResult) {
        self.pending = None;
        match result.map(|bytes| request::read(&bytes)) {
            Ok(Some(told)) => self.answer.take(&told),
            Ok(None) => self.answer.after = Some(Err(words::NO_ANSWER.to_owned())),
            Err(problem) => {
                self.answer.after = Some(Err(format!("The path cannot be judged: {problem}.")));
            }
        }
    }

    fn readouts(&self) -> Vec<Readout> {
        words::readouts(self)
    }

    fn describe(&self) -> String {
        words::describe(self)
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "unnoticed",
                goal: "Stop on the way where everything comes out one and a half times as large.",
                hint: "Drag the handle below the plot. Does anything on the way tell you?",
                check: |model| {
                    let scale = model.answer().before.scale_at_end();
                    !model.is_home() && (1.45..1.55).contains(&scale)
                },
                solution: || {
                    vec![Event::HandleMoved {
                        id: "traveled".to_owned(),
                        x: 40.0,
                        y: 0.0,
                    }]
                },
            },
            Challenge {
                id: "half",
                goal: "Come home with everything half as large as at the start.",
                hint: "The drift can be negative.",
                check: |model| {
                    let scale = model.answer().before.scale_at_end();
                    model.is_home() && (0.47..0.53).contains(&scale)
                },
                solution: || vec![set(DRIFT.id, Value::Number(-0.9))],
            },
            Challenge {
                id: "rigid",
                goal: "Leave the noise, close the loop with rigid motions, and bring the trajectory \
                    error below a tenth of a step.",
                hint: "Rigid motions suffice where nothing drifts in scale. Who measures the scale?",
                check: |model| {
                    let is_noisy = model.settings.number(&NOISE) >= NOISE.default;
                    let error = model.error_after();
                    is_noisy && model.kind() == Some(Kind::Rigid) && error.is_some_and(|e| e < 0.1)
                },
                solution: || {
                    vec![
                        set(STEREO.id, Value::Flag(true)),
                        set(CLOSURE.id, Value::from("rigid")),
                    ]
                },
            },
            Challenge {
                id: "uneven",
                goal: "Similarities undo a drift that is the same in every step. Find a path that they \
                    leave off by half a step or more.",
                hint: "The graph spreads what it learns at home evenly over the way. What is not even?",
                check: |model| {
                    let error = model.error_after();
                    model.kind() == Some(Kind::Similarity) && error.is_some_and(|e| e > 0.5)
                },
                solution: || vec![set(NOISE.id, Value::Number(3.0))],
            },
        ]
    }
}

fn set(id: &str, value: Value) -> Event {
    Event::Set {
        id: id.to_owned(),
        value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    fn after(events: &[Event]) -> ScaleDrift {
        let mut model = ScaleDrift::new();
        for event in events {
            model.update(event).unwrap();
        }
        if let Some(job) = model.job() {
            let result = ScaleDrift::compute(&job.request, &mut |_| ControlFlow::Continue(()));
            model.job_done(result);
        }
        model
    }

    fn stop_at(x: f64) -> Event {
        let id = "traveled".to_owned();
        Event::HandleMoved { id, x, y: 0.0 }
    }

    #[test]
    fn the_default_shows_what_closing_the_loop_repairs() {
        let model = after(&[]);
        let before = &model.answer().before;
        assert!((2.0..2.6).contains(&before.scale_at_end()));
        let (before, after) = (before.error.unwrap(), model.error_after().unwrap());
        assert!(after < 0.1 * before, "{before} to {after}");
    }

    #[test]
    fn an_answer_to_an_older_state_solves_nothing() {
        let mut model = after(&[]);
        let before = model.error_after().unwrap();
        assert!(before < 0.1, "{before}");
        let rigid = set(CLOSURE.id, Value::from("rigid"));
        model.update(&rigid).unwrap();
        assert_eq!(model.error_after(), None);
        assert!(!model.describe().contains("takes the trajectory error"));
        assert!(after(&[rigid]).error_after().unwrap() > 0.5);
    }

    #[test]
    fn whoever_is_home_stays_home_when_the_way_becomes_longer() {
        let longer = set(STEPS.id, Value::Number(120.0));
        let model = after(&[stop_at(80.0), longer.clone()]);
        assert_eq!((model.traveled(), model.is_home()), (120, true));
        let model = after(&[stop_at(60.0), longer]);
        assert_eq!((model.traveled(), model.is_home()), (60, false));
        let model = after(&[stop_at(60.0), set(STEPS.id, Value::Number(40.0))]);
        assert_eq!((model.traveled(), model.is_home()), (40, true));
    }

    #[test]
    fn equal_states_say_the_same_whatever_came_before() {
        let there = [set(DRIFT.id, Value::Number(-2.0)), stop_at(20.0)];
        let back = [set(DRIFT.id, Value::Number(1.0)), stop_at(80.0)];
        let model = after(&[there, back].concat());
        let fresh = after(&[]);
        assert_eq!(model.answer(), fresh.answer());
        assert_eq!(model.readouts(), fresh.readouts());
    }

    #[test]
    fn the_worst_of_all_drifts_still_gives_numbers() {
        for drift in [DRIFT.min, DRIFT.max] {
            for closure in ["rigid", "similarity"] {
                let model = after(&[
                    set(DRIFT.id, Value::Number(drift)),
                    set(NOISE.id, Value::Number(NOISE.max)),
                    set(STEPS.id, Value::Number(STEPS.max)),
                    set(CLOSURE.id, Value::from(closure)),
                ]);
                let closed = model.answer().after.as_ref().unwrap().as_ref().unwrap();
                assert!(closed.scale.iter().all(|scale| scale.is_finite()));
                assert!(closed.gap() < 1.0, "{drift}, {closure}: {}", closed.gap());
            }
        }
    }
}
