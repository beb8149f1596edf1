//! Events, the only way to change a figure's state.

use super::decimal::parse_decimal;
use super::knob::Knob;
use serde::{Deserialize, Serialize};
use std::fmt;

/// An input from the reader, from a permalink or from the clock.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[cfg_attr(test, ts(rename = "FigureEvent"))]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum Event {
    /// A slider, toggle or choice takes a value.
    Set {
        /// The control.
        id: String,
        /// Its new value.
        value: Value,
    },
    /// A button is pressed.
    Press {
        /// The control.
        id: String,
    },
    /// A handle is moved, by mouse, finger or arrow keys.
    HandleMoved {
        /// The handle.
        id: String,
        /// New place in the world units of its panel.
        x: f64,
        /// New place in the world units of its panel.
        y: f64,
    },
    /// A removable handle is removed.
    HandleRemoved {
        /// The handle.
        id: String,
    },
    /// A click or tap in a panel, on no handle.
    Clicked {
        /// The panel.
        panel: String,
        /// Place in the panel's world units.
        x: f64,
        /// Place in the panel's world units.
        y: f64,
    },
    /// Time passes while an animation is running.
    Tick {
        /// Seconds since the last tick.
        dt_s: f64,
    },
    /// Everything returns to the defaults.
    Reset,
}

impl Event {
    /// Sets a slider, toggle or choice.
    ///
    /// ```
    /// use epipole_widgets::contract::{Event, Slider};
    /// const BASELINE: Slider = Slider::new("baseline", "Baseline");
    /// let event = Event::set(&BASELINE, 0.3);
    /// assert_eq!(event, Event::Set { id: "baseline".into(), value: 0.3.into() });
    /// ```
    pub fn set(knob: impl Into<Knob>, value: impl Into<Value>) -> Self {
        Self::Set {
            id: knob.into().id().to_owned(),
            value: value.into(),
        }
    }

    /// Presses a button.
    pub fn press(id: &str) -> Self {
        Self::Press { id: id.to_owned() }
    }

    /// Moves a handle to a position in the world units of its panel.
    pub fn moved(id: &str, x: f64, y: f64) -> Self {
        let id = id.to_owned();
        Self::HandleMoved { id, x, y }
    }

    /// Clicks in a panel at a position in its world units.
    pub fn clicked(panel: &str, x: f64, y: f64) -> Self {
        let panel = panel.to_owned();
        Self::Clicked { panel, x, y }
    }
}

/// The value of a control, from an attribute, a URL or an input of the page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(untagged)]
pub enum Value {
    /// On or off.
    Flag(bool),
    /// A slider's value.
    Number(f64),
    /// The text of any value.
    Text(String),
}

impl Value {
    /// Returns the value as a finite number.
    pub fn number(&self) -> Option<f64> {
        let number = match self {
            Self::Number(number) => *number,
            Self::Text(text) => parse_decimal(text)?,
            Self::Flag(_) => return None,
        };
        number.is_finite().then_some(number)
    }

    /// Returns the value as a flag; an attribute without a value is on.
    pub fn flag(&self) -> Option<bool> {
        match self {
            Self::Flag(flag) => Some(*flag),
            Self::Number(_) => None,
            Self::Text(text) => match text.trim() {
                "" | "true" | "on" | "1" => Some(true),
                "false" | "off" | "0" => Some(false),
                _ => None,
            },
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => flag.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => text.fmt(f),
        }
    }
}
