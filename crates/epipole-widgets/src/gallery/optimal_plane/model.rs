//! A match whose rays do not intersect, two cameras, and the angle of a plane through their
//! baseline.

use super::pencil::Pencil;
use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, Symbol,
    format_number, knobs,
};
use crate::kit::geometry::{Geometry, match_symbols};
use crate::kit::probe::{Probe, place_words};
use crate::kit::scenes::{PHOTO_SIZE, Seen, still_life_pair};
use epipole::camera::PosedCamera;
use epipole::math::Line2;
use epipole::triangulation::correct_matches;
use nalgebra::{Point2, Vector2};

const FORWARD: Slider = Slider::new("forward", "Camera 2 ahead")
    .range(-0.4, 0.7, 0.02)
    .at(0.2)
    .digits(2)
    .unit("m");
const APART: Slider = Slider::new("apart", "Off the line")
    .range(-60.0, 60.0, 2.0)
    .at(40.0)
    .unit("px");
const KNOBS: &[Knob] = knobs![FORWARD, APART];
/// Initially on the mug's handle.
const PIXEL: Probe = Probe::new("p", "first", "p in photograph 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .digits(1)
    .told(|place| place_words(place, 1))
    .at(479.0, 327.0);
/// Maximum angle of the plane to either side of the plane through p, degrees.
pub(super) const REACH_DEG: f64 = 8.0;
/// Handle of the plane, on the track below the plot.
pub(super) const PLANE: Probe = Probe::new("plane", "track", "Plane")
    .within([[-REACH_DEG, REACH_DEG], [0.0; 2]])
    .step(0.2)
    .digits(2)
    .told(|(degrees, _)| format!("turned by {}°", format_number(degrees, 1)));
/// Sideways translation of camera 2, meters, and its rotation to the left, degrees.
const RIGHT_M: f64 = 0.36;
const LEFT_DEG: f64 = 12.0;

/// The model of `optimal-plane`.
pub(crate) struct OptimalPlane {
    settings: Settings,
    pixel: Probe,
    plane: Probe,
}

/// Distances of a match from the two lines of a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Miss {
    pub(super) px: [f64; 2],
}

impl Miss {
    fn of(lines: &[Line2; 2], pixels: &[Point2<f64>; 2]) -> Self {
        let px = [0, 1].map(|index| lines[index].signed_distance(&pixels[index]).abs());
        Self { px }
    }

    /// Returns the sum of the squared distances, square pixels.
    pub(super) fn sum_sq(&self) -> f64 {
        self.px.iter().map(|px| px * px).sum()
    }
}

/// The match, its planes, and the best one.
pub(super) struct State {
    pub(super) pixels: [Point2<f64>; 2],
    pencil: Pencil,
    /// Angle of the best plane, degrees, and the distances from its lines.
    pub(super) best: (f64, Miss),
}

impl State {
    /// Returns the lines of the plane at an angle, and the distances from them.
    pub(super) fn at(&self, angle_deg: f64) -> Option<([Line2; 2], Miss)> {
        let lines = self.pencil.lines(angle_deg.to_radians())?;
        let miss = Miss::of(&lines, &self.pixels);
        Some((lines, miss))
    }
}

impl OptimalPlane {
    pub(super) fn cameras(&self) -> [PosedCamera; 2] {
        let forward_m = self.settings.number(&FORWARD);
        still_life_pair(PHOTO_SIZE, RIGHT_M, forward_m, LEFT_DEG)
    }

    pub(super) fn angle_deg(&self) -> f64 {
        self.plane.place().0
    }

    /// Returns the match and its planes; `None` if p shows no surface visible to both cameras.
    pub(super) fn state(&self) -> Option<State> {
        let cameras = self.cameras();
        let (x, y) = self.pixel.place();
        let pixel1 = Point2::new(x, y);
        let Seen::Visible(exact) = Seen::of(&cameras, &pixel1) else {
            return None;
        };
        let geometry = Geometry::of(&cameras)?;
        let line = geometry.line2(&pixel1)?;
        let apart = self.settings.number(&APART);
        let pixel2 = exact + apart * Vector2::new(line.a, line.b);
        let pencil = Pencil::new(&cameras, &pixel1)?;
        let (nearest, _) = correct_matches(&geometry.fundamental, &pixel1, &pixel2).ok()?;
        let angle_rad = pencil.angle_rad(&nearest);
        let pixels = [pixel1, pixel2];
        let miss = Miss::of(&pencil.lines(angle_rad)?, &pixels);
        Some(State {
            pixels,
            pencil,
            best: (angle_rad.to_degrees(), miss),
        })
    }
}

