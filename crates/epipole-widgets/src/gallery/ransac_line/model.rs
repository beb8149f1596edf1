//! Points near a hidden line among outliers, and the RANSAC loop one sample at a time.

use super::question::{MAX_SAMPLES, Question, Runs, kind};
use crate::contract::{
    Asking, Challenge, Compute, Control, Data, Datum, Declared, Event, Knob, Model, Problem,
    Settings, Slider, Toggle, knobs,
};
use crate::kit::line_points::{COUNT, EPSILON, Scatter, angle_between_deg};
use crate::kit::question::{Computation, carry_out};
use crate::kit::running::Running;
use crate::kit::samples::Rules;
use crate::kit::tally::Tally;

const OUTLIERS: Slider = Slider::new("outliers", "Outlier ratio")
    .range(0.0, 0.8, 0.05)
    .at(0.5)
    .digits(2);
const MSAC: Toggle = Toggle::new("msac", "MSAC");
const LOCAL: Toggle = Toggle::new("local", "Local optimization");
const SEED: Slider = Slider::seed(9.0);
const ITERATIONS: Slider = Slider::new("iterations", "Samples drawn")
    .range(0.0, MAX_SAMPLES as f64, 1.0)
    .at(7.0)
    .hidden();
/// Phase of the last sample's animation, 0 to 1: sample drawn, band shown, votes cast.
const PHASE: Slider = Slider::new("phase", "Votes cast")
    .range(0.0, 1.0, 0.005)
    .at(1.0)
    .digits(3)
    .hidden();
const KNOBS: &[Knob] = knobs![
    OUTLIERS, EPSILON, MSAC, LOCAL, COUNT, SEED, ITERATIONS, PHASE
];

/// Initial pace of the animation, slow enough to follow the votes; it increases with each sample.
const SAMPLES_PER_SECOND: f64 = 0.7;
const FASTER: f64 = 1.25;
const MOST_PER_SECOND: f64 = 15.0;

/// The model of `ransac-line`.
pub(crate) struct RansacLine {
    settings: Settings,
    pub(super) scattered: Scatter,
    tally: Result<Tally, String>,
    pub(super) asked: Computation<Question>,
    running: Running,
    /// Number of samples when it last started to run.
    run_from: usize,
}

impl RansacLine {
    /// Returns the samples so far, or a message why there are none.
    pub(super) fn tally(&self) -> Result<&Tally, &str> {
        self.tally.as_ref().map_err(String::as_str)
    }

    /// Returns the hundred runs of each kind, possibly for earlier settings.
    pub(super) fn runs(&self) -> Option<&Runs> {
        self.asked.answer()
    }

    pub(super) fn epsilon_px(&self) -> f64 {
        self.settings.number(&EPSILON)
    }

    pub(super) fn phase(&self) -> f64 {
        self.settings.number(&PHASE)
    }

    /// Returns the kind of run that the toggles select.
    pub(super) fn kind(&self) -> usize {
        kind(self.settings.flag(&MSAC), self.settings.flag(&LOCAL))
    }

    /// Returns the angle between the best line and the hidden one, degrees.
    pub(super) fn error_deg(&self) -> Option<f64> {
        let best = self.tally.as_ref().ok()?.best.as_ref()?;
        Some(angle_between_deg(&best.line, &self.scattered.truth))
    }

    /// Returns whether the loop has ended and its last sample has been shown.
    pub(super) fn is_decided(&self) -> bool {
        self.drawn().1 && self.phase() >= 1.0
    }

    fn samples_per_second(&self) -> f64 {
        let since = self.drawn().0.saturating_sub(self.run_from + 1);
        (0..since).fold(SAMPLES_PER_SECOND, |pace, _| {
            (pace * FASTER).min(MOST_PER_SECOND)
        })
    }

    fn drawn(&self) -> (usize, bool) {
        let tally = self.tally.as_ref();
        tally.map_or((0, true), |tally| {
            (tally.samples.count(), tally.samples.is_finished())
        })
    }

