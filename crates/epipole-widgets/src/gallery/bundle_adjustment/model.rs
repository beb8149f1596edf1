//! Perturbation of cameras and points, step of the adjustment, and viewpoint.
//!
//! The job returns all steps at once. The number of steps taken is a setting, so a permalink shows
//! the same step.

use super::question::{MAX_STEPS, Question, State};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, ControlKind, Declared, Event, Handle, Knob, Model,
    Problem, Settings, Slider, Space, format_number, knobs,
};
use crate::kit::house::{House, SIZE};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::running::Running;

const LOSS: Choice = Choice::new(
    "loss",
    "Loss",
    &[("squares", "Squares"), ("huber", "Huber, 2 px")],
);
const WRONG: Slider = Slider::new("outliers", "Wrong features")
    .range(0.0, 20.0, 1.0)
    .at(0.0)
    .unit("%");
const DISTURBANCE: Slider = Slider::new("disturbance", "Disturbance")
    .range(0.0, 60.0, 1.0)
    .at(8.0)
    .unit("%");
const DAMPING: Slider = Slider::new("damping", "First log₁₀ λ")
    .range(-6.0, 4.0, 1.0)
    .at(-2.0);
const STEPS: Slider = Slider::new("steps", "Steps taken")
    .range(0.0, MAX_STEPS as f64, 1.0)
    .at(MAX_STEPS as f64);
const NOISE: Slider = Slider::new("noise", "Feature noise")
    .range(0.0, 3.0, 0.25)
    .at(0.5)
    .digits(2)
    .unit("px")
    .more();
const SEED: Slider = Slider::seed(4.0);
const KNOBS: &[Knob] = knobs![LOSS, WRONG, DISTURBANCE, DAMPING, STEPS, NOISE, SEED];

const STEPS_PER_SECOND: f64 = 1.5;
/// The draggable feature.
const MARK: Probe = Probe::new("mark", "photo", "Ridge feature")
    .over(SIZE)
    .step(4.0)
    .digits(1);

/// The model of `bundle-adjustment`.
pub(crate) struct BundleAdjustment {
    settings: Settings,
    pub(super) orbit: Orbit,
    house: Option<House>,
    /// Feature at the end of the ridge in the photograph shown, pixels.
    pub(super) mark: Probe,
    pub(super) asked: Computation<Question>,
    running: Running,
}

impl BundleAdjustment {
    pub(super) fn house(&self) -> Option<&House> {
        self.house.as_ref()
    }

    pub(super) fn is_robust(&self) -> bool {
        self.settings.chosen(&LOSS) == 1
    }

    /// Returns the number of steps shown: the setting, limited to the steps of the answer.
    pub(super) fn num_taken(&self) -> usize {
        let asked = self.settings.count(&STEPS);
        let answer = self.asked.answer();
        answer.map_or(asked, |answer| asked.min(answer.num_steps()))
    }

    /// Returns cameras and points at the start and after the steps taken.
    pub(super) fn states(&self) -> Option<[&State; 2]> {
        let states = &self.asked.answer()?.states;
        Some([states.first()?, states.get(self.num_taken())?])
    }

    pub(super) fn is_finished(&self) -> bool {
        let answer = self.asked.answer();
        answer.is_some_and(|answer| self.num_taken() == answer.num_steps())
    }

    /// Returns the distance of the dragged feature from its true position, pixels.
    pub(super) fn mark_off_px(&self) -> f64 {
        let [(u, v), home] = [self.mark, home(self.house.as_ref())].map(|mark| mark.place());
        libm::hypot(u - home.0, v - home.1)
    }

    fn ask(&mut self) {
        self.asked.ask(Question {
            disturbance: self.settings.number(&DISTURBANCE) / 100.0,
            noise_px: self.settings.number(&NOISE),
            wrong: self.settings.number(&WRONG) / 100.0,
            mark: self.mark.place(),
            is_robust: self.is_robust(),
            log_damping: self.settings.number(&DAMPING),
            seed: self.settings.count(&SEED) as u64,
        });
    }