impl Declared for OptimalPlane {
    const NAME: &'static str = "optimal-plane";
    const TITLE: &'static str = "The plane that misses least";
    const HELP: &'static str = "Drag the handle below the curve to turn the plane about the baseline, drag p over \
        photograph 1, and move camera 2 ahead. Watch which photograph takes most of the error.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            pixel: PIXEL,
            plane: PLANE,
        }
    }
}

impl Model for OptimalPlane {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.pixel.handle(), self.plane.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if let Event::Clicked { panel, x, .. } = event
            && panel == "plot"
        {
            self.plane.put(*x, 0.0);
            return Ok(());
        }
        if !self.pixel.update(event) && !self.plane.update(event) {
            self.settings.update(event)?;
        }
        Ok(())
    }

    fn symbols(&self) -> Vec<Symbol> {
        let pixels = self.state().map(|state| state.pixels);
        match_symbols([0, 1].map(|index| pixels.map(|pixels| pixels[index])), None)
    }
}

const CHALLENGES: &[Challenge<OptimalPlane>] = &[
    Challenge {
        id: "least",
        goal: "Turn the plane until the squares add up to the least.",
        hint: "At the start the plane contains the ray of p, and all of the error is in photograph 2. Let \
               photograph 1 take a part.",
        why: "Squares punish one large miss more than two smaller ones, so both pixels give way.",
        check: |model| {
            let miss = |state: &State| state.at(model.angle_deg()).map(|(_, miss)| miss.sum_sq());
            let state = model.state();
            state.is_some_and(|state| {
                miss(&state).is_some_and(|sum| sum < 1.02 * state.best.1.sum_sq())
            })
        },
        solution: || {
            let best = OptimalPlane::new()
                .state()
                .map_or(0.0, |state| state.best.0);
            vec![Event::moved(PLANE.id(), best, 0.0)]
        },
    },
    Challenge {
        id: "near",
        goal: "Place camera 2 so that in the best plane p′ misses by less than half as much as p.",
        hint: "Which camera knows better where P is?",
        why: "From near by, the same turn of the plane moves its line over more pixels. So the near photograph \
              settles where the plane is, and the far one takes the error.",
        check: |model| {
            let best = model.state().map(|state| state.best.1.px);
            best.is_some_and(|[first, second]| second < 0.5 * first)
        },
        solution: || vec![Event::set(&FORWARD, 0.6)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn after(events: &[Event]) -> OptimalPlane {
        let mut model = OptimalPlane::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn no_plane_is_better_than_the_best() {
        for forward in [-0.4, -0.1, 0.2, 0.5, 0.7] {
            let state = after(&[Event::set(&FORWARD, forward)]).state().unwrap();
            let (best_deg, best) = state.best;
            assert!(best_deg.abs() < REACH_DEG, "{best_deg}");
            for step in -890..=890 {
                let Some((_, miss)) = state.at(f64::from(step) * 0.1) else {
                    continue;
                };
                // The core's correction is optimal to first order in these large displacements.
                assert!(
                    miss.sum_sq() > 0.99 * best.sum_sq(),
                    "{step}: {miss:?} {best:?}"
                );
            }
        }
    }

    #[test]
    fn the_plane_through_p_leaves_all_of_the_error_to_the_other() {
        let model = OptimalPlane::new();
        let state = model.state().unwrap();
        let (_, miss) = state.at(model.angle_deg()).unwrap();
        assert!(
            miss.px[0] < 1e-9 && (miss.px[1] - 40.0).abs() < 1e-6,
            "{miss:?}"
        );
        assert!(state.best.1.sum_sq() < 0.7 * miss.sum_sq());
    }

    #[test]
    fn the_nearer_camera_keeps_its_pixel() {
        let share = |forward: f64| {
            let [first, second] = after(&[Event::set(&FORWARD, forward)])
                .state()
                .unwrap()
                .best
                .1
                .px;
            second / first
        };
        let shares = [-0.4, 0.0, 0.4, 0.7].map(share);
        assert!(
            shares.windows(2).all(|pair| pair[1] < pair[0]),
            "{shares:?}"
        );
    }

    #[test]
    fn without_a_match_there_are_words() {
        let model = after(&[Event::moved("p", 2.0, 470.0), Event::set(&FORWARD, 0.7)]);
        assert!(model.state().is_none() && model.describe().contains("Camera 2"));
    }
}
