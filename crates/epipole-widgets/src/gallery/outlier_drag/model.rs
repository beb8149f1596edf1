//! Matches of the still life, the first of which is dragged to a wrong position.

use super::fit::{Fit, led_away};
use crate::contract::{
    Challenge, Control, Data, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    Symbol, Toggle, format_number, knobs, match_data,
};
use crate::kit::geometry::match_symbols;
use crate::kit::matches::{Match, Matches, cameras, line2};
use crate::kit::probe::Probe;
use crate::kit::scenes::PHOTO_SIZE;
use epipole::epipolar::fundamental_from_cameras;
use nalgebra::{Point2, Vector2};
use std::cell::OnceCell;

/// Number of true matches, besides the wrong one.
const COUNT: Slider = Slider::new("count", "True matches")
    .range(8.0, 59.0, 1.0)
    .at(19.0);
const HEARD: Toggle = Toggle::new("heard", "Use wrong match").on();
const NOISE: Slider = Slider::new("noise", "Pixel noise σ")
    .range(0.0, 3.0, 0.1)
    .at(0.5)
    .digits(1)
    .unit("px")
    .more();
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![COUNT, HEARD, NOISE, SEED];

const WRONG: Probe = Probe::new("wrong", "second", "Wrong match")
    .over(PHOTO_SIZE)
    .step(5.0)
    .digits(1);
/// Initial displacement of the wrong match from its true position, pixels.
const AWAY_PX: Vector2<f64> = Vector2::new(30.0, 130.0);

/// The true matches, the wrong one, and F.
pub(super) struct State {
    pub(super) truth: Vec<Match>,
    /// The dragged match at its true position.
    pub(super) right: Match,
    put: Probe,
    pub(super) wrong: Match,
    /// F with the wrong match, unless the toggle excludes it.
    pub(super) fit: Fit,
    /// F from the true matches only.
    pub(super) without: Fit,
    led: OnceCell<Vec<(f64, Fit)>>,
}

impl State {
    /// Returns [`led_away`] of this state, cached.
    pub(super) fn led(&self) -> &[(f64, Fit)] {
        let led = || led_away(&self.truth, &self.right, &self.wrong.1);
        self.led.get_or_init(led)
    }
}

/// The model of `outlier-drag`.
pub(crate) struct OutlierDrag {
    settings: Settings,
    /// Position chosen by the reader; `None` for the initial one.
    put: Option<Probe>,
    state: Result<State, String>,
}

impl OutlierDrag {
    /// Returns the matches and F, or a message why there is none.
    pub(super) fn state(&self) -> Result<&State, &str> {
        self.state.as_ref().map_err(String::as_str)
    }

    pub(super) fn is_heard(&self) -> bool {
        self.settings.flag(&HEARD)
    }

    /// Returns the distance of the wrong match from its true position, pixels.
    pub(super) fn away_px(&self) -> f64 {
        let state = self.state.as_ref();
        state.map_or(0.0, |state| (state.wrong.1 - state.right.1).norm())
    }

    fn compute(&mut self) {
        let state = self.solve();
        self.state = state.map_err(|error| format!("There is no F: {error}."));
    }

    fn solve(&self) -> Result<State, epipole::Error> {
        let count = self.settings.count(&COUNT) + 1;
        let matches = Matches::draw(self.settings.count(&SEED) as u64);
        let mut truth = matches.noisy(count, self.settings.number(&NOISE));
        let right = truth.remove(0);
        let put = self.put.unwrap_or_else(|| near(&(right.1 + AWAY_PX)));
        let wrong = (right.0, put.point());
        Ok(State {
            fit: Fit::new(&truth, &wrong, self.is_heard())?,
            without: Fit::new(&truth, &wrong, false)?,
            led: OnceCell::new(),
            truth,
            right,
            put,
            wrong,
        })
    }
}

/// Returns the handle of the wrong match at a position, clamped to the photograph.
fn near(place: &Point2<f64>) -> Probe {
    let mut wrong = WRONG;
    wrong.put(place.x, place.y);
    wrong
}

impl Declared for OutlierDrag {
    const NAME: &'static str = "outlier-drag";
    const TITLE: &'static str = "One wrong match";
    const HELP: &'static str = "Drag the ringed match in photograph 2, or move it with the arrow keys: F is \
        fitted to all matches, the wrong one among them, and the lines of the others leave them. Leave it \
        out, and they come back.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            put: None,
            state: Err(String::new()),
        };
        model.compute();
        model
    }
}

