//! A point, two cameras that see it, and the noise of its two pixels.

use super::estimates::{Estimates, METHODS};
use super::guess::{self, CURVE, START};
use crate::contract::{
    Button, ButtonRole, Challenge, Choice, Control, Data, Datum, Declared, Event, Handle, Knob,
    Model, Problem, Settings, Slider, Space, Symbol, knobs, match_data,
};
use crate::kit::guess::{BOTH, GUESS, GuessedCurve, Reveal};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::probe::Probe;
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use nalgebra::{Point3, Vector3};
use std::cell::OnceCell;

pub(super) const FOCAL_PX: f64 = 500.0;
pub(super) const SIZE: (u32, u32) = (640, 480);
/// Range of the point and the cameras along x, meters.
pub(super) const ASIDE_M: [f64; 2] = [-1.2, 1.4];

pub(super) const NOISE: Slider = Slider::new("noise", "Pixel noise σ")
    .range(0.1, 4.0, 0.1)
    .at(1.0)
    .digits(1)
    .unit("px");
const SHOW: Choice = Choice::new(
    "show",
    "Show",
    &[
        ("misses", "In the photographs"),
        ("angle", "Error over angle"),
        ("distance", "Error over distance"),
        GUESS,
        BOTH,
    ],
);
const SEED: Slider = Slider::seed(6.0);
const KNOBS: &[Knob] = knobs![SHOW, NOISE, SEED];
const POINT: Probe = Probe::new("point", "top", "Point P")
    .on_plan([ASIDE_M, [1.0, 3.4]])
    .at(0.3, 2.4);
const SECOND: Probe = Probe::new("second", "top", "Camera 2")
    .on_plan([ASIDE_M, [-0.3, 3.0]])
    .at(0.5, 1.5);
const AGAIN: Button = Button::new("again", "Photograph again", ButtonRole::Step);

/// Content beside the uncertainty region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Show {
    /// Reprojections of each method's estimate in both photographs, relative to the pixel.
    Misses,
    /// Standard deviation along the rays over the triangulation angle.
    Angle,
    /// Standard deviation along the rays over the distance.
    Distance,
}

/// The model of `triangulate`.
pub(crate) struct Triangulate {
    settings: Settings,
    pub(super) orbit: Orbit,
    point: Probe,
    second: Probe,
    guess: GuessedCurve<5>,
    estimates: OnceCell<Result<Estimates, String>>,
}

impl Triangulate {
    pub(super) fn show(&self) -> Show {
        let shows = [Show::Misses, Show::Angle, Show::Distance];
        // A guess is one of the uncertainty over the distance.
        let chosen = self.settings.chosen(&SHOW);
        shows.get(chosen).copied().unwrap_or(Show::Distance)
    }

    pub(super) fn reveal(&self) -> Reveal {
        Reveal::of(&self.settings, &SHOW)
    }

    /// Returns the guessed curve, if it is shown.
    pub(super) fn guess(&self) -> Option<&GuessedCurve<5>> {
        self.reveal().shows_guess().then_some(&self.guess)
    }

    /// Returns the maximum factor between guess and curve, if they are compared.
    pub(super) fn guess_factor(&self) -> Option<f64> {
        let guess = self.guess().filter(|_| self.reveal().shows_answer())?;
        Some(guess.worst_factor(guess::truth(&self.estimates().ok()?.curves)?))
    }

    pub(super) fn sigma_px(&self) -> f64 {
        self.settings.number(&NOISE)
    }

    /// Returns the positions (x, z) of the point and the second camera, meters; the first camera is
    /// at the origin.
    pub(super) fn pins(&self) -> [(f64, f64); 2] {
        [self.point.place(), self.second.place()]
    }

    /// Returns the estimates, or a message why there are none.
    pub(super) fn estimates(&self) -> Result<&Estimates, &str> {
        let estimates = self.estimates.get_or_init(|| self.compute());
        estimates.as_ref().map_err(String::as_str)
    }

    fn compute(&self) -> Result<Estimates, String> {
        let [point, second] = self.pins().map(|(x, z)| Point3::new(x, 0.0, z));
        if point == second {
            return Err(
                "Camera 2 stands on P and sees no direction. Drag one of them away.".into(),
            );
        }
        let estimate = || {
            let camera = |center: &Point3<f64>| {
                Ok(PosedCamera {
                    camera: Camera::pinhole(
                        Intrinsics::centered(FOCAL_PX, SIZE.0, SIZE.1)?,
                        SIZE.0,
                        SIZE.1,
                    ),
                    cam_from_world: look_at(center, &point, &Vector3::new(0.0, -1.0, 0.0))?,
                })
            };
            let cameras = [camera(&Point3::origin())?, camera(&second)?];
            let seed = self.settings.count(&SEED) as u64;
            Estimates::new(cameras, point, self.sigma_px(), seed)
        };
        estimate().map_err(|error: epipole::Error| format!("There is no point, since {error}."))
    }
}

