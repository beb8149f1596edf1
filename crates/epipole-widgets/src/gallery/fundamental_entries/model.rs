//! Changes of the nine entries, the selected entry, and a probe.

use super::entries::{Change, Entries, Truth, cameras};
use crate::contract::{
    Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    Symbol, Toggle,
};
use crate::kit::geometry::match_symbols;
use crate::kit::matches::{distance_px, line2};
use crate::kit::probe::Probe;
use crate::kit::scenes::{PHOTO_SIZE, Seen};
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2};
use std::sync::OnceLock;

/// Maximum change of an entry.
const MOST: f64 = 0.5;

const fn change(id: &'static str, label: &'static str) -> Slider {
    Slider::new(id, label).range(-MOST, MOST, 0.01).digits(2)
}

static ENTRY: Choice = Choice::new(
    "entry",
    "Entry",
    &[
        ("f11", "F₁₁"),
        ("f12", "F₁₂"),
        ("f13", "F₁₃"),
        ("f21", "F₂₁"),
        ("f22", "F₂₂"),
        ("f23", "F₂₃"),
        ("f31", "F₃₁"),
        ("f32", "F₃₂"),
        ("f33", "F₃₃"),
    ],
)
.at(8);
/// Change of the selected entry; the hidden sliders hold those of all nine.
static CHANGE: Slider = change("change", "Change it by");
static CHANGES: [Slider; 9] = [
    change("f11", "Change of F₁₁").hidden(),
    change("f12", "Change of F₁₂").hidden(),
    change("f13", "Change of F₁₃").hidden(),
    change("f21", "Change of F₂₁").hidden(),
    change("f22", "Change of F₂₂").hidden(),
    change("f23", "Change of F₂₃").hidden(),
    change("f31", "Change of F₃₁").hidden(),
    change("f32", "Change of F₃₂").hidden(),
    change("f33", "Change of F₃₃").hidden(),
];
static SCALE: Slider = Slider::new("scale", "Scale all nine")
    .range(-2.0, 2.0, 0.5)
    .at(1.0)
    .digits(1);
static RANK2: Toggle = Toggle::new("rank2", "Enforce rank 2");
static NORMALIZE: Toggle = Toggle::new("normalize", "Normalize").on();
static KNOBS: [Knob; 14] = [
    ENTRY.knob(),
    CHANGE.knob(),
    SCALE.knob(),
    RANK2.knob(),
    NORMALIZE.knob(),
    CHANGES[0].knob(),
    CHANGES[1].knob(),
    CHANGES[2].knob(),
    CHANGES[3].knob(),
    CHANGES[4].knob(),
    CHANGES[5].knob(),
    CHANGES[6].knob(),
    CHANGES[7].knob(),
    CHANGES[8].knob(),
];
/// Panel of the nine entries; a click on one selects it.
pub(super) const MATRIX: &str = "matrix";

/// Initially on an orange.
const PROBE: Probe = Probe::new("probe", "first", "Probe in photograph 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .at(291.0, 332.0);

/// The model of `fundamental-entries`.
pub(crate) struct FundamentalEntries {
    settings: Settings,
    probe: Probe,
    entries: Result<Entries, String>,
}

/// Returns the matches and the true F.
fn truth() -> Option<&'static Truth> {
    static TRUTH: OnceLock<Option<Truth>> = OnceLock::new();
    TRUTH.get_or_init(Truth::new).as_ref()
}

impl FundamentalEntries {
    /// Returns the nine entries and their lines, or a message why there are none.
    pub(super) fn entries(&self) -> Result<&Entries, &str> {
        self.entries.as_ref().map_err(String::as_str)
    }

    pub(super) fn truth(&self) -> Option<&'static Truth> {
        truth()
    }

    /// Returns the index of the selected entry, row by row.
    fn selected(&self) -> usize {
        self.settings.chosen(&ENTRY)
    }

    /// Returns row and column of the selected entry.
    pub(super) fn selected_place(&self) -> (usize, usize) {
        (self.selected() / 3, self.selected() % 3)
    }

    /// Returns the name of the selected entry.
    pub(super) fn selected_label(&self) -> &'static str {
        self.settings.label(&ENTRY)
    }

    pub(super) fn change(&self) -> Change {
        let by = CHANGES
            .each_ref()
            .map(|slider| self.settings.number(slider));
        Change {
            is_normalized: self.settings.flag(&NORMALIZE),
            by: Matrix3::from_row_slice(&by),
            has_rank2: self.settings.flag(&RANK2),
            scale: self.settings.number(&SCALE),
        }
    }

    pub(super) fn probe(&self) -> Point2<f64> {
        self.probe.point()
    }

    /// Returns the exact match of the probe, if it is visible in photograph 2.
    pub(super) fn probe_match(&self) -> Option<Point2<f64>> {
        match Seen::of(&cameras(), &self.probe()) {
            Seen::Visible(pixel2) => Some(pixel2),
            _ => None,
        }
    }

    /// Returns the epipolar line of the probe.
    pub(super) fn probe_line(&self) -> Option<Line2> {
        line2(&self.entries().ok()?.fundamental, &self.probe())
    }

    /// Returns the distance of the probe's match from its line, pixels.
    pub(super) fn probe_px(&self) -> Option<f64> {
        let found = (self.probe(), self.probe_match()?);
        distance_px(&self.entries().ok()?.fundamental, &found)
    }

    /// Returns the mean distance of the matches from their lines, pixels.
    pub(super) fn mean_px(&self) -> Option<f64> {
        self.entries().ok()?.mean_px
    }

    /// Returns the mean distance of the lines from one point, pixels.
    pub(super) fn miss_px(&self) -> Option<f64> {
        Some(self.entries().ok()?.meeting?.shown_px())
    }

    fn compute(&mut self) {
        let change = self.change();
        self.entries = match truth().map(|truth| Entries::new(truth, &change)) {
            Some(Ok(entries)) => Ok(entries),
            Some(Err(error)) => Err(format!("There is no F: {error}.")),
            None => Err("There is no F: both cameras have the same center.".to_owned()),
        };
    }

    fn select(&mut self, index: usize) {
        self.settings.choose(&ENTRY, index);
        self.show_change();
    }

    /// Sets the visible slider to the change of the selected entry.
    fn show_change(&mut self) {
        let by = self.settings.number(&CHANGES[self.selected()]);
        self.settings.slide(&CHANGE, by);
    }
}

