//! The buttons of figures that draw samples one after the other.

use crate::contract::{Button, ButtonRole};

pub(crate) const RUN: Button = Button {
    id: "run",
    label: "Run",
    role: ButtonRole::Run,
};
pub(crate) const STEP: Button = Button {
    id: "step",
    label: "Step",
    role: ButtonRole::Step,
};
pub(crate) const RESTART: Button = Button {
    id: "restart",
    label: "Start over",
    role: ButtonRole::Restart,
};