impl Declared for Triangulate {
    const NAME: &'static str = "triangulate";
    const TITLE: &'static str = "Where two noisy rays meet";
    const HELP: &'static str = "Drag the point or the second camera, from above; both cameras look at the \
        point. Photograph again for other noise. Drag in the enlarged picture to turn it. Or choose Your guess, \
        drag its points to where you expect the error over the distance, and compare.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            // From this viewpoint, the orbit handle is beside the region, not on it.
            orbit: Orbit::new(-62.0, 32.0),
            point: POINT,
            second: SECOND,
            guess: GuessedCurve::new(&CURVE, START),
            estimates: OnceCell::new(),
        }
    }
}

impl Model for Triangulate {
    /// Returns the cameras, and the noisy pixel of the point in each.
    fn data(&self) -> Data {
        let Ok(estimates) = self.estimates() else {
            return Data::new();
        };
        let ([first, second], [pixel1, pixel2]) = (&estimates.cameras, &estimates.pixels);
        let mut data = Data::from(match_data([(pixel1, pixel2)]));
        data.insert("camera1", Datum::camera(first));
        data.insert("camera2", Datum::camera(second));
        data
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        controls.push(AGAIN.control(true, false));
        controls.extend(self.orbit.controls());
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles = vec![self.point.handle(), self.second.handle()];
        handles.extend(self.guess().into_iter().flat_map(GuessedCurve::handles));
        handles.extend(self.orbit.handles());
        handles
    }