impl Declared for FundamentalEntries {
    const NAME: &'static str = "fundamental-entries";
    const TITLE: &'static str = "Nine numbers draw the lines";
    const HELP: &'static str = "Click an entry of F, or choose it from the list, and change it with the slider: the \
        epipolar lines in photograph 2 follow. Drag the probe over photograph 1, or move it with the arrow keys.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(&KNOBS),
            probe: PROBE,
            entries: Err(String::new()),
        };
        model.compute();
        model
    }
}

impl Model for FundamentalEntries {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    /// Returns the symbols of the probe.
    fn symbols(&self) -> Vec<Symbol> {
        match_symbols([Some(self.probe()), self.probe_match()], self.probe_line())
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.probe.update(event) {
            return Ok(());
        }
        match event {
            Event::Clicked { panel, x, y } if panel == MATRIX => {
                let [column, row] = [x, y].map(|at| at.clamp(0.0, 2.0) as usize);
                self.select(3 * row + column);
            }
            _ => {
                if let Some(id) = self.settings.update(event)? {
                    if id == CHANGE.id {
                        let by = self.settings.number(&CHANGE);
                        self.settings.slide(&CHANGES[self.selected()], by);
                    }
                    self.show_change();
                    self.compute();
                }
            }
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<FundamentalEntries>] = &[
    Challenge {
        id: "scale",
        goal: "Change all nine numbers and move no line.",
        hint: "What do F and its lines have in common if every entry is doubled?",
        why: "A line (a, b, c) and a multiple of it are the same line, so F is known only up to its scale.",
        check: |model| {
            model.settings.number(&SCALE) != SCALE.default
                && model.mean_px().is_some_and(|mean_px| mean_px < 0.01)
        },
        solution: || vec![Event::set(&SCALE, 2.0)],
    },
    Challenge {
        id: "compensate",
        goal: "With Normalize on and Enforce rank 2 off, change F₁₁ by 0.10 and make the lines meet within 2 px.",
        hint: "det F is no longer zero. Which other entry moves it, and which way?",
        why: "det F = 0 ties each number to the other eight. The scale is free, so seven numbers are left, and these \
              lines belong to two other cameras.",
        check: |model| {
            let change = model.change();
            let is_changed = change.by[(0, 0)].abs() > 0.095;
            let is_free = change.is_normalized && !change.has_rank2;
            is_changed && is_free && model.miss_px().is_some_and(|miss_px| miss_px < 2.0)
        },
        solution: || {
            vec![
                Event::set(&ENTRY, "f11"),
                Event::set(&CHANGE, 0.1),
                Event::set(&ENTRY, "f13"),
                Event::set(&CHANGE, 0.24),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn changed(events: &[Event]) -> FundamentalEntries {
        let mut model = FundamentalEntries::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn a_click_selects_an_entry_and_the_slider_shows_its_change() {
        let mut model = changed(&[Event::clicked(MATRIX, 0.3, 2.9), Event::set(&CHANGE, 0.2)]);
        assert_eq!(
            (model.selected_label(), model.selected_place()),
            ("F₃₁", (2, 0))
        );
        assert_eq!(
            model.change().by,
            Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0)
        );
        model.update(&Event::clicked(MATRIX, 3.0, 0.0)).unwrap();
        assert_eq!(
            (model.selected_label(), model.settings.number(&CHANGE)),
            ("F₁₃", 0.0)
        );
        model.update(&Event::set(&ENTRY, "f31")).unwrap();
        assert_eq!(model.settings.number(&CHANGE), 0.2);
        // A permalink sets the hidden sliders.
        model.update(&Event::set(&CHANGES[6], -0.1)).unwrap();
        assert_eq!(model.settings.number(&CHANGE), -0.1);
    }

    #[test]
    fn the_probe_is_matched_and_its_line_follows() {
        let model = FundamentalEntries::new();
        assert!(model.probe_match().is_some() && model.probe_px().unwrap() < 1e-6);
        let model = changed(&[Event::set(&CHANGES[8], 0.2)]);
        assert!(model.probe_px().unwrap() > 10.0);
    }

    #[test]
    fn nine_zeros_draw_no_line_and_say_so() {
        let model = changed(&[Event::set(&SCALE, 0.0)]);
        assert!(model.mean_px().is_none() && model.probe_line().is_none());
        assert_eq!(model.describe(), super::super::words::NO_LINES);
        let ids =
            |model: &FundamentalEntries| model.readouts().iter().map(|r| r.id).collect::<Vec<_>>();
        assert_eq!(ids(&model), ids(&FundamentalEntries::new()));
    }

    #[test]
    fn a_change_of_f11_alone_does_not_make_the_lines_meet() {
        for by in [-0.5, -0.1, 0.1, 0.5] {
            let model = changed(&[Event::set(&CHANGES[0], by)]);
            assert!(model.miss_px().is_none_or(|miss_px| miss_px > 10.0));
            assert!(
                CHALLENGES
                    .iter()
                    .all(|challenge| !(challenge.check)(&model))
            );
        }
    }
}
