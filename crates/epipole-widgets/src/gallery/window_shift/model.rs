//! A window on a picture, the squared change under every shift, and Taylor's estimate of it.

use super::measure::{Found, LARGEST_HALF, REACH, SHOWN, Verdict, find, take_picture};
use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider, Value,
    format_number,
};
use epipole::imaging::GrayImage32;
use image::RgbImage;

const WINDOW: Slider = Slider {
    id: "window",
    label: "Window",
    unit: "px",
    min: 5.0,
    max: 21.0,
    step: 2.0,
    default: 13.0,
    digits: 0,
    visible: true,
};
const NOISE: Slider = Slider {
    id: "noise",
    label: "Noise σ",
    unit: "gray levels",
    min: 0.0,
    max: 30.0,
    step: 1.0,
    default: 2.0,
    digits: 0,
    visible: true,
};
const THRESHOLD: Slider = Slider {
    id: "threshold",
    label: "An eigenvalue is large from, per pixel",
    unit: "",
    min: 20.0,
    max: 600.0,
    step: 20.0,
    default: 100.0,
    digits: 0,
    visible: true,
};
const KNOBS: &[Knob] = &[
    Knob::Slider(&WINDOW),
    Knob::Slider(&NOISE),
    Knob::Slider(&THRESHOLD),
];

/// The model of `window-shift`.
pub struct WindowShift {
    settings: Settings,
    /// The middle of the window: column and row, whole pixels.
    window: (f64, f64),
    /// Columns to the right and rows down, whole pixels.
    shift: (f64, f64),
    /// What is shown.
    picture: RgbImage,
    /// Gray levels of the whole picture.
    gray: GrayImage32,
    found: Result<Found, epipole::Error>,
    /// Counts pictures and places, so that the view knows when to color the map anew.
    version: u64,
}

impl WindowShift {
    pub(super) fn picture(&self) -> &RgbImage {
        &self.picture
    }

    pub(super) fn version(&self) -> u64 {
        self.version
    }

    pub(super) fn window_px(&self) -> usize {
        self.settings.count(&WINDOW)
    }

    pub(super) fn window(&self) -> (f64, f64) {
        self.window
    }

    pub(super) fn shift(&self) -> (f64, f64) {
        self.shift
    }

    /// What is found there.
    pub(super) fn found(&self) -> Result<&Found, String> {
        let found = self.found.as_ref();
        found.map_err(|error| format!("{error}."))
    }

    pub(super) fn verdict(&self, found: &Found) -> Verdict {
        found.verdict(self.settings.number(&THRESHOLD))
    }

    fn is_on(&self, verdict: Verdict) -> bool {
        self.found()
            .is_ok_and(|found| self.verdict(found) == verdict)
    }

    fn look(&mut self) {
        self.found = find(&self.gray, self.window, self.window_px());
        self.version += 1;
    }
}

