//! The controls of `epipolar-click`.

use crate::contract::{Button, ButtonRole, Knob, Slider};

pub(super) const MAX_POINTS: usize = 6;
pub(super) const BASELINE: Slider = Slider {
    id: "baseline",
    label: "Camera 2 to the right",
    unit: "m",
    min: 0.0,
    max: 0.8,
    step: 0.02,
    default: 0.5,
    digits: 2,
    visible: true,
};
pub(super) const FORWARD: Slider = Slider {
    id: "forward",
    label: "Camera 2 forward",
    unit: "m",
    min: -0.6,
    max: 0.4,
    step: 0.02,
    default: -0.4,
    digits: 2,
    visible: true,
};
pub(super) const TURN: Slider = Slider {
    id: "turn",
    label: "Camera 2 turned left",
    unit: "°",
    min: -15.0,
    max: 30.0,
    step: 1.0,
    default: 14.0,
    digits: 0,
    visible: true,
};
/// The point that the readouts speak of; 0 stands for the last one, until one is touched.
pub(super) const SELECTED: Slider = Slider {
    id: "selected",
    label: "Selected point",
    unit: "",
    min: 0.0,
    max: MAX_POINTS as f64,
    step: 1.0,
    default: 0.0,
    digits: 0,
    visible: false,
};
pub(super) const KNOBS: &[Knob] = &[
    Knob::Slider(&BASELINE),
    Knob::Slider(&FORWARD),
    Knob::Slider(&TURN),
    Knob::Slider(&SELECTED),
];
pub(super) const ADD: Button = Button {
    id: "add",
    label: "Add a point",
    role: ButtonRole::Action,
};
pub(super) const REMOVE: Button = Button {
    id: "remove",
    label: "Remove the last point",
    role: ButtonRole::Action,
};