    fn go_to(&mut self, steps: usize) {
        self.settings.slide(&STEPS, steps as f64);
        self.running.stop_if(self.is_finished());
    }
}

/// Returns the dragged feature at its true position.
fn home(house: Option<&House>) -> Probe {
    let mut mark = MARK;
    if let Some(pixel) = house.map(House::mark) {
        mark.put(pixel.x, pixel.y);
    }
    mark
}

impl Declared for BundleAdjustment {
    const NAME: &'static str = "bundle-adjustment";
    const TITLE: &'static str = "Everything moves at once";
    const HELP: &'static str = "Press Run, or take the steps one by one; a click on a curve goes to \
        that step. Drag the marked feature in the photograph, or move it with the arrow keys. Drag \
        in the view of space to look from elsewhere; with Shift, or the small cross, the scene \
        moves; with Ctrl and the wheel, or + and −, it becomes larger.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        // Built from constants, so it cannot fail; a test confirms it.
        let house = House::new().ok();
        let mut model = Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-9.0, 34.0),
            mark: home(house.as_ref()),
            house,
            asked: Computation::default(),
            running: Running::at(STEPS_PER_SECOND),
        };
        model.ask();
        model
    }
}

impl Model for BundleAdjustment {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        if let Some(answer) = self.asked.answer() {
            for control in controls.iter_mut().filter(|control| control.id == STEPS.id) {
                control.value_text = format!("{} of {}", self.num_taken(), answer.num_steps());
                // The slider ends at the last step of the loop.
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
        let (can_run, taken) = (self.asked.answer().is_some(), self.num_taken());
        controls.extend(self.running.controls(can_run, taken, self.is_finished()));
        controls.extend(self.orbit.controls());
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let off = format_number(self.mark_off_px(), 0);
        let told = format!("{}, {off} px from where it belongs", self.mark.text());
        let mut handles = vec![self.mark.handle().told(told)];
        handles.extend(self.orbit.handles());
        handles
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
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
            _ if self.mark.update(event) => self.ask(),
            Event::Clicked { panel, x, .. } if panel == "cost" || panel == "damping" => {
                self.running.stop();
                self.go_to(x.round().max(0.0) as usize);
            }
            _ => {
                let (taken, finished) = (self.num_taken(), self.is_finished());
                if let Some(steps) = self.running.update(event, taken, finished) {
                    self.go_to(steps);
                }
            }
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.running.is_running()
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        self.running.stop_if(self.is_finished());
    }
}

const CHALLENGES: &[Challenge<BundleAdjustment>] = &[
    Challenge {
        id: "liar",
        goal: "Drag the marked feature 60 px away, and keep the house within half a percent.",
        hint: "Which loss lets one bad feature pull harder than all the others?",
        why: "Huber's loss grows only linearly beyond 2 px, so a wrong feature pulls no harder than one \
              that is off by 2 px.",
        check: |model| {
            let states = model.states();
            model.mark_off_px() >= 60.0
                && model.is_finished()
                && !model.asked.is_waiting()
                && states.is_some_and(|[_, now]| now.off < 0.005)
        },
        solution: || {
            vec![
                Event::moved(MARK.id(), 560.0, 60.0),
                Event::set(&LOSS, "huber"),
            ]
        },
    },
    Challenge {
        id: "too-many",
        goal: "Find out how many wrong features it takes to push the house off by 5% despite Huber's loss.",
        hint: "Each still pulls with a constant force, wherever it is.",
        why: "Huber's loss weakens wrong features but never drops them; enough of them still bend the \
              house. That is why RANSAC comes first.",
        check: |model| {
            let states = model.states();
            model.is_robust()
                && model.is_finished()
                && !model.asked.is_waiting()
                && model.mark_off_px() < 60.0
                && model.settings.number(&DISTURBANCE) <= DISTURBANCE.default
                && states.is_some_and(|[_, now]| now.off >= 0.05)
        },
        solution: || vec![Event::set(&LOSS, "huber"), Event::set(&WRONG, 20.0)],
    },
    Challenge {
        id: "refused",
        goal: "Find a start from which a step is refused.",
        hint: "Far from the solution, and with hardly any brake.",
        why: "Far away the linear model is wrong, so its full step can raise the cost; then λ rises \
              until a step goes downhill.",
        check: |model| {
            let answer = model.asked.answer();
            answer.is_some_and(|answer| answer.states.iter().any(|state| !state.accepted))
        },
        solution: || vec![Event::set(&DISTURBANCE, 50.0), Event::set(&DAMPING, -6.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    #[test]
    fn one_bad_feature_pulls_on_squares_and_not_on_huber() {
        let drag = Event::moved(MARK.id(), 620.0, 20.0);
        let robust = Event::set(&LOSS, "huber");
        let off = |model: &BundleAdjustment| model.states().unwrap()[1].off;
        let (honest, pulled) = (settled(&[]), settled(std::slice::from_ref(&drag)));
        let huber = settled(&[drag, robust]);
        assert!(off(&pulled) > 5.0 * off(&honest), "{}", off(&pulled));
        assert!(off(&huber) < 1.2 * off(&honest), "{}", off(&huber));
    }

    #[test]
    fn some_wrong_features_spoil_squares_and_not_huber() {
        let wrong = Event::set(&WRONG, 5.0);
        let off = |model: &BundleAdjustment| model.states().unwrap()[1].off;
        let squares = settled(std::slice::from_ref(&wrong));
        let huber = settled(&[wrong, Event::set(&LOSS, "huber")]);
        assert!(off(&squares) > 0.05, "{}", off(&squares));
        assert!(off(&huber) < 0.005, "{}", off(&huber));
    }

    #[test]
    fn a_tight_brake_is_slow_and_solves_nothing() {
        let model: BundleAdjustment =
            settled(&[Event::set(&DAMPING, 3.0), Event::set(&STEPS, 6.0)]);
        assert!(model.states().unwrap()[1].off > 0.03);
        assert!(!CHALLENGES.iter().any(|challenge| (challenge.check)(&model)));
    }

    #[test]
    fn without_noise_every_seed_finds_the_house_exactly() {
        for seed in 1..=20 {
            let model: BundleAdjustment =
                settled(&[Event::set(&NOISE, 0.0), Event::set(&SEED, f64::from(seed))]);
            let [start, now] = model.states().unwrap();
            assert!(start.rms_px > 10.0 && start.off > 0.03, "seed {seed}");
            // The dragged feature is rounded to a tenth of a pixel.
            assert!(now.rms_px < 0.01, "seed {seed}: {} px", now.rms_px);
            assert!(now.off < 1e-4, "seed {seed}: {}", now.off);
        }
    }

    #[test]
    fn the_error_that_remains_is_the_noise_that_no_unknown_can_take_up() {
        let mut sum = 0.0;
        for seed in 1..=20 {
            let model: BundleAdjustment =
                settled(&[Event::set(&NOISE, 1.0), Event::set(&SEED, f64::from(seed))]);
            let rms_px = model.states().unwrap()[1].rms_px;
            sum += rms_px * rms_px;
        }
        let model: BundleAdjustment = settled(&[]);
        let answer = model.asked.answer().unwrap();
        let num_points = answer.features.len();
        // One feature is free of noise; the seven gauge freedoms have no effect.
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
        let model: BundleAdjustment =
            settled(&[Event::set(&DISTURBANCE, 50.0), Event::set(&DAMPING, -6.0)]);
        let states = &model.asked.answer().unwrap().states;
        assert!(states.iter().any(|state| !state.accepted));
        for pair in states.windows(2) {
            assert_eq!(pair[1].accepted, pair[1].cost < pair[0].cost);
            assert_eq!(pair[1].accepted, pair[1].points != pair[0].points);
        }
    }
}