impl Model for WindowShift {
    const NAME: &'static str = "window-shift";
    const TITLE: &'static str = "What does a shift change?";
    const HELP: &'static str = "Drag the window over the picture, or move it with the arrow keys; \
        click to put it elsewhere. The second handle, in the map, is the shift to try.";

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        let (picture, gray) = take_picture(NOISE.default);
        // On a corner of the square.
        let window = (151.0, 143.0);
        Self {
            found: find(&gray, window, settings.count(&WINDOW)),
            settings,
            window,
            shift: (-5.0, 4.0),
            picture,
            gray,
            version: 0,
        }
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let (left, top, width, height) = SHOWN;
        let range = |from: u32, size: u32| {
            [from + LARGEST_HALF, from + size - 1 - LARGEST_HALF].map(f64::from)
        };
        let reach = REACH as f64;
        let (u, v) = self.window;
        let (du, dv) = self.shift;
        vec![
            Handle {
                id: "place".to_owned(),
                panel: "picture",
                label: "Window".to_owned(),
                value_text: format!("column {u}, row {v}"),
                x: u,
                y: v,
                x_range: range(left, width),
                y_range: range(top, height),
                step: [2.0, 2.0],
                digits: 0,
                removable: false,
            },
            Handle {
                id: "shift".to_owned(),
                panel: "map",
                label: "Shift".to_owned(),
                value_text: format!(
                    "{} columns right, {} rows down",
                    format_number(du, 0),
                    format_number(dv, 0)
                ),
                x: du,
                y: dv,
                x_range: [-reach, reach],
                y_range: [-reach, reach],
                step: [1.0, 1.0],
                digits: 0,
                removable: false,
            },
        ]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                let changed = self.settings.set(id, value)? == Some(true);
                if changed && id == NOISE.id {
                    (self.picture, self.gray) = take_picture(self.settings.number(&NOISE));
                }
                if changed && id != THRESHOLD.id {
                    self.look();
                }
            }
            Event::HandleMoved { id, x, y } if id == "shift" => self.shift = (*x, *y),
            Event::HandleMoved { x, y, .. } => {
                self.window = (*x, *y);
                self.look();
            }
            Event::Clicked { panel, x, y } => {
                let handles = self.handles();
                let Some(handle) = handles.iter().find(|handle| handle.panel == panel) else {
                    return Ok(());
                };
                let Some(place) = handle.admit(*x, *y) else {
                    return Ok(());
                };
                if handle.id == "shift" {
                    self.shift = place;
                } else {
                    self.window = place;
                    self.look();
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        let Ok(found) = self.found() else {
            return vec![Readout::words("state", "State", self.describe())];
        };
        let verdict = match self.verdict(found) {
            Verdict::Flat => "flat: no shift changes it",
            Verdict::Edge => "edge: one direction is free",
            Verdict::Corner => "corner: every shift changes it",
        };
        let (large, small) = found.eigenvalues();
        let (du, dv) = self.shift;
        let change = found.change(du as i32, dv as i32);
        let estimate = found.estimate(self.shift);
        vec![
            Readout::words("verdict", "The window lies on", verdict),
            Readout::number("lambda1", "λ₁ per pixel", large, 0, ""),
            Readout::number("lambda2", "λ₂ per pixel", small, 0, ""),
            Readout::number("change", "Squared change per pixel", change, 0, ""),
            Readout::number("estimate", "Taylor's estimate of it", estimate, 0, ""),
        ]
    }

    fn describe(&self) -> String {
        let found = match self.found() {
            Ok(found) => found,
            Err(problem) => return problem,
        };
        let what = match self.verdict(found) {
            Verdict::Flat => "a flat place: shifts change it little in any direction",
            Verdict::Edge => "an edge: shifts along it change little, shifts across it much",
            Verdict::Corner => "a corner: every shift changes it",
        };
        let (large, small) = found.eigenvalues();
        let (du, dv) = self.shift;
        format!(
            "The window at column {}, row {} lies on {what}. Per pixel λ₁ is {} and λ₂ is {}; \
             from {} on one is large. A shift by {} columns and {} rows changes it by {}.",
            self.window.0,
            self.window.1,
            format_number(large, 0),
            format_number(small, 0),
            format_number(self.settings.number(&THRESHOLD), 0),
            format_number(du, 0),
            format_number(dv, 0),
            format_number(found.change(du as i32, dv as i32), 0),
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "edge",
                goal: "Put the window where it can slide one way without being noticed.",
                hint: "The valley of the surface points along it.",
                check: |model| model.is_on(Verdict::Edge),
                solution: || {
                    vec![Event::HandleMoved {
                        id: "place".to_owned(),
                        x: 165.0,
                        y: 102.0,
                    }]
                },
            },
            Challenge {
                id: "noise",
                goal: "Turn a flat place into a \"corner\" by noise alone.",
                hint: "Go far to the right of the square; how much noise does it take?",
                check: |model| {
                    // Right of here the square does not reach into any window.
                    model.window.0 >= 190.0 && model.is_on(Verdict::Corner)
                },
                solution: || {
                    vec![
                        Event::HandleMoved {
                            id: "place".to_owned(),
                            x: 200.0,
                            y: 120.0,
                        },
                        Event::Set {
                            id: "noise".to_owned(),
                            value: Value::Number(30.0),
                        },
                    ]
                },
            },
        ]
    }
}
