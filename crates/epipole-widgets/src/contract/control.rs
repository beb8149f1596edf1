//! Controls beside the picture. Each becomes a native input of the page.

use super::decimal::parse_decimal;
use super::readout::{format_number, with_unit};
use serde::Serialize;

/// Placement of a control on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// Beside or below the picture, always.
    First,
    /// Folded away with the rarely used controls, such as a seed.
    More,
    /// Nowhere: it is part of the permalink only.
    Hidden,
}

/// A number set by a slider.
///
/// ```
/// use epipole_widgets::contract::Slider;
/// const BASELINE: Slider = Slider::new("baseline", "Baseline").range(0.05, 0.5, 0.05).at(0.2).digits(2).unit("m");
/// const SEED: Slider = Slider::seed(7.0);
/// assert_eq!(BASELINE.snap(0.26), 0.25);
/// ```
#[derive(Debug, PartialEq)]
pub struct Slider {
    /// Permanent name: attribute, URL parameter and property.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// Unit after the value, such as "m"; empty for a pure number.
    pub unit: &'static str,
    /// Minimum value.
    pub min: f64,
    /// Maximum value.
    pub max: f64,
    /// Step between neighboring values, starting at `min`.
    pub step: f64,
    /// Initial value; with it, the figure must make its point.
    pub default: f64,
    /// Digits after the decimal point, enough to distinguish neighboring values.
    pub digits: usize,
    /// Placement on the page.
    pub place: Place,
}

/// A switch that is on or off.
#[derive(Debug, PartialEq, Eq)]
pub struct Toggle {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// Initial state.
    pub default: bool,
    /// Placement on the page.
    pub place: Place,
}

/// One of a few named options.
#[derive(Debug, PartialEq, Eq)]
pub struct Choice {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// Permanent name and label of each option.
    pub options: &'static [(&'static str, &'static str)],
    /// Index of the initial option.
    pub default: usize,
    /// Placement on the page.
    pub place: Place,
}

/// An action started by a press.
#[derive(Debug, PartialEq, Eq)]
pub struct Button {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// Kind of action.
    pub role: ButtonRole,
    /// Placement on the page.
    pub place: Place,
}

/// Kind of action of a button, from which a page chooses its position and icon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum ButtonRole {
    /// Starts and stops an animation.
    Run,
    /// Advances the animation by one step.
    Step,
    /// Returns the animation to its start.
    Restart,
    /// Anything else.
    Action,
}

/// A control with its present value: what a page needs to show it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Control {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// Kind, range and value.
    #[serde(flatten)]
    pub kind: ControlKind,
    /// The value in words for a screen reader, such as "0.30 m".
    pub value_text: String,
    /// False when it can do nothing now; it stays discoverable.
    pub enabled: bool,
    /// Placement on the page.
    pub place: Place,
}

/// The four kinds of control.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum ControlKind {
    /// A number in steps.
    Slider {
        /// Unit after the value.
        unit: &'static str,
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Distance between neighboring values.
        step: f64,
        /// Value at the start.
        default: f64,
        /// Digits after the decimal point.
        digits: usize,
        /// Present value.
        value: f64,
    },
    /// On or off.
    Toggle {
        /// State at the start.
        default: bool,
        /// Present state.
        value: bool,
    },
    /// One of several.
    Choice {
        /// Permanent name and label of each option.
        options: &'static [(&'static str, &'static str)],
        /// Permanent name of the option at the start.
        default: &'static str,
        /// Permanent name of the present option.
        value: &'static str,
    },
    /// An action.
    Button {
        /// Kind of action.
        role: ButtonRole,
        /// True while the animation that it starts is running.
        pressed: bool,
    },
}

impl Slider {
    /// Creates a slider from 0 to 1 in steps of 0.01, initially 0.
    pub const fn new(id: &'static str, label: &'static str) -> Self {
        Self {
            id,
            label,
            unit: "",
            min: 0.0,
            max: 1.0,
            step: 0.01,
            default: 0.0,
            digits: 0,
            place: Place::First,
        }
    }

    /// Creates the slider of a figure's random seed.
    pub const fn seed(default: f64) -> Self {
        Self::new("seed", "Seed")
            .range(1.0, 99.0, 1.0)
            .at(default)
            .more()
    }

    /// Sets the range.
    #[must_use]
    pub const fn range(self, min: f64, max: f64, step: f64) -> Self {
        Self {
            min,
            max,
            step,
            ..self
        }
    }

    /// Sets the initial value.
    #[must_use]
    pub const fn at(self, default: f64) -> Self {
        Self { default, ..self }
    }

    /// Sets the number of digits after the decimal point.
    #[must_use]
    pub const fn digits(self, digits: usize) -> Self {
        Self { digits, ..self }
    }

