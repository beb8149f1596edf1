//! A window of a picture, the squared change for every shift, and its Taylor estimate.

use super::measure::{Found, LARGEST_HALF, REACH, SHOWN, Verdict, find, take_picture};
use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    format_number, knobs,
};
use crate::kit::probe::Probe;
use epipole::imaging::GrayImage32;
use image::RgbImage;

const WINDOW: Slider = Slider::new("window", "Window")
    .range(5.0, 21.0, 2.0)
    .at(13.0)
    .unit("px");
const NOISE: Slider = Slider::new("noise", "Noise σ")
    .range(0.0, 30.0, 1.0)
    .at(2.0)
    .unit("levels");
const THRESHOLD: Slider = Slider::new("threshold", "λ large above")
    .range(20.0, 600.0, 20.0)
    .at(100.0);
const KNOBS: &[Knob] = knobs![WINDOW, NOISE, THRESHOLD];

/// Initially on a corner of the square. The largest window stays within the visible part.
const PLACE: Probe = Probe::new("place", "picture", "Window")
    .within([room(SHOWN.0, SHOWN.2), room(SHOWN.1, SHOWN.3)])
    .step(2.0)
    .at(151.0, 143.0);
/// The tested shift: columns to the right and rows down, whole pixels.
const SHIFT: Probe = Probe::new("shift", "map", "Shift")
    .within([[-(REACH as f64), REACH as f64]; 2])
    .told(|(du, dv)| {
        let [du, dv] = [du, dv].map(|shift| format_number(shift, 0));
        format!("{du} columns right, {dv} rows down")
    })
    .at(-5.0, 4.0);
const fn room(from: u32, size: u32) -> [f64; 2] {
    let half = LARGEST_HALF;
    [(from + half) as f64, (from + size - 1 - half) as f64]
}
/// Column from which no window includes the square.
const PLAIN_FROM: f64 = 190.0;

/// The model of `window-shift`.
pub struct WindowShift {
    settings: Settings,
    pub(super) window: Probe,
    pub(super) shift: Probe,
    /// Visible part of the picture.
    pub(super) picture: RgbImage,
    /// Gray levels of the whole picture.
    gray: GrayImage32,
    found: Result<Found, epipole::Error>,
    /// Version of picture and window, for the cache of the view's map.
    pub(super) version: u64,
}

impl WindowShift {
    pub(super) fn window_px(&self) -> usize {
        self.settings.count(&WINDOW)
    }

    /// Returns the measurements of the window.
    pub(super) fn found(&self) -> Result<&Found, String> {
        let found = self.found.as_ref();
        found.map_err(|error| format!("{error}."))
    }

    pub(super) fn threshold(&self) -> f64 {
        self.settings.number(&THRESHOLD)
    }

    pub(super) fn verdict(&self, found: &Found) -> Verdict {
        found.verdict(self.threshold())
    }

    fn is_on(&self, verdict: Verdict) -> bool {
        self.found()
            .is_ok_and(|found| self.verdict(found) == verdict)
    }

    fn look(&mut self) {
        self.found = find(&self.gray, self.window.pixel(), self.window_px());
        self.version += 1;
    }
}

impl Declared for WindowShift {
    const NAME: &'static str = "window-shift";
    const TITLE: &'static str = "What does a shift change?";
    const HELP: &'static str = "Drag the window over the picture, or move it with the arrow keys; \
        click to put it elsewhere. The second handle, in the map, is the shift to try.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        let (picture, gray) = take_picture(NOISE.default);
        Self {
            found: find(&gray, PLACE.pixel(), settings.count(&WINDOW)),
            settings,
            window: PLACE,
            shift: SHIFT,
            picture,
            gray,
            version: 0,
        }
    }
}

impl Model for WindowShift {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.window.handle(), self.shift.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if let Some(id) = self.settings.update(event)? {
            if id == NOISE.id {
                (self.picture, self.gray) = take_picture(self.settings.number(&NOISE));
            }
            if id != THRESHOLD.id {
                self.look();
            }
        }
        if self.window.update(event) {
            self.look();
        }
        self.shift.update(event);
        Ok(())
    }
}

const CHALLENGES: &[Challenge<WindowShift>] = &[
    Challenge {
        id: "noise",
        goal: "Turn a plain place into a \"corner\" by noise alone.",
        hint: "Go far to the right of the square. How much noise does it take?",
        why: "Noise has slopes in every direction, so both eigenvalues grow with its variance: a \
              threshold must stay above it.",
        check: |model| model.window.place().0 >= PLAIN_FROM && model.is_on(Verdict::Corner),
        solution: || {
            vec![
                Event::moved("place", 200.0, 120.0),
                Event::set(&NOISE, 30.0),
            ]
        },
    },
    Challenge {
        id: "demoted",
        goal: "Leave the window on the corner, and make it count as an edge.",
        hint: "A corner needs two large eigenvalues. Large compared with what?",
        why: "Corner and edge are a choice of threshold: between the two eigenvalues, one counts as \
              large and the other does not.",
        check: |model| model.window.place() == PLACE.place() && model.is_on(Verdict::Edge),
        solution: || vec![Event::set(&THRESHOLD, 460.0)],
    },
    Challenge {
        id: "misled",
        goal: "On the corner, find a shift where Taylor is off by a factor of four.",
        hint: "The estimate is a bowl that never ends. Does the picture go on forever?",
        why: "The structure tensor knows slopes at one place only, so its estimate holds for small \
              shifts and fails for large ones.",
        check: |model| {
            let shift = model.shift.place();
            model.window.place() == PLACE.place()
                && model.found().is_ok_and(|found| {
                    let change = found.change(shift);
                    found.estimate(shift) >= 4.0 * change && change > 0.0
                })
        },
        solution: || vec![Event::moved("shift", 8.0, 8.0)],
    },
];
