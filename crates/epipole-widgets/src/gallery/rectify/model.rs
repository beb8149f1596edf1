//! Two cameras that are not aligned for stereo, some matches, and the progress of their rotation.

use super::turned::{Turned, Way};
use crate::contract::{
    Challenge, Choice, Control, Data, Datum, Declared, Event, Knob, Model, Problem, Settings,
    Slider, Symbol, knobs, match_data,
};
use crate::kit::geometry::{Geometry, symbols};
use crate::kit::scenes::{in_picture, still_life};
use epipole_scenes::Transfer;
use nalgebra::{Point2, Point3};
use std::cell::OnceCell;

const PARALLEL: Slider = Slider::new("parallel", "Make parallel")
    .range(0.0, 100.0, 1.0)
    .unit("%");
const ALONG: Slider = Slider::new("along", "Follow baseline")
    .range(0.0, 100.0, 1.0)
    .unit("%");
const TURN: Slider = Slider::new("turn", "Camera 2 turned")
    .range(0.0, 16.0, 1.0)
    .at(10.0)
    .unit("°");
const FORWARD: Slider = Slider::new("forward", "Step ahead")
    .range(-0.1, 0.1, 0.01)
    .at(-0.05)
    .digits(2)
    .unit("m");
const FRAME: Choice = Choice::new(
    "frame",
    "Rectified frame",
    &[("all", "All pixels"), ("valid", "Valid pixels")],
)
.more();
const MATCH: Slider = Slider::new("match", "Match p")
    .range(1.0, NUM_MATCHES as f64, 1.0)
    .at(8.0)
    .more();
const KNOBS: &[Knob] = knobs![PARALLEL, ALONG, TURN, FORWARD, FRAME, MATCH];

const NUM_MATCHES: usize = 8;
/// Pixels of photograph 1 whose matches are shown, spread over objects and walls.
const PIXELS: [(f64, f64); NUM_MATCHES] = [
    (70.0, 70.0),
    (330.0, 60.0),
    (560.0, 90.0),
    (150.0, 230.0),
    (330.0, 250.0),
    (500.0, 260.0),
    (230.0, 420.0),
    (480.0, 420.0),
];

/// A match in both pictures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown {
    pub(super) point: Point3<f64>,
    /// Pixels in the rotated images.
    pub(super) pixels: [Point2<f64>; 2],
    /// Whether the point is visible in photograph 2: neither hidden nor outside.
    pub(super) is_seen: bool,
}

impl Shown {
    /// Returns the row in image 2 minus the row in image 1, pixels.
    pub(super) fn rows_px(&self) -> f64 {
        self.pixels[1].y - self.pixels[0].y
    }
}

/// The pair with its matches as shown.
pub(super) struct State {
    pub(super) turned: Turned,
    pub(super) geometry: Option<Geometry>,
    pub(super) matches: Vec<Shown>,
}

impl State {
    fn new(forward_m: f64, left_deg: f64, way: Way) -> Result<Self, epipole::Error> {
        let turned = Turned::new(forward_m, left_deg, way)?;
        let [first, second] = &turned.taken;
        let scene = still_life();
        let follow = |(u, v): (f64, f64)| {
            let (point, is_seen) = match scene.transfer(first, second, &Point2::new(u, v)) {
                Transfer::Visible { pixel2, x_in_world } => (x_in_world, in_picture(&pixel2)),
                Transfer::Occluded { x_in_world, .. } => (x_in_world, false),
                Transfer::BehindCamera { .. } | Transfer::Nothing => return None,
            };
            let [one, two] = turned.shown.map(|camera| camera.project(&point).ok());
            Some(Shown {
                point,
                pixels: [one?, two?],
                is_seen,
            })
        };
        let matches = PIXELS.into_iter().filter_map(follow).collect();
        Ok(Self {
            geometry: Geometry::of(&turned.shown),
            turned,
            matches,
        })
    }

    /// Returns the maximum row difference among the matches visible in both photographs, pixels.
    pub(super) fn worst_px(&self) -> f64 {
        let seen = self.matches.iter().filter(|shown| shown.is_seen);
        seen.map(|shown| shown.rows_px().abs()).fold(0.0, f64::max)
    }
}

/// The model of `rectify`.
pub(crate) struct Rectify {
    settings: Settings,
    state: OnceCell<Result<State, String>>,
}

impl Rectify {
    /// Returns the rotated pair, or a message why there is none.
    pub(super) fn state(&self) -> Result<&State, &str> {
        let state = self.state.get_or_init(|| self.compute());
        state.as_ref().map_err(String::as_str)
    }

    /// Returns the match labeled p and p′, if camera 1 sees its point.
    pub(super) fn selected(&self) -> Option<(usize, &Shown)> {
        let index = self.settings.count(&MATCH) - 1;
        Some((index, self.state().ok()?.matches.get(index)?))
    }

    pub(super) fn is_rectified(&self) -> bool {
        let way = self.way();
        way.parallel >= 1.0 && way.along >= 1.0
    }

    /// Returns whether the cameras have their initial poses.
    fn is_as_placed(&self) -> bool {
        self.settings.number(&TURN) == TURN.default
            && self.settings.number(&FORWARD) == FORWARD.default
    }

    pub(super) fn way(&self) -> Way {
        Way {
            parallel: self.settings.number(&PARALLEL) / 100.0,
            along: self.settings.number(&ALONG) / 100.0,
            shows_all: self.settings.chosen(&FRAME) == 0,
        }
    }

