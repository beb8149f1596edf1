//! The controls of `bundle-adjustment`.

use super::run::MAX_STEPS;
use crate::contract::{Choice, Knob, Slider};
use crate::orbit::ZOOM;

pub(super) const STEPS: Slider = Slider {
    id: "steps",
    label: "Steps taken",
    unit: "",
    min: 0.0,
    max: MAX_STEPS as f64,
    step: 1.0,
    default: MAX_STEPS as f64,
    digits: 0,
    visible: true,
};
pub(super) const DISTURBANCE: Slider = Slider {
    id: "disturbance",
    label: "Disturbance at the start",
    unit: "%",
    min: 0.0,
    max: 60.0,
    step: 1.0,
    default: 8.0,
    digits: 0,
    visible: true,
};
pub(super) const NOISE: Slider = Slider {
    id: "noise",
    label: "Noise of the features",
    unit: "px",
    min: 0.0,
    max: 3.0,
    step: 0.25,
    default: 0.5,
    digits: 2,
    visible: true,
};
pub(super) const LOSS: Choice = Choice {
    id: "loss",
    label: "Loss",
    options: &[("squares", "Squares"), ("huber", "Huber, 2 px")],
    default: 0,
};
pub(super) const DAMPING: Slider = Slider {
    id: "damping",
    label: "First damping, log₁₀ λ",
    unit: "",
    min: -6.0,
    max: 4.0,
    step: 1.0,
    default: -2.0,
    digits: 0,
    visible: true,
};
pub(super) const SEED: Slider = Slider::seed(4.0);
pub(super) const KNOBS: &[Knob] = &[
    Knob::Slider(&DISTURBANCE),
    Knob::Slider(&NOISE),
    Knob::Choice(&LOSS),
    Knob::Slider(&DAMPING),
    Knob::Slider(&STEPS),
    Knob::Slider(&SEED),
    Knob::Slider(&ZOOM),
];
