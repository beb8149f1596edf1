//! Points on a hidden line among outliers; least squares and the core's own RANSAC, sample by
//! sample.
//!
//! The state is the settings, the points and how many samples have been drawn. Everything else is
//! computed from these anew after each event: a run of a few hundred samples takes well under a
//! millisecond, and so a permalink replays exactly.

use super::knobs::{COUNT, EPSILON, ITERATIONS, KNOBS, OUTLIERS, SEED};
use super::run::{Best, Candidate, MAX_SAMPLES, Outcome, Question, run};
use super::words;
use crate::contract::{
    Challenge, Control, Event, Handle, Model, Problem, Readout, Settings, Value, format_number,
    round_to_digits,
};
use crate::running::Running;
use epipole::math::{Line2, random::Random};
use nalgebra::Point2;

/// The plane that the points lie in, pixels.
pub(super) const WIDTH_PX: f64 = 640.0;
/// The plane that the points lie in, pixels.
pub(super) const HEIGHT_PX: f64 = 400.0;
/// Standard deviation of a good point's distance from the true line.
const NOISE_PX: f64 = 4.0;
const MAX_ADDED: usize = 24;
const SAMPLES_PER_SECOND: f64 = 4.0;
/// Places of points are kept to a tenth of a pixel.
const DIGITS: usize = 1;

/// A point and where it came from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Datum {
    /// Number in its name, from 1.
    pub(super) number: usize,
    pub(super) place: Point2<f64>,
    pub(super) added: bool,
}

/// The model of `ransac-race`.
pub struct RansacRace {
    settings: Settings,
    truth: Line2,
    data: Vec<Datum>,
    outcome: Outcome,
    running: Running,
}

impl RansacRace {
    pub(super) fn data(&self) -> &[Datum] {
        &self.data
    }

    pub(super) fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    pub(super) fn truth(&self) -> &Line2 {
        &self.truth
    }

    pub(super) fn least_squares(&self) -> Option<&Line2> {
        self.outcome.least_squares.as_ref()
    }

    pub(super) fn candidate(&self) -> Option<&Candidate> {
        self.outcome.candidate.as_ref()
    }

    pub(super) fn best(&self) -> Option<&Best> {
        self.outcome.best.as_ref()
    }

    pub(super) fn finished(&self) -> bool {
        self.outcome.finished
    }

    pub(super) fn epsilon_px(&self) -> f64 {
        self.settings.number(&EPSILON)
    }

    pub(super) fn problem(&self) -> Option<&str> {
        self.outcome.problem.as_deref()
    }

    /// New points on a new hidden line; what the reader had moved or added is gone.
    fn scatter(&mut self) {
        let mut random = Random::new(self.settings.count(&SEED) as u64);
        let count = self.settings.count(&COUNT);
        let num_outliers = (self.settings.number(&OUTLIERS) * count as f64).round() as usize;
        let place = |u: f64, v: f64| {
            let keep =
                |value: f64, size: f64| round_to_digits(value.clamp(4.0, size - 4.0), DIGITS);
            Point2::new(keep(u, WIDTH_PX), keep(v, HEIGHT_PX))
        };
        let angle = random.uniform(-0.42, 0.42);
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let middle_v = HEIGHT_PX / 2.0 + random.uniform(-50.0, 50.0);
        let middle = Point2::new(WIDTH_PX / 2.0, middle_v);
        self.truth = Line2 {
            a: -sin,
            b: cos,
            c: sin * middle.x - cos * middle.y,
        };
        let mut places = Vec::with_capacity(count);
        for _ in num_outliers..count {
            let along = random.uniform(-0.46, 0.46) * WIDTH_PX;
            let across = NOISE_PX * random.normal();
            places.push(place(
                middle.x + along * cos - across * sin,
                middle.y + along * sin + across * cos,
            ));
        }
        for _ in 0..num_outliers {
            // Half of the outliers anywhere, half on one side, as a repeated pattern gives them.
            let (u, v) = (random.unit(), random.unit());
            let side = random.unit() < 0.5;
            let (u, v) = if side {
                (0.55 + 0.42 * u, 0.04 + 0.3 * v)
            } else {
                (u, v)
            };
            let v = if side && sin < 0.0 { 1.0 - v } else { v };
            places.push(place(u * WIDTH_PX, v * HEIGHT_PX));
        }
        let datum = |(index, place)| Datum {
            number: index + 1,
            place,
            added: false,
        };
        self.data = places.into_iter().enumerate().map(datum).collect();
    }