    /// Sets the unit after the value.
    #[must_use]
    pub const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Folds it away with rarely used controls.
    #[must_use]
    pub const fn more(self) -> Self {
        let place = Place::More;
        Self { place, ..self }
    }

    /// Hides it: it is part of the permalink only.
    #[must_use]
    pub const fn hidden(self) -> Self {
        let place = Place::Hidden;
        Self { place, ..self }
    }

    /// Returns the nearest value on the slider's grid.
    pub fn snap(&self, value: f64) -> f64 {
        let steps = ((value.clamp(self.min, self.max) - self.min) / self.step).round();
        // The last step may be shorter. Rounded, so that the value equals its printed form when
        // parsed.
        round_to_digits((self.min + steps * self.step).min(self.max), self.digits)
    }

    pub(super) fn with_value(&'static self, value: f64) -> Control {
        Control {
            id: self.id,
            label: self.label,
            value_text: with_unit(&format_number(value, self.digits), self.unit),
            kind: ControlKind::Slider {
                unit: self.unit,
                min: self.min,
                max: self.max,
                step: self.step,
                default: self.default,
                digits: self.digits,
                value,
            },
            enabled: true,
            place: self.place,
        }
    }
}

impl Toggle {
    /// Creates a toggle that is initially off.
    pub const fn new(id: &'static str, label: &'static str) -> Self {
        Self {
            id,
            label,
            default: false,
            place: Place::First,
        }
    }

    /// Makes it initially on.
    #[must_use]
    pub const fn on(self) -> Self {
        let default = true;
        Self { default, ..self }
    }

    /// Folds it away with rarely used controls.
    #[must_use]
    pub const fn more(self) -> Self {
        let place = Place::More;
        Self { place, ..self }
    }

    pub(super) fn with_value(&'static self, value: bool) -> Control {
        Control {
            id: self.id,
            label: self.label,
            value_text: if value { "on" } else { "off" }.to_owned(),
            kind: ControlKind::Toggle {
                default: self.default,
                value,
            },
            enabled: true,
            place: self.place,
        }
    }
}

impl Choice {
    /// Creates a choice with the first option selected.
    pub const fn new(
        id: &'static str,
        label: &'static str,
        options: &'static [(&'static str, &'static str)],
    ) -> Self {
        Self {
            id,
            label,
            options,
            default: 0,
            place: Place::First,
        }
    }

    /// Selects the initial option by its index.
    #[must_use]
    pub const fn at(self, default: usize) -> Self {
        Self { default, ..self }
    }

    /// Folds it away with rarely used controls.
    #[must_use]
    pub const fn more(self) -> Self {
        let place = Place::More;
        Self { place, ..self }
    }

    pub(super) fn with_value(&'static self, index: usize) -> Control {
        Control {
            id: self.id,
            label: self.label,
            value_text: self.options[index].1.to_owned(),
            kind: ControlKind::Choice {
                options: self.options,
                default: self.options[self.default].0,
                value: self.options[index].0,
            },
            enabled: true,
            place: self.place,
        }
    }
}

impl Button {
    /// Creates a button below the picture.
    pub const fn new(id: &'static str, label: &'static str, role: ButtonRole) -> Self {
        Self {
            id,
            label,
            role,
            place: Place::First,
        }
    }

    /// Folds it away with rarely used controls.
    #[must_use]
    pub const fn more(self) -> Self {
        let place = Place::More;
        Self { place, ..self }
    }

    /// Returns the button as a control; `pressed` while the animation that it starts is running.
    pub fn control(&'static self, enabled: bool, pressed: bool) -> Control {
        Control {
            id: self.id,
            label: self.label,
            value_text: String::new(),
            kind: ControlKind::Button {
                role: self.role,
                pressed,
            },
            enabled,
            place: self.place,
        }
    }
}

/// Rounds `value` to `digits` digits after the decimal point, as printing and parsing do.
pub(crate) fn round_to_digits(value: f64, digits: usize) -> f64 {
    // Parsing cannot fail on a number that `format!` has just written.
    parse_decimal(&format!("{value:.digits$}")).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIDER: Slider = Slider::new("baseline", "Baseline")
        .range(0.05, 0.5, 0.1)
        .at(0.25)
        .digits(2)
        .unit("m");

    #[test]
    fn values_snap_to_the_grid_and_stay_in_range() {
        assert_eq!(SLIDER.snap(0.26), 0.25);
        assert_eq!(SLIDER.snap(-3.0), 0.05);
        assert_eq!(SLIDER.snap(9.0), 0.5);
        assert_eq!(SLIDER.snap(0.149_999), 0.15);
    }
}