    fn compute(&mut self) {
        let rules = Rules {
            epsilon_px: self.epsilon_px(),
            seed: self.settings.count(&SEED) as u64,
            max_samples: MAX_SAMPLES,
            msac: self.settings.flag(&MSAC),
            local_optimization: self.settings.flag(&LOCAL),
        };
        let count = self.settings.count(&ITERATIONS);
        let tally = Tally::new(&self.scattered.points, self.scattered.truth, rules, count);
        self.tally = tally.map_err(|error| format!("There are no samples: {error}."));
        self.asked.ask(Question {
            outlier_ratio: self.settings.number(&OUTLIERS),
            epsilon_px: self.epsilon_px(),
            count: self.settings.count(&COUNT),
        });
    }

    /// Draws until there are `count` samples, the last one in this phase.
    fn run_to(&mut self, count: usize, phase: f64) {
        self.settings.slide(&ITERATIONS, count as f64);
        self.settings.slide(&PHASE, phase);
        self.compute();
        self.running.stop_if(self.drawn().1);
    }
}

impl Declared for RansacLine {
    const NAME: &'static str = "ransac-line";
    const TITLE: &'static str = "Sample, band, votes";
    const HELP: &'static str = "Step draws two points, lays a band around their line, and counts the points \
        in it; Run does so again and again. Switch MSAC and local optimization on to see what they change \
        over a hundred runs.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        let mut model = Self {
            scattered: Scatter::by(&settings, &SEED, &OUTLIERS),
            settings,
            tally: Err(String::new()),
            asked: Computation::default(),
            running: Running::at(SAMPLES_PER_SECOND),
            run_from: 0,
        };
        model.compute();
        model
    }
}

impl Model for RansacLine {
    fn data(&self) -> Data {
        Data::from([
            ("points", Datum::points(&self.scattered.points)),
            ("thresholdPx", Datum::Number(self.epsilon_px())),
        ])
    }