    /// Fits both ways to the present points and replays the samples.
    fn compute(&mut self) {
        let places: Vec<Point2<f64>> = self.data.iter().map(|datum| datum.place).collect();
        self.outcome = run(&Question {
            places: &places,
            epsilon_px: self.epsilon_px(),
            seed: self.settings.count(&SEED) as u64,
            iterations: self.settings.count(&ITERATIONS),
        });
    }

    pub(super) fn angles_deg(&self) -> Angles {
        let least_squares = self.least_squares();
        let ransac = self.best().map(|best| &best.line);
        let between = |a: Option<&Line2>, b: Option<&Line2>| Some(angle_between_deg(a?, b?));
        Angles {
            between: between(least_squares, ransac),
            least_squares: between(least_squares, Some(&self.truth)),
            ransac: between(ransac, Some(&self.truth)),
        }
    }

    /// Draws to `iterations` samples in all, or as many as the budget asks for. The number asked
    /// for is kept: other data may need more of them.
    fn run_to(&mut self, iterations: usize) -> Result<(), Problem> {
        let value = Value::Number(iterations.min(MAX_SAMPLES) as f64);
        self.settings.set(ITERATIONS.id, &value)?;
        self.compute();
        self.running.stop_if(self.outcome.finished);
        Ok(())
    }

    fn add(&mut self, number: usize, u: f64, v: f64) -> bool {
        let added = self.data.iter().filter(|datum| datum.added).count();
        if added >= MAX_ADDED || self.data.iter().any(|datum| datum.number == number) {
            return false;
        }
        let place = Point2::new(round_to_digits(u, DIGITS), round_to_digits(v, DIGITS));
        self.data.push(Datum {
            number,
            place,
            added: true,
        });
        self.data.sort_by_key(|datum| datum.number);
        self.compute();
        true
    }
}

/// Acute angles between lines, degrees; `None` for what has no line yet.
pub(super) struct Angles {
    pub(super) between: Option<f64>,
    pub(super) least_squares: Option<f64>,
    pub(super) ransac: Option<f64>,
}

/// The acute angle between two lines, degrees.
fn angle_between_deg(one: &Line2, other: &Line2) -> f64 {
    let cross = one.a * other.b - one.b * other.a;
    let dot = one.a * other.a + one.b * other.b;
    libm::atan2(cross.abs(), dot.abs()).to_degrees()
}

fn number_of(id: &str) -> Option<usize> {
    let number: usize = id.strip_prefix('p')?.parse().ok()?;
    (id == format!("p{number}")).then_some(number)
}

