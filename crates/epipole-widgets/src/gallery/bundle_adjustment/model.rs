//! How cameras and points are disturbed, which step of the adjustment is shown, and where it is
//! seen from.
//!
//! The job answers with all steps at once. How many of them have been taken is part of the
//! settings, so a permalink shows the same one.

use super::answer::{Answer, Request, State};
use super::knobs::{DAMPING, DISTURBANCE, KNOBS, LOSS, NOISE, SEED, STEPS};
use super::run::{self, MAX_STEPS};
use super::scene::{SIZE, Scene};
use super::words;
use crate::contract::{
    Challenge, Control, ControlKind, Event, Handle, Job, JobResult, Model, Problem, Progress,
    Readout, Settings, Space, Value, format_number, round_to_digits,
};
use crate::orbit::{Orbit, RECENTER, SPACE, ZOOM};
use crate::running::Running;

const STEPS_PER_SECOND: f64 = 1.5;
/// The dragged feature's place is kept to a tenth of a pixel.
const DIGITS: usize = 1;
/// What a feature is called that the reader drags.
const MARK: &str = "mark";

/// The model of `bundle-adjustment`.
pub(crate) struct BundleAdjustment {
    settings: Settings,
    orbit: Orbit,
    scene: Option<Scene>,
    /// Where the end of the ridge is seen, in the photograph that is shown, pixels.
    mark: (f64, f64),
    answer: Option<Answer>,
    pending: Option<Job>,
    problem: Option<String>,
    running: Running,
}

impl BundleAdjustment {
    pub(super) fn scene(&self) -> Option<&Scene> {
        self.scene.as_ref()
    }

    pub(super) fn answer(&self) -> Option<&Answer> {
        self.answer.as_ref()
    }

    pub(super) fn orbit(&self) -> &Orbit {
        &self.orbit
    }

    pub(super) fn zoom(&self) -> f64 {
        self.settings.number(&ZOOM)
    }

    pub(super) fn mark(&self) -> (f64, f64) {
        self.mark
    }

    pub(super) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    pub(super) fn is_robust(&self) -> bool {
        self.settings.chosen(&LOSS) == 1
    }

    /// Steps that are shown: those asked for, or as many as there are.
    pub(super) fn num_taken(&self) -> usize {
        let asked = self.settings.count(&STEPS);
        self.answer
            .as_ref()
            .map_or(asked, |answer| asked.min(answer.num_steps()))
    }

    /// Cameras and points at the start and after the steps that were taken.
    pub(super) fn states(&self) -> Option<[&State; 2]> {
        let states = &self.answer.as_ref()?.states;
        Some([states.first()?, states.get(self.num_taken())?])
    }

    pub(super) fn is_finished(&self) -> bool {
        let answer = self.answer.as_ref();
        answer.is_some_and(|answer| self.num_taken() == answer.num_steps())
    }

    /// How far the dragged feature is from where it belongs, pixels.
    pub(super) fn mark_off_px(&self) -> f64 {
        let at_home = home(self.scene.as_ref());
        libm::hypot(self.mark.0 - at_home.0, self.mark.1 - at_home.1)
    }

    fn ask(&mut self) {
        let request = Request {
            disturbance: self.settings.number(&DISTURBANCE) / 100.0,
            noise_px: self.settings.number(&NOISE),
            mark: self.mark.into(),
            huber: self.is_robust(),
            log_damping: self.settings.number(&DAMPING),
            seed: self.settings.count(&SEED) as u64,
        };
        self.problem = None;
        self.pending = Some(Job {
            label: words::WAITING,
            request: request.to_bytes(),
        });
    }

    fn go_to(&mut self, steps: usize) -> Result<(), Problem> {
        let value = Value::Number(steps.min(MAX_STEPS) as f64);
        self.settings.set(STEPS.id, &value)?;
        self.running.stop_if(self.is_finished());
        Ok(())
    }
}

/// Where the dragged feature belongs, pixels.
fn home(scene: Option<&Scene>) -> (f64, f64) {
    let keep = |value| round_to_digits(value, DIGITS);
    scene.map_or((0.0, 0.0), |scene| {
        let pixel = scene.mark();
        (keep(pixel.x), keep(pixel.y))
    })
}