    fn controls(&self) -> Vec<Control> {
        let (drawn, is_finished) = self.drawn();
        let running = (self.running).controls(self.tally.is_ok(), drawn, is_finished);
        self.settings.controls_and(running)
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let (drawn, is_finished) = self.drawn();
        match event {
            Event::Tick { dt_s } => {
                let phase = (self.phase() + dt_s * self.samples_per_second()).min(1.0);
                if phase < 1.0 {
                    self.settings.slide(&PHASE, phase);
                } else if self.running.is_running() && !is_finished {
                    self.run_to(drawn + 1, 0.0);
                } else {
                    self.settings.slide(&PHASE, 1.0);
                }
            }
            Event::Press { .. } => {
                let was_running = self.running.is_running();
                let next = self.running.update(event, drawn, is_finished);
                let from = next.unwrap_or(drawn);
                match self.running.is_running() && !was_running {
                    // The first sample starts immediately.
                    true => {
                        self.run_from = from;
                        self.run_to(from + 1, 0.0);
                    }
                    // After a step or a stop, the sample is shown complete, without its animation.
                    false => self.run_to(from, 1.0),
                }
            }
            Event::Set { id, value } => {
                if self.settings.set(id, value)? != Some(true) || id == PHASE.id {
                    return Ok(());
                }
                if [OUTLIERS.id, COUNT.id, SEED.id].contains(&&**id) {
                    self.scattered = Scatter::by(&self.settings, &SEED, &OUTLIERS);
                }
                self.compute();
                self.running.stop_if(self.drawn().1);
            }
            _ => {}
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.running.is_running() || self.phase() < 1.0
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<RansacLine>] = &[
    Challenge {
        id: "narrow",
        goal: "With half of the points outliers, make the loop need more than 60 samples.",
        hint: "Good points are lost, too, if the band is too narrow for their noise.",
        why: "The points scatter by 4 px, so a band of 2 px to each side loses more than half of the good \
              ones, and the loop takes them for outliers.",
        check: |model| {
            let tally = model.tally().ok();
            let budget = tally.and_then(|tally| tally.samples.drawn().budget);
            let half = (model.settings.number(&OUTLIERS) - 0.5).abs() < 1e-9;
            half && model.drawn().1 && budget.is_some_and(|budget| budget > 60)
        },
        solution: || {
            vec![
                Event::set(&EPSILON, 2.0),
                Event::set(&ITERATIONS, MAX_SAMPLES as f64),
            ]
        },
    },
    Challenge {
        id: "outvoted",
        goal: "Let a wrong line, more than 10° off, win with more votes than the hidden one.",
        hint: "Half of the outliers lie in one region. When do they agree?",
        why: "A wide band and many outliers: a line through the crowded region gathers more points than \
              the hidden one, and RANSAC returns what has most votes.",
        check: |model| {
            let Ok(tally) = model.tally() else {
                return false;
            };
            let votes = tally.best.as_ref().map_or(0, |best| best.num_votes());
            model.drawn().1
                && model.error_deg().is_some_and(|error| error > 10.0)
                && votes >= tally.truth.num_votes()
        },
        solution: || {
            vec![
                Event::set(&OUTLIERS, 0.8),
                Event::set(&EPSILON, 30.0),
                Event::set(&ITERATIONS, MAX_SAMPLES as f64),
            ]
        },
    },
    Challenge {
        id: "wide",
        goal: "Keep ε at 30 px or more with half of the points outliers, and get 99 of 100 runs within 1°.",
        hint: "Two switches, and one of them alone does harm.",
        why: "In a wide band the most votes go to a line that leans toward the outliers; MSAC lets far voters \
              count less, and only then is it safe to refine.",
        check: |model| {
            let half = (model.settings.number(&OUTLIERS) - 0.5).abs() < 1e-9;
            let near = model.runs().map_or(0, |runs| runs.num_near(model.kind()));
            half && model.epsilon_px() >= 30.0 && !model.asked.is_waiting() && near >= 99
        },
        solution: || {
            vec![
                Event::set(&EPSILON, 30.0),
                Event::set(&MSAC, true),
                Event::set(&LOCAL, true),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_has_improved_at_least_twice_and_goes_on_to_the_truth() {
        let mut model = RansacLine::new();
        let tally = model.tally().unwrap();
        assert!(tally.votes.iter().filter(|vote| vote.is_best).count() >= 3);
        assert!(!tally.samples.is_finished());
        while !model.drawn().1 {
            model.update(&Event::press("step")).unwrap();
        }
        assert!(model.error_deg().unwrap() < 2.0);
    }

    #[test]
    fn running_casts_the_votes_little_by_little_and_stepping_at_once() {
        let mut model = RansacLine::new();
        let (drawn, _) = model.drawn();
        model.update(&Event::press("run")).unwrap();
        assert_eq!((model.drawn().0, model.phase()), (drawn + 1, 0.0));
        let tick = Event::Tick { dt_s: 0.1 };
        model.update(&tick).unwrap();
        assert!(model.is_running() && model.phase() > 0.05 && model.phase() < 0.1);
        for _ in 0..15 {
            model.update(&tick).unwrap();
        }
        assert_eq!(model.drawn().0, drawn + 2);
        model.update(&Event::press("run")).unwrap();
        assert_eq!((model.phase(), model.is_running()), (1.0, false));
        model.update(&Event::press("step")).unwrap();
        assert_eq!((model.drawn().0, model.phase()), (drawn + 3, 1.0));
        model.update(&Event::press("restart")).unwrap();
        assert_eq!((model.drawn().0, model.is_running()), (0, false));
    }

    #[test]
    fn a_long_run_ends_in_less_than_twenty_seconds() {
        let mut model = RansacLine::new();
        model.update(&Event::set(&OUTLIERS, 0.8)).unwrap();
        model.update(&Event::press("restart")).unwrap();
        model.update(&Event::press("run")).unwrap();
        let mut seconds = 0.0;
        while model.is_running() {
            assert!(!model.is_decided());
            model.update(&Event::Tick { dt_s: 0.05 }).unwrap();
            seconds += 0.05;
        }
        assert!(model.is_decided() && model.drawn().0 > 60);
        assert!(seconds > 5.0 && seconds < 20.0, "{seconds} s");
    }
}