    fn compute(&self) -> Result<State, String> {
        let (forward_m, left_deg) = (self.settings.number(&FORWARD), self.settings.number(&TURN));
        let state = State::new(forward_m, left_deg, self.way());
        state.map_err(|error| format!("The pair cannot be rectified: {error}."))
    }

    /// Returns the match nearest to a position in an image.
    fn nearest(&self, panel: &str, place: Point2<f64>) -> Option<usize> {
        let side = match panel {
            "first" => 0,
            "second" => 1,
            _ => return None,
        };
        let matches = self.state().ok()?.matches.iter().enumerate();
        let away = |shown: &Shown| (shown.pixels[side] - place).norm_squared();
        let nearest = matches.min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b)))?;
        Some(nearest.0)
    }
}

impl Declared for Rectify {
    const NAME: &'static str = "rectify";
    const TITLE: &'static str = "Until lines are rows";
    const HELP: &'static str = "Turn the cameras with the first two sliders: toward one heading, then along \
        the baseline. Click a match in a photograph to follow it, or choose it with the slider.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            state: OnceCell::new(),
        }
    }
}

impl Model for Rectify {
    /// Returns the matches visible in both photographs, and the rotated cameras.
    fn data(&self) -> Data {
        let Ok(state) = self.state() else {
            return Data::new();
        };
        let seen = state.matches.iter().filter(|shown| shown.is_seen);
        let mut data = Data::from(match_data(seen.map(|shown| {
            let [pixel1, pixel2] = &shown.pixels;
            (pixel1, pixel2)
        })));
        let [first, second] = &state.turned.shown;
        data.insert("camera1", Datum::camera(first));
        data.insert("camera2", Datum::camera(second));
        data
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn symbols(&self) -> Vec<Symbol> {
        let (Some((_, shown)), Ok(state)) = (self.selected(), self.state()) else {
            return Vec::new();
        };
        let pixels = [
            Some(shown.pixels[0]),
            shown.is_seen.then_some(shown.pixels[1]),
        ];
        symbols(pixels, state.geometry.as_ref())
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let changed = self.settings.update(event)?;
        if changed.is_some_and(|id| id != MATCH.id) {
            self.state.take();
        }
        if let Event::Clicked { panel, x, y } = event
            && let Some(index) = self.nearest(panel, Point2::new(*x, *y))
        {
            self.settings.slide(&MATCH, index as f64 + 1.0);
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<Rectify>] = &[
    Challenge {
        id: "level",
        goal: "Leave camera 2 where it is, and bring every match into one row, to half a pixel.",
        hint: "Are the rows of parallel cameras level?",
        why: "Parallel is not enough: the rows of both pictures must also point along the baseline, and then \
              every plane through it cuts both pictures in one row.",
        check: |model| {
            let worst_px = model.state().map_or(f64::INFINITY, State::worst_px);
            model.is_as_placed() && worst_px <= 0.5
        },
        solution: || vec![Event::set(&PARALLEL, 100.0), Event::set(&ALONG, 100.0)],
    },
    Challenge {
        id: "enough",
        goal: "Leave camera 2 turned by 6° or more, do not follow the baseline, and place the camera so that \
               making both parallel brings every match within 1 px of its row.",
        hint: "Halfway between the two headings must be square to the baseline.",
        why: "If the mean heading is already square to the baseline, there is nothing left to turn together: \
              two eyes that converge on an object straight ahead stand like that.",
        check: |model| {
            let worst_px = model.state().map_or(f64::INFINITY, State::worst_px);
            model.way().along == 0.0 && model.settings.number(&TURN) >= 6.0 && worst_px <= 1.0
        },
        solution: || {
            vec![
                Event::set(&PARALLEL, 100.0),
                Event::set(&TURN, 6.0),
                Event::set(&FORWARD, 0.02),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_cameras_still_miss_their_rows_and_only_both_turns_level_them() {
        let mut model = Rectify::new();
        let worst = |model: &Rectify| model.state().unwrap().worst_px();
        let raw = worst(&model);
        model.update(&Event::set(&PARALLEL, 100.0)).unwrap();
        let parallel = worst(&model);
        model.update(&Event::set(&ALONG, 100.0)).unwrap();
        assert!(raw > 15.0 && parallel > 8.0, "{raw} {parallel}");
        assert!(worst(&model) < 1e-6 && model.is_rectified());
    }

    #[test]
    fn matches_are_seen_by_both_and_a_click_takes_the_nearest() {
        let mut model = Rectify::new();
        let state = model.state().unwrap();
        assert_eq!(state.matches.len(), NUM_MATCHES);
        assert!(state.matches.iter().filter(|shown| shown.is_seen).count() >= 6);
        let place = state.matches[2].pixels[1];
        model
            .update(&Event::clicked("second", place.x + 3.0, place.y))
            .unwrap();
        assert_eq!(model.selected().unwrap().0, 2);
        model.update(&Event::clicked("top", 0.0, 0.5)).unwrap();
        assert_eq!(model.selected().unwrap().0, 2);
    }

    #[test]
    fn the_whole_photographs_leave_margins_and_the_valid_part_does_not() {
        let mut model = Rectify::new();
        assert!(model.state().unwrap().turned.valid_ratio() < 0.8);
        model.update(&Event::set(&FRAME, "valid")).unwrap();
        assert!(model.state().unwrap().turned.valid_ratio() > 0.99);
    }
}