    fn symbols(&self) -> Vec<Symbol> {
        let (x, z) = self.point.place();
        vec![Symbol::point("X", "top", x, z)]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
            return Ok(());
        }
        if self.guess().is_some() && self.guess.update(event) {
            return Ok(());
        }
        self.settings.update(event)?;
        if *event == Event::press(AGAIN.id) {
            let seed = self.settings.number(&SEED);
            let next = if seed < SEED.max { seed + 1.0 } else { 1.0 };
            self.settings.slide(&SEED, next);
        }
        let _ = self.point.update(event) || self.second.update(event);
        self.estimates.take();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<Triangulate>] = &[
    Challenge {
        id: "narrow",
        goal: "Make the region four times as long without touching the point or the noise.",
        hint: "At what angle do the rays meet?",
        why: "While the angle is small, the depth error is proportional to one over the angle: a quarter of the \
              angle, four times the error.",
        check: |model| {
            let start = Triangulate::new();
            let long = |model: &Triangulate| model.estimates().ok()?.uncertainty_m();
            let untouched =
                model.point.place() == POINT.place() && model.sigma_px() == start.sigma_px();
            untouched && long(model) > long(&start).map(|long| 4.0 * long)
        },
        solution: || vec![Event::moved("second", 0.1, 0.0)],
    },
    Challenge {
        id: "guess",
        goal: "Guess the error over the distance, from 1 m to 80 m. Compare: be off by less than a factor of 2 \
               everywhere.",
        hint: "The mark at the dashed line is right. How much longer is the region at twice that distance?",
        why: "Four times as long at twice the distance: the angle between the rays halves, and a pixel is twice as \
              wide.",
        check: |model| model.guess_factor().is_some_and(|factor| factor < 2.0),
        solution: || {
            let truth = Triangulate::new();
            let truth = truth
                .estimates()
                .ok()
                .and_then(|found| guess::truth(&found.curves));
            let points = CURVE.ids.into_iter().zip(truth.unwrap_or_default());
            let mut events = vec![Event::set(&SHOW, GUESS.0)];
            events.extend(points.map(|(id, decade)| Event::moved(id, 0.0, decade)));
            events.push(Event::set(&SHOW, BOTH.0));
            events
        },
    },
    Challenge {
        id: "fair",
        goal: "Make the midpoint as good as the optimum, with the same noise.",
        hint: "In which of the two photographs does the midpoint miss by more, and why there?",
        why: "At the same distance from both cameras, a millimeter is as many pixels in one photograph as in the \
              other, so halfway is fair.",
        check: |model| {
            let start = Triangulate::new();
            let same = [&NOISE, &SEED]
                .into_iter()
                .all(|knob| model.settings.number(knob) == start.settings.number(knob));
            let missed = |method| model.estimates().ok()?.reprojection_px(method);
            let both = missed(0).zip(missed(METHODS.len() - 1));
            same && both.is_some_and(|(midpoint, optimal)| midpoint < optimal + 0.005)
        },
        solution: || vec![Event::moved("second", 0.5, 0.0)],
    },
    Challenge {
        id: "round",
        goal: "Make the region nearly round, at any place.",
        hint: "Each camera measures well across its own ray. So where should the other one look from?",
        why: "At a right angle each camera measures the direction in which the other one is blind.",
        check: |model| {
            let axes = model.estimates().ok().and_then(|estimates| estimates.axes);
            axes.is_some_and(|[long, _, short]| long.norm() < 1.6 * short.norm())
        },
        solution: || {
            vec![
                Event::moved("point", 0.0, 1.2),
                Event::moved("second", 1.2, 1.2),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn estimates(events: &[Event]) -> Estimates {
        let mut model = Triangulate::new();
        for event in events {
            model.update(event).unwrap();
        }
        model.compute().unwrap()
    }

    #[test]
    fn optimal_misses_the_pixels_least_wherever_things_are() {
        let mut random = epipole::math::random::Random::new(3);
        let mut model = Triangulate::new();
        let mut num_compared = 0;
        for seed in 1..=99 {
            let mut place = |low: f64, high: f64| random.uniform(low, high);
            let events = [
                Event::set(&SEED, f64::from(seed)),
                Event::set(&NOISE, place(0.1, 4.0)),
                Event::moved("point", place(-1.2, 1.4), place(1.0, 3.4)),
                Event::moved("second", place(-1.2, 1.4), place(-0.3, 3.0)),
            ];
            for event in &events {
                model.update(event).unwrap();
            }
            let Ok(estimates) = model.estimates() else {
                continue;
            };
            let Some(optimal) = estimates.reprojection_px(3) else {
                continue;
            };
            for method in 0..3 {
                if let Some(other) = estimates.reprojection_px(method) {
                    // Two steps of Lindström's iteration end this close to the minimum.
                    assert!(optimal <= other * (1.0 + 1e-8), "{optimal} and {other}");
                    num_compared += 1;
                }
            }
        }
        assert!(num_compared > 200);
    }

    #[test]
    fn the_scatter_of_many_photographs_is_what_the_jacobian_says() {
        for second in [(0.5, 0.0), (1.4, 0.4), (-0.4, 1.0)] {
            let estimates = estimates(&[Event::moved("second", second.0, second.1)]);
            let squares = estimates.axes.unwrap().map(|axis| axis.norm_squared());
            let expected = squares.iter().sum::<f64>().sqrt();
            let scatter = estimates.scatter_m().unwrap();
            assert!(
                (scatter / expected - 1.0).abs() < 0.15,
                "{scatter} and {expected}"
            );
        }
    }

    #[test]
    fn a_guess_hides_the_curve_until_it_is_compared() {
        let mut model = Triangulate::new();
        for event in [
            Event::set(&SHOW, GUESS.0),
            Event::moved("second", 0.4, 0.0),
            Event::moved("guess80", 0.0, 2.0),
            Event::moved("guess30", 0.0, 2.0),
            Event::moved("guess10", 0.0, 1.0),
        ] {
            model.update(&event).unwrap();
        }
        assert_eq!((model.show(), model.guess_factor()), (Show::Distance, None));
        assert!(model.describe().contains("hidden"));
        model.update(&Event::set(&SHOW, BOTH.0)).unwrap();
        // At 80 m the error is √2 Z² / (f B) = 45.3 m, and the guess is 1 m.
        let factor = model.guess_factor().unwrap();
        assert!((factor / 45.3 - 1.0).abs() < 0.1, "{factor}");
    }

    #[test]
    fn without_a_baseline_there_is_a_sentence() {
        let mut model = Triangulate::new();
        model.update(&Event::moved("second", 0.0, 0.0)).unwrap();
        let found = model.estimates().unwrap();
        assert!(found.points.iter().all(Result::is_err) && found.axes.is_none());
        assert!(model.describe().contains("There is no point, since "));
        // A camera at the point itself has no pose: the readouts remain, without numbers.
        let usual: Vec<_> = Triangulate::new()
            .readouts()
            .into_iter()
            .map(|one| one.id)
            .collect();
        model
            .update(&Event::moved("second", POINT.place().0, POINT.place().1))
            .unwrap();
        assert!(model.describe().starts_with("Camera 2 stands on P"));
        let readouts = model.readouts();
        assert!(readouts.iter().map(|one| one.id).eq(usual));
    }
}
