//! The controls of `ransac-race`.

use super::run::MAX_SAMPLES;
use crate::contract::{Knob, Slider};

pub(super) const OUTLIERS: Slider = Slider {
    id: "outliers",
    label: "Share of outliers",
    unit: "",
    min: 0.0,
    max: 0.9,
    step: 0.05,
    default: 0.4,
    digits: 2,
    visible: true,
};
pub(super) const EPSILON: Slider = Slider {
    id: "epsilon",
    label: "Threshold ε",
    unit: "px",
    min: 2.0,
    max: 40.0,
    step: 1.0,
    default: 10.0,
    digits: 0,
    visible: true,
};
pub(super) const COUNT: Slider = Slider {
    id: "points",
    label: "Number of points",
    unit: "",
    min: 8.0,
    max: 120.0,
    step: 2.0,
    default: 60.0,
    digits: 0,
    visible: true,
};
pub(super) const SEED: Slider = Slider::seed(7.0);
pub(super) const ITERATIONS: Slider = Slider {
    id: "iterations",
    label: "Samples drawn",
    unit: "",
    min: 0.0,
    max: MAX_SAMPLES as f64,
    step: 1.0,
    default: 9.0,
    digits: 0,
    visible: false,
};
pub(super) const KNOBS: &[Knob] = &[
    Knob::Slider(&OUTLIERS),
    Knob::Slider(&EPSILON),
    Knob::Slider(&COUNT),
    Knob::Slider(&SEED),
    Knob::Slider(&ITERATIONS),
];
