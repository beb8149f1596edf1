//! Current values of a model's sliders, toggles and choices.

use super::control::{Choice, Control, Slider, Toggle};
use super::event::{Event, Value};
use super::knob::Knob;
use super::problem::Problem;

/// Values of a list of knobs, accessed by the knob itself, so that a misspelled name cannot
/// compile.
#[derive(Debug, Clone)]
pub struct Settings {
    knobs: &'static [Knob],
    /// Value of a slider, 0 or 1 for a toggle, index for a choice.
    values: Vec<f64>,
}

impl Settings {
    /// Creates settings with all knobs at their defaults.
    pub fn new(knobs: &'static [Knob]) -> Self {
        let default = |knob: &Knob| match knob {
            Knob::Slider(slider) => slider.default,
            Knob::Toggle(toggle) => f64::from(u8::from(toggle.default)),
            Knob::Choice(choice) => choice.default as f64,
        };
        Self {
            knobs,
            values: knobs.iter().map(default).collect(),
        }
    }

    fn raw(&self, id: &str) -> f64 {
        let index = self.knobs.iter().position(|knob| knob.id() == id);
        // A knob outside the model's list is a bug; tests create every model.
        self.values[index.expect("the knob is in the model's list")]
    }

    /// Returns a slider's value.
    pub fn number(&self, slider: &'static Slider) -> f64 {
        self.raw(slider.id)
    }

    /// Returns a slider's value as a count.
    pub fn count(&self, slider: &'static Slider) -> usize {
        self.raw(slider.id).max(0.0) as usize
    }

    /// Whether a toggle is on.
    pub fn flag(&self, toggle: &'static Toggle) -> bool {
        self.raw(toggle.id) != 0.0
    }

    /// Returns the index of the chosen option.
    pub fn chosen(&self, choice: &'static Choice) -> usize {
        self.raw(choice.id) as usize
    }

    /// Returns the label of the chosen option.
    pub fn label(&self, choice: &'static Choice) -> &'static str {
        choice.options[self.chosen(choice)].1
    }

    /// Returns the knobs with their values, in the model's order.
    pub fn controls(&self) -> Vec<Control> {
        let control = |(knob, value): (&Knob, &f64)| match knob {
            Knob::Slider(slider) => slider.with_value(*value),
            Knob::Toggle(toggle) => toggle.with_value(*value != 0.0),
            Knob::Choice(choice) => choice.with_value(*value as usize),
        };
        self.knobs.iter().zip(&self.values).map(control).collect()
    }

    /// Returns the same controls followed by `more`: buttons, and those of a space.
    pub fn controls_and(&self, more: impl IntoIterator<Item = Control>) -> Vec<Control> {
        let mut controls = self.controls();
        controls.extend(more);
        controls
    }

    /// Returns the same controls, enabled if `is_enabled` accepts their id.
    pub fn controls_enabled(&self, is_enabled: impl Fn(&str) -> bool) -> Vec<Control> {
        let mut controls = self.controls();
        for control in &mut controls {
            control.enabled = is_enabled(control.id);
        }
        controls
    }

    /// Sets one knob, snapping a slider to its grid. Returns whether anything changed.
    ///
    /// # Errors
    /// [`Problem::BadValue`] for a value of the wrong kind, outside the range or not
    /// finite. For an `id` that is not in the list, returns `Ok(None)`.
    pub fn set(&mut self, id: &str, value: &Value) -> Result<Option<bool>, Problem> {
        let Some(index) = self.knobs.iter().position(|knob| knob.id() == id) else {
            return Ok(None);
        };
        let bad = |expected: String| Problem::BadValue {
            name: id.to_owned(),
            value: value.to_string(),
            expected,
        };
        let new = match self.knobs[index] {
            Knob::Slider(slider) => {
                let expected = || {
                    let unit = if slider.unit.is_empty() { "" } else { " " };
                    format!(
                        "a number from {} to {}{unit}{}",
                        slider.min, slider.max, slider.unit
                    )
                };
                let number = value.number().ok_or_else(|| bad(expected()))?;
                // Tolerates half a step, since a permalink may contain a rounded value.
                let grace = slider.step / 2.0;
                if !(slider.min - grace..=slider.max + grace).contains(&number) {
                    return Err(bad(expected()));
                }
                slider.snap(number)
            }
            Knob::Toggle(_) => {
                let flag = value
                    .flag()
                    .ok_or_else(|| bad("true or false".to_owned()))?;
                f64::from(u8::from(flag))
            }
            Knob::Choice(choice) => {
                let name = value.to_string();
                let index = choice.options.iter().position(|option| option.0 == name);
                index.ok_or_else(|| {
                    let names: Vec<&str> = choice.options.iter().map(|option| option.0).collect();
                    bad(names.join(" or "))
                })? as f64
            }
        };
        let changed = self.values[index] != new;
        self.values[index] = new;
        Ok(Some(changed))
    }

    /// Applies an event and returns the name of the knob that it changed, if any.
    ///
    /// # Errors
    /// As [`Settings::set`].
    pub fn update(&mut self, event: &Event) -> Result<Option<&'static str>, Problem> {
        let Event::Set { id, value } = event else {
            return Ok(None);
        };
        let changed = self.set(id, value)? == Some(true);
        let knob = self.knobs.iter().find(|knob| changed && knob.id() == id);
        Ok(knob.map(|knob| knob.id()))
    }

