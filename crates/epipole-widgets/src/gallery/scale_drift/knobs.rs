//! The controls of `scale-drift`.

use crate::contract::{Choice, Knob, Slider, Toggle};

pub(super) const DRIFT: Slider = Slider {
    id: "drift",
    label: "Drift of scale per step",
    unit: "%",
    min: -2.0,
    max: 2.0,
    step: 0.1,
    default: 1.0,
    digits: 1,
    visible: true,
};
pub(super) const NOISE: Slider = Slider {
    id: "noise",
    label: "Noise of each step",
    unit: "%",
    min: 0.0,
    max: 3.0,
    step: 0.1,
    default: 0.5,
    digits: 1,
    visible: true,
};
pub(super) const STEPS: Slider = Slider {
    id: "steps",
    label: "Steps around the block",
    unit: "",
    min: 40.0,
    max: 120.0,
    step: 4.0,
    default: 80.0,
    digits: 0,
    visible: true,
};
pub(super) const SEED: Slider = Slider::seed(7.0);
pub(super) const CLOSURE: Choice = Choice {
    id: "closure",
    label: "Loop closure",
    options: &[
        ("none", "None"),
        ("rigid", "Rigid motions, SE(3)"),
        ("similarity", "Similarities, Sim(3)"),
    ],
    default: 2,
};
pub(super) const STEREO: Toggle = Toggle {
    id: "stereo",
    label: "Stereo rig, which measures scale",
    default: false,
};
pub(super) const KNOBS: &[Knob] = &[
    Knob::Slider(&DRIFT),
    Knob::Slider(&NOISE),
    Knob::Slider(&STEPS),
    Knob::Slider(&SEED),
    Knob::Choice(&CLOSURE),
    Knob::Toggle(&STEREO),
];