impl Model for BundleAdjustment {
    const NAME: &'static str = "bundle-adjustment";
    const TITLE: &'static str = "Everything moves at once";
    const HELP: &'static str = "Press Run, or take the steps one by one. Drag the marked feature in \
        the photograph, or move it with the arrow keys, and see who believes it. Drag in the upper \
        picture to look from elsewhere; with Shift, or the small cross, the scene moves; with Ctrl \
        and the wheel, or + and −, it becomes larger. A click on a curve goes to that step.";

    fn new() -> Self {
        // The scene is one of constants, which a test builds.
        let scene = Scene::new().ok();
        let mut model = Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-9.0, 34.0),
            mark: home(scene.as_ref()),
            scene,
            answer: None,
            pending: None,
            problem: None,
            running: Running::at(STEPS_PER_SECOND),
        };
        model.ask();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        if let Some(answer) = &self.answer {
            for control in controls.iter_mut().filter(|control| control.id == STEPS.id) {
                control.value_text = format!("{} of {}", self.num_taken(), answer.num_steps());
                // The slider ends where the loop has ended.
                let end = answer.num_steps().max(1) as f64;
                if let ControlKind::Slider {
                    value,
                    max,
                    default,
                    ..
                } = &mut control.kind
                {
                    *max = end;
                    *value = value.min(end);
                    *default = default.min(end);
                }
            }
        }
        let (can_run, taken) = (self.answer.is_some(), self.num_taken());
        controls.extend(self.running.controls(can_run, taken, self.is_finished()));
        controls.push(RECENTER.control(true, false));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let (u, v) = self.mark;
        let mut handles = vec![Handle {
            id: MARK.to_owned(),
            panel: "photo",
            label: "Feature at the end of the ridge".to_owned(),
            value_text: format!(
                "column {}, row {}, {} px from where it belongs",
                format_number(u, 0),
                format_number(v, 0),
                format_number(self.mark_off_px(), 0)
            ),
            x: u,
            y: v,
            x_range: [0.0, f64::from(SIZE.0 - 1)],
            y_range: [0.0, f64::from(SIZE.1 - 1)],
            step: [4.0, 4.0],
            digits: DIGITS,
            removable: false,
        }];
        handles.extend(self.orbit.handles());
        handles
    }

    fn spaces(&self) -> &'static [Space] {
        &[SPACE]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event, &mut self.settings)? {
            return Ok(());
        }
        match event {
            Event::Set { id, value } => {
                let changed = self.settings.set(id, value)? == Some(true);
                if id == STEPS.id {
                    self.running.stop();
                } else if changed {
                    self.ask();
                }
            }
            Event::HandleMoved { id, x, y } if id == MARK && self.mark != (*x, *y) => {
                self.mark = (*x, *y);
                self.ask();
            }
            Event::Clicked { panel, x, .. } if panel == "cost" || panel == "damping" => {
                self.running.stop();
                self.go_to(x.round().max(0.0) as usize)?;
            }
            Event::Press { id } => {
                let (taken, finished) = (self.num_taken(), self.is_finished());
                if let Some(steps) = self.running.press(id, taken, finished) {
                    self.go_to(steps)?;
                }
            }
            Event::Tick { dt_s } => {
                if let Some(steps) = self.running.tick(*dt_s, self.num_taken()) {
                    self.go_to(steps)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.running.is_running()
    }

    fn job(&self) -> Option<Job> {
        self.pending.clone()
    }

    fn compute(request: &[u8], progress: Progress<'_>) -> JobResult {
        run::compute(request, progress)
    }

    fn job_done(&mut self, result: JobResult) {
        self.pending = None;
        let scene = self.scene.as_ref();
        match result.map(|bytes| Answer::from_bytes(&bytes, scene?)) {
            Ok(Some(answer)) => self.answer = Some(answer),
            Ok(None) => self.problem = Some(words::NO_ANSWER.to_owned()),
            Err(problem) => self.problem = Some(format!("No adjustment: {problem}.")),
        }
        self.running.stop_if(self.is_finished());
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
                id: "liar",
                goal: "Drag the marked feature at least 60 px away, and get the house right within \
                       half a percent all the same.",
                hint: "Who lets one bad feature pull harder than all others?",
                check: |model| {
                    let states = model.states();
                    model.mark_off_px() >= 60.0
                        && model.is_finished()
                        && states.is_some_and(|[_, now]| now.off < 0.005)
                },
                solution: || {
                    vec![
                        Event::HandleMoved {
                            id: MARK.to_owned(),
                            x: 560.0,
                            y: 60.0,
                        },
                        Event::Set {
                            id: LOSS.id.to_owned(),
                            value: Value::from("huber"),
                        },
                    ]
                },
            },
            Challenge {
                id: "refused",
                goal: "Find a start from which a step is refused.",
                hint: "Far from the solution, and hardly any brake.",
                check: |model| {
                    let answer = model.answer.as_ref();
                    answer.is_some_and(|answer| answer.states.iter().any(|state| !state.accepted))
                },
                solution: || {
                    vec![
                        Event::Set {
                            id: DISTURBANCE.id.to_owned(),
                            value: Value::Number(50.0),
                        },
                        Event::Set {
                            id: DAMPING.id.to_owned(),
                            value: Value::Number(-6.0),
                        },
                    ]
                },
            },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    fn settled(events: &[Event]) -> BundleAdjustment {
        let mut model = BundleAdjustment::new();
        for event in events {
            model.update(event).unwrap();
        }
        if let Some(job) = model.job() {
            let result = run::compute(&job.request, &mut |_| ControlFlow::Continue(()));
            model.job_done(result);
        }
        model
    }

    fn set(id: &str, value: f64) -> Event {
        Event::Set {
            id: id.to_owned(),
            value: Value::Number(value),
        }
    }

    #[test]
    fn one_bad_feature_pulls_on_squares_and_not_on_huber() {
        let drag = Event::HandleMoved {
            id: MARK.to_owned(),
            x: 620.0,
            y: 20.0,
        };
        let robust = Event::Set {
            id: LOSS.id.to_owned(),
            value: Value::from("huber"),
        };
        let off = |model: &BundleAdjustment| model.states().unwrap()[1].off;
        let (honest, pulled) = (settled(&[]), settled(std::slice::from_ref(&drag)));
        let huber = settled(&[drag, robust]);
        assert!(off(&pulled) > 5.0 * off(&honest), "{}", off(&pulled));
        assert!(off(&huber) < 1.2 * off(&honest), "{}", off(&huber));
    }

    #[test]
    fn without_noise_every_seed_finds_the_house_exactly() {
        for seed in 1..=20 {
            let model = settled(&[set("noise", 0.0), set("seed", f64::from(seed))]);
            let [start, now] = model.states().unwrap();
            assert!(start.rms_px > 10.0 && start.off > 0.03, "seed {seed}");
            // The dragged feature is kept to a tenth of a pixel.
            assert!(now.rms_px < 0.01, "seed {seed}: {} px", now.rms_px);
            assert!(now.off < 1e-4, "seed {seed}: {}", now.off);
        }
    }

    #[test]
    fn the_error_that_remains_is_the_noise_that_no_unknown_can_take_up() {
        let mut sum = 0.0;
        for seed in 1..=20 {
            let model = settled(&[set("noise", 1.0), set("seed", f64::from(seed))]);
            let rms_px = model.states().unwrap()[1].rms_px;
            sum += rms_px * rms_px;
        }
        let answer = settled(&[]).answer.unwrap();
        let num_points = answer.features.len();
        // One feature has no noise; seven freedoms change nothing.
        let freedoms = 6.0 * 4.0 + 3.0 * num_points as f64 - 7.0;
        let numbers = 2.0 * answer.num_observations as f64;
        let expected = 2.0 * (numbers - 2.0 - freedoms) / numbers;
        assert!(
            (sum / 20.0 / expected - 1.0).abs() < 0.1,
            "{} {expected}",
            sum / 20.0
        );
    }

    #[test]
    fn the_cost_falls_with_every_step_that_is_kept_and_stays_otherwise() {
        let model = settled(&[set("disturbance", 50.0), set("damping", -6.0)]);
        let states = &model.answer.as_ref().unwrap().states;
        assert!(states.iter().any(|state| !state.accepted));
        for pair in states.windows(2) {
            assert_eq!(pair[1].accepted, pair[1].cost < pair[0].cost);
            assert_eq!(pair[1].accepted, pair[1].points != pair[0].points);
        }
    }
}
