//! Knobs: the sliders, toggles and choices that a model lists as its settings.

use super::control::{Choice, Slider, Toggle};

/// An entry of a model's list of settings.
#[derive(Debug, Clone, Copy)]
pub enum Knob {
    /// A number.
    Slider(&'static Slider),
    /// On or off.
    Toggle(&'static Toggle),
    /// One of several.
    Choice(&'static Choice),
}

/// Lists a model's settings, in order, by the names of its sliders, toggles and choices.
macro_rules! knobs {
    ($($knob:expr),+ $(,)?) => {
        &[$($knob.knob()),+]
    };
}
pub(crate) use knobs;

impl From<&'static Slider> for Knob {
    fn from(slider: &'static Slider) -> Self {
        Self::Slider(slider)
    }
}

impl From<&'static Toggle> for Knob {
    fn from(toggle: &'static Toggle) -> Self {
        Self::Toggle(toggle)
    }
}

impl From<&'static Choice> for Knob {
    fn from(choice: &'static Choice) -> Self {
        Self::Choice(choice)
    }
}

impl Knob {
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Slider(slider) => slider.id,
            Self::Toggle(toggle) => toggle.id,
            Self::Choice(choice) => choice.id,
        }
    }
}

impl Slider {
    /// Returns it as an entry of a model's list of settings.
    pub(crate) const fn knob(&'static self) -> Knob {
        Knob::Slider(self)
    }
}

impl Toggle {
    /// Returns it as an entry of a model's list of settings.
    pub(crate) const fn knob(&'static self) -> Knob {
        Knob::Toggle(self)
    }
}

impl Choice {
    /// Returns it as an entry of a model's list of settings.
    pub(crate) const fn knob(&'static self) -> Knob {
        Knob::Choice(self)
    }
}