    /// Moves a slider to a number, clamped to its range. Ignores NaN.
    pub fn slide(&mut self, slider: &'static Slider, number: f64) {
        let index = self.knobs.iter().position(|knob| knob.id() == slider.id);
        if let Some(index) = index.filter(|_| !number.is_nan()) {
            self.values[index] = slider.snap(number);
        }
    }

    /// Chooses one of the options, by its index.
    pub fn choose(&mut self, choice: &'static Choice, option: usize) {
        let index = self.knobs.iter().position(|knob| knob.id() == choice.id);
        if let Some(index) = index.filter(|_| option < choice.options.len()) {
            self.values[index] = option as f64;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: Slider = Slider::new("count", "Points").range(2.0, 10.0, 1.0).at(5.0);
    const NOISE: Toggle = Toggle::new("noise", "Noise").on();
    const METHOD: Choice = Choice::new(
        "method",
        "Method",
        &[("bm", "Block matching"), ("sgm", "Semi-global")],
    )
    .at(1);
    const KNOBS: &[Knob] = &[
        Knob::Slider(&COUNT),
        Knob::Toggle(&NOISE),
        Knob::Choice(&METHOD),
    ];

    #[test]
    fn every_kind_is_set_and_read() {
        let mut settings = Settings::new(KNOBS);
        assert_eq!(settings.set("count", &Value::Number(7.2)), Ok(Some(true)));
        assert_eq!(settings.set("noise", &Value::from("false")), Ok(Some(true)));
        assert_eq!(settings.set("method", &Value::from("bm")), Ok(Some(true)));
        assert_eq!(settings.set("method", &Value::from("bm")), Ok(Some(false)));
        assert_eq!(settings.set("other", &Value::from("bm")), Ok(None));
        assert_eq!(settings.count(&COUNT), 7);
        assert!(!settings.flag(&NOISE));
        assert_eq!(settings.chosen(&METHOD), 0);
        assert_eq!(settings.label(&METHOD), "Block matching");
        let more = Event::set(&COUNT, 9.0);
        assert_eq!(settings.update(&more), Ok(Some("count")));
        assert_eq!(settings.update(&more), Ok(None));
        assert_eq!(settings.update(&Event::press("count")), Ok(None));
        assert!(settings.update(&Event::set(&COUNT, 99.0)).is_err());
    }

    #[test]
    fn a_slider_goes_as_far_as_it_can() {
        let mut settings = Settings::new(KNOBS);
        for (number, expected) in [(7.4, 7), (99.0, 10), (f64::NAN, 10), (-f64::INFINITY, 2)] {
            settings.slide(&COUNT, number);
            assert_eq!(settings.count(&COUNT), expected, "{number}");
        }
    }

    #[test]
    fn bad_values_are_named_with_what_is_taken() {
        let mut settings = Settings::new(KNOBS);
        for (id, value, sentence) in [
            (
                "count",
                "many",
                "\"many\" is not a value of count: it takes a number from 2 to 10",
            ),
            (
                "count",
                "11",
                "\"11\" is not a value of count: it takes a number from 2 to 10",
            ),
            (
                "count",
                "NaN",
                "\"NaN\" is not a value of count: it takes a number from 2 to 10",
            ),
            (
                "noise",
                "maybe",
                "\"maybe\" is not a value of noise: it takes true or false",
            ),
            (
                "method",
                "fast",
                "\"fast\" is not a value of method: it takes bm or sgm",
            ),
        ] {
            let problem = settings.set(id, &Value::from(value)).unwrap_err();
            assert_eq!(problem.to_string(), sentence);
        }
        assert_eq!(settings.count(&COUNT), 5, "a refused value changes nothing");
    }
}