impl Model for RansacRace {
    const NAME: &'static str = "ransac-race";
    const TITLE: &'static str = "The race";
    const HELP: &'static str = "Run or step through the samples. Drag a point, or choose one and \
        move it with the arrow keys; click on an empty place to add a point, press Delete to \
        remove it.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            truth: Line2 {
                a: 0.0,
                b: 1.0,
                c: 0.0,
            },
            data: Vec::new(),
            outcome: Outcome::default(),
            running: Running::at(SAMPLES_PER_SECOND),
        };
        model.scatter();
        model.compute();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let (drawn, finished) = (self.outcome.iterations, self.outcome.finished);
        let can_run = self.outcome.problem.is_none();
        let mut controls = self.settings.controls();
        controls.extend(self.running.controls(can_run, drawn, finished));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let handle = |datum: &Datum| Handle {
            id: format!("p{}", datum.number),
            panel: "plane",
            label: format!("Point {}", datum.number),
            value_text: format!(
                "{} px across, {} px down",
                format_number(datum.place.x, 0),
                format_number(datum.place.y, 0)
            ),
            x: datum.place.x,
            y: datum.place.y,
            x_range: [0.0, WIDTH_PX],
            y_range: [0.0, HEIGHT_PX],
            step: [10.0, 10.0],
            digits: DIGITS,
            removable: self.data.len() > 2,
        };
        self.data.iter().map(handle).collect()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                if self.settings.set(id, value)? == Some(true) {
                    if [OUTLIERS.id, COUNT.id, SEED.id].contains(&&**id) {
                        self.scatter();
                    }
                    let iterations = self.settings.count(&ITERATIONS);
                    self.run_to(iterations)?;
                }
            }
            Event::Press { id } => {
                let (drawn, finished) = (self.outcome.iterations, self.outcome.finished);
                if let Some(iterations) = self.running.press(id, drawn, finished) {
                    self.run_to(iterations)?;
                }
            }
            Event::HandleMoved { id, x, y } => {
                let number = number_of(id);
                if let Some(datum) = self.data.iter_mut().find(|d| Some(d.number) == number) {
                    datum.place = Point2::new(*x, *y);
                    self.compute();
                }
            }
            Event::HandleRemoved { id } => {
                let number = number_of(id);
                self.data.retain(|datum| Some(datum.number) != number);
                self.compute();
            }
            Event::Clicked { x, y, .. } => {
                let last = self
                    .data
                    .iter()
                    .map(|datum| datum.number)
                    .max()
                    .unwrap_or(0);
                self.add(last.max(self.settings.count(&COUNT)) + 1, *x, *y);
            }
            Event::Tick { dt_s } => {
                if let Some(iterations) = self.running.tick(*dt_s, self.outcome.iterations) {
                    self.run_to(iterations)?;
                }
            }
            Event::Reset => {}
        }
        Ok(())
    }

    fn restore_handle(&mut self, id: &str, x: f64, y: f64) -> bool {
        let first = self.settings.count(&COUNT) + 1;
        let inside = (0.0..=WIDTH_PX).contains(&x) && (0.0..=HEIGHT_PX).contains(&y);
        let number = number_of(id).filter(|number| (first..first + 1000).contains(number));
        inside && number.is_some_and(|number| self.add(number, x, y))
    }

    fn is_running(&self) -> bool {
        self.running.is_running()
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
                id: "agree",
                goal: "Make least squares and RANSAC agree within 1°.",
                hint: "What is it that only one of the two can bear?",
                check: |model| model.angles_deg().between.is_some_and(|angle| angle < 1.0),
                solution: || vec![set("outliers", 0.0), set("iterations", 40.0)],
            },
            Challenge {
                id: "long-run",
                goal: "Find data for which more than 100 samples are needed.",
                hint: "Every sample must be lucky twice.",
                check: |model| model.outcome.budget.is_some_and(|budget| budget > 100),
                solution: || {
                    vec![
                        set("epsilon", 4.0),
                        set("outliers", 0.9),
                        set("iterations", 500.0),
                    ]
                },
            },
            Challenge {
                id: "one-bad-point",
                goal: "Without outliers, drag one point until least squares is 5° off while RANSAC \
                       stays within 2°.",
                hint: "Few points, and a long lever.",
                check: |model| {
                    let angles = model.angles_deg();
                    model.settings.number(&OUTLIERS) == 0.0
                        && angles.least_squares.is_some_and(|angle| angle > 5.0)
                        && angles.ransac.is_some_and(|angle| angle < 2.0)
                },
                solution: || {
                    vec![
                        set("outliers", 0.0),
                        set("points", 8.0),
                        set("iterations", 20.0),
                        Event::HandleMoved {
                            id: "p1".to_owned(),
                            x: 640.0,
                            y: 480.0,
                        },
                    ]
                },
            },
        ]
    }
}

fn set(id: &str, value: f64) -> Event {
    Event::Set {
        id: id.to_owned(),
        value: Value::Number(value),
    }
}
