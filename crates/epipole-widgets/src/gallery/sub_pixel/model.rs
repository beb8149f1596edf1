//! A corner, the initial position of its refinement, and the iterations.

use super::patch::{CORNER, SIZE, picture};
use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, knobs,
};
use crate::kit::probe::{Probe, place_words};
use epipole::feature::{RefineOptions, refine_corners};
use epipole::imaging::GrayImage32;
use nalgebra::Point2;

const OPENING: Slider = Slider::new("opening", "Angle of edges")
    .range(20.0, 176.0, 2.0)
    .at(80.0)
    .unit("°");
const NOISE: Slider = Slider::new("noise", "Noise σ")
    .range(0.0, 40.0, 1.0)
    .at(3.0)
    .unit("levels");
const WINDOW: Slider = Slider::new("window", "Window")
    .range(3.0, 19.0, 2.0)
    .at(11.0)
    .unit("px");
const KNOBS: &[Knob] = knobs![OPENING, NOISE, WINDOW];
const START: Probe = Probe::new("start", "patch", "Start")
    .over(SIZE)
    .step(0.5)
    .digits(1)
    .told(|place| place_words(place, 1))
    .at(19.0, 11.0);
/// Maximum number of steps.
const MAX_STEPS: usize = 20;
/// Step length below which the refinement has converged, pixels.
const STAYS_PX: f64 = 1e-3;

/// The model of `sub-pixel`.
pub(crate) struct SubPixel {
    settings: Settings,
    start: Probe,
}

/// The picture and the steps.
pub(super) struct State {
    pub(super) image: GrayImage32,
    /// Initial position, and the position after each step.
    pub(super) path: Vec<Point2<f64>>,
    /// Whether the refinement has converged to a corner.
    is_found: bool,
}

impl State {
    /// Returns the corner; `None` if the window contains none.
    pub(super) fn corner(&self) -> Option<Point2<f64>> {
        self.path.last().copied().filter(|_| self.is_found)
    }

    /// Returns the distance of the corner from the true one, pixels.
    pub(super) fn error_px(&self) -> Option<f64> {
        Some((self.corner()? - CORNER).norm())
    }
}

impl SubPixel {
    /// Returns half of the window's side without its center, pixels.
    pub(super) fn half(&self) -> usize {
        self.settings.count(&WINDOW) / 2
    }

    pub(super) fn state(&self) -> State {
        let image = picture(self.settings.number(&OPENING), self.settings.number(&NOISE));
        let start = self.start.point();
        let (mut path, mut is_found) = (vec![start], true);
        for step in 1..=MAX_STEPS {
            let options = RefineOptions::default()
                .with_half_window(self.half())
                .with_max_iterations(step)
                .with_tolerance_px(STAYS_PX);
            let found = refine_corners(&image, &[start], &options, &mut ());
            let Some(corner) = found
                .ok()
                .and_then(|found| found.first().copied().flatten())
            else {
                is_found = false;
                break;
            };
            let is_moved = path
                .last()
                .is_some_and(|last| (corner - last).norm() > STAYS_PX);
            if !is_moved {
                break;
            }
            path.push(corner);
        }
        State {
            image,
            path,
            is_found,
        }
    }
}

impl Declared for SubPixel {
    const NAME: &'static str = "sub-pixel";
    const TITLE: &'static str = "A corner between the pixels";
    const HELP: &'static str = "Drag the start, and watch the steps to the corner. Each pixel with a gradient gives a \
        line on which the corner should lie. Change the edges, the noise and the window.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            start: START,
        }
    }
}

impl Model for SubPixel {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.start.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if !self.start.update(event) {
            self.settings.update(event)?;
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<SubPixel>] = &[
    Challenge {
        id: "noise",
        goal: "Set the noise to at least 10 levels, and keep the corner within 0.1 px of the truth.",
        hint: "Which slider decides how many equations there are?",
        why: "A wider window has more pixels on the edges, and least squares averages their errors.",
        check: |model| {
            let error = model.state().error_px();
            model.settings.number(&NOISE) >= 10.0 && error.is_some_and(|error| error < 0.1)
        },
        solution: || vec![Event::set(&NOISE, 10.0), Event::set(&WINDOW, 19.0)],
    },
    Challenge {
        id: "slide",
        goal: "Open the edges until the corner is off by more than a pixel.",
        hint: "Two edges that are nearly one line fix a point across them, not along them.",
        why: "The small eigenvalue of the matrix is all that holds the corner along the edge, and noise moves it.",
        check: |model| {
            let is_open = model.settings.number(&OPENING) > 120.0;
            is_open && model.state().error_px().is_none_or(|error| error > 1.0)
        },
        solution: || vec![Event::set(&OPENING, 176.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn after(events: &[Event]) -> SubPixel {
        let mut model = SubPixel::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn the_corner_is_found_well_below_a_pixel() {
        let state = SubPixel::new().state();
        let error = state.error_px().unwrap();
        assert!(error < 0.1, "{error}");
        assert!(state.path.len() >= 3 && (state.path[0] - CORNER).norm() > 2.0);
    }

    #[test]
    fn the_start_does_not_matter_within_reach() {
        let corners = [(14.0, 14.0), (19.0, 11.0), (16.0, 10.5)].map(|(x, y)| {
            after(&[Event::moved("start", x, y)])
                .state()
                .corner()
                .unwrap()
        });
        assert!(
            corners
                .iter()
                .all(|corner| (corner - corners[0]).norm() < 0.01)
        );
    }

    #[test]
    fn nothing_is_found_where_nothing_is() {
        let calm = Event::set(&NOISE, 0.0);
        let model = after(&[
            calm,
            Event::moved("start", 3.0, 3.0),
            Event::set(&WINDOW, 3.0),
        ]);
        assert!(model.state().corner().is_none() && model.describe().contains("no corner"));
    }

    #[test]
    fn edges_that_are_nearly_one_line_do_not_hold_a_corner() {
        let error = |opening: f64| after(&[Event::set(&OPENING, opening)]).state().error_px();
        assert!(error(90.0).unwrap() < 0.1);
        assert!(error(176.0).is_none_or(|error| error > 1.0));
    }
}