impl Model for OutlierDrag {
    /// Returns all matches, the wrong one last.
    fn data(&self) -> Data {
        let Ok(state) = self.state() else {
            return Data::new();
        };
        let matches = state.truth.iter().chain([&state.wrong]);
        Data::from(match_data(matches.map(|(one, two)| (one, two))))
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let Ok(state) = &self.state else {
            return Vec::new();
        };
        let away = format_number(self.away_px(), 0);
        let told = format!("{}, {away} px from where it belongs", state.put.text());
        vec![state.put.handle().told(told)]
    }

    /// Returns the symbols of the wrong match.
    fn symbols(&self) -> Vec<Symbol> {
        let Ok(state) = self.state() else {
            return Vec::new();
        };
        let (pixel1, pixel2) = state.wrong;
        let line2 = line2(&state.fit.fundamental, &pixel1);
        match_symbols([Some(pixel1), Some(pixel2)], line2)
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match (self.settings.update(event)?, event) {
            (Some(id), _) if id == SEED.id => self.put = None,
            (Some(_), _) => {}
            (None, Event::HandleMoved { x, y, .. }) => self.put = Some(near(&Point2::new(*x, *y))),
            _ => return Ok(()),
        }
        self.compute();
        Ok(())
    }
}

/// Returns a point on the true line of the dragged match, `away_px` from its true position.
fn along_its_line(away_px: f64) -> Option<Point2<f64>> {
    let model = OutlierDrag::new();
    let (pixel1, pixel2) = model.state.ok()?.right;
    let [first, second] = cameras();
    let fundamental = fundamental_from_cameras(&first, &second).ok()?;
    let line = line2(&fundamental, &pixel1)?;
    let on = line.nearest(&pixel2);
    let along = Vector2::new(-line.b, line.a) * away_px;
    let ends = [on + along, on - along];
    ends.into_iter()
        .find(|place| (near(place).point() - place).amax() < 0.1)
}

const CHALLENGES: &[Challenge<OutlierDrag>] = &[
    Challenge {
        id: "more",
        goal: "With the wrong match in use, take the worst true match 40 px off its line.",
        hint: "Do more true matches help?",
        why: "Least squares listens to every match alike, so more true ones do not outvote the wrong one; \
              they only add matches that can suffer.",
        check: |model| {
            let worst = model.state().map_or(0.0, |state| state.fit.worst_px);
            model.is_heard() && worst >= 40.0
        },
        solution: || vec![Event::set(&COUNT, 59.0)],
    },
    Challenge {
        id: "harmless",
        goal: "Put the match 80 px from where it belongs, in use, and keep the others within 1.5 px on \
               average.",
        hint: "F asks only whether a match is on its line.",
        why: "Along its own epipolar line a match can be as wrong as it likes: no F can tell, and so no \
              vote will either.",
        check: |model| {
            let state = model.state().ok();
            let mean = state.map_or(f64::INFINITY, |state| state.fit.mean_px);
            model.is_heard() && model.away_px() >= 80.0 && mean <= 1.5
        },
        solution: || {
            let moved = |place: Point2<f64>| Event::moved(WRONG.id(), place.x, place.y);
            along_its_line(90.0).map(moved).into_iter().collect()
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_first_one_match_has_taken_the_others_off_their_lines() {
        let model = OutlierDrag::new();
        let state = model.state().unwrap();
        assert!(
            state.fit.mean_px > 10.0 * state.without.mean_px,
            "{:?}",
            state.fit
        );
        assert!(model.away_px() > 100.0 && state.without.mean_px < 1.0);
    }

    #[test]
    fn another_seed_has_another_match_to_drag() {
        let mut model = OutlierDrag::new();
        model
            .update(&Event::moved(WRONG.id(), 100.0, 100.0))
            .unwrap();
        assert_eq!(model.state().unwrap().wrong.1, Point2::new(100.0, 100.0));
        for seed in [2.0, 50.0, 99.0] {
            model.update(&Event::set(&SEED, seed)).unwrap();
            assert!(
                model.away_px() > 20.0 && model.away_px() < 200.0,
                "{}",
                model.away_px()
            );
            assert!(model.state().is_ok());
        }
    }
}
