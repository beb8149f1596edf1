//! What the reader can set.

use super::run::MAX_SAMPLES;
use crate::contract::{Choice, Knob, PhotoSlot, Slider, Toggle};

pub(super) const SOURCE: Choice = Choice {
    id: "source",
    label: "Photographs",
    options: &[("still-life", "Still life"), ("own", "Your photographs")],
    default: 0,
};
pub(super) const OWN: usize = 1;
pub(super) const SHOW: Choice = Choice {
    id: "show",
    label: "Show",
    options: &[
        ("matches", "Matches"),
        ("outliers", "Outliers only"),
        ("lines", "Epipolar lines"),
    ],
    default: 0,
};
pub(super) const RATIO: Slider = Slider {
    id: "ratio",
    label: "Ratio test τ",
    unit: "",
    min: 0.5,
    max: 1.0,
    step: 0.05,
    default: 0.9,
    digits: 2,
    visible: true,
};
pub(super) const EPSILON: Slider = Slider {
    id: "epsilon",
    label: "Threshold ε",
    unit: "px",
    min: 0.2,
    max: 10.0,
    step: 0.2,
    default: 1.0,
    digits: 1,
    visible: true,
};
pub(super) const LOCAL: Toggle = Toggle {
    id: "local",
    label: "Local optimization",
    default: false,
};
pub(super) const SEED: Slider = Slider::seed(1.0);
/// Asked for; the loop ends before when enough have been drawn.
pub(super) const ITERATIONS: Slider = Slider {
    id: "iterations",
    label: "Samples drawn",
    unit: "",
    min: 0.0,
    max: MAX_SAMPLES as f64,
    step: 1.0,
    default: MAX_SAMPLES as f64,
    digits: 0,
    visible: false,
};
pub(super) const KNOBS: &[Knob] = &[
    Knob::Choice(&SOURCE),
    Knob::Choice(&SHOW),
    Knob::Slider(&EPSILON),
    Knob::Slider(&RATIO),
    Knob::Toggle(&LOCAL),
    Knob::Slider(&SEED),
    Knob::Slider(&ITERATIONS),
];

pub(super) const SLOTS: &[PhotoSlot] = &[
    PhotoSlot {
        id: "first",
        label: "Your photograph 1",
        max_side_px: 640,
    },
    PhotoSlot {
        id: "second",
        label: "Your photograph 2",
        max_side_px: 640,
    },
];
