//! An axis of a plot: its range, ticks and numbers.

use crate::contract::format_number;

/// Minimum spacing of names along an axis of named items, CSS pixels.
const NAMES: f64 = 20.0;

/// Names of nine singular values.
pub(crate) const SIGMAS: &[&str] = &["σ₁", "σ₂", "σ₃", "σ₄", "σ₅", "σ₆", "σ₇", "σ₈", "σ₉"];

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    Linear,
    /// Linear, without ticks.
    Bare,
    /// Logarithmic: each power of ten has the same length.
    Decades,
}

/// An axis of a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ruler {
    /// Start of the range, in the panel's world.
    pub(super) from: f64,
    pub(super) to: f64,
    scale: Scale,
    /// Name below a horizontal axis; the plot's title names a vertical axis.
    pub(super) name: &'static str,
    /// Unit after each number.
    unit: &'static str,
    /// Factor applied to displayed numbers.
    times: f64,
    /// Names at 1, 2, 3 …, in place of numbers.
    names: &'static [&'static str],
}

impl Ruler {
    /// Creates a linear axis from `from` to `to`.
    pub(crate) fn linear(from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            scale: Scale::Linear,
            name: "",
            unit: "",
            times: 1.0,
            names: &[],
        }
    }

    /// Creates a linear axis without ticks.
    pub(crate) fn bare(from: f64, to: f64) -> Self {
        Self {
            scale: Scale::Bare,
            ..Self::linear(from, to)
        }
    }

    /// Creates an axis of named items, counted from 1.
    pub(crate) fn things(names: &'static [&'static str]) -> Self {
        Self {
            names,
            ..Self::linear(0.5, names.len() as f64 + 0.5)
        }
    }

    /// Creates a logarithmic axis from `10^from` to `10^to`.
    pub(crate) fn decades(from: f64, to: f64) -> Self {
        Self {
            scale: Scale::Decades,
            ..Self::linear(from, to)
        }
    }

    /// Sets the name below the axis.
    pub(crate) fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// Sets the unit of the displayed numbers and their factor, for example for percent.
    pub(crate) fn shown(self, times: f64, unit: &'static str) -> Self {
        Self {
            times,
            unit,
            ..self
        }
    }

    /// Returns positions and labels of the ticks that fit an axis of this length, CSS pixels.
    ///
    /// * `apart`: minimum spacing of the numbers, CSS pixels
    pub(super) fn ticks(&self, length: f64, apart: f64) -> Vec<(f64, String)> {
        if !self.names.is_empty() {
            let every = (self.names.len() as f64 * NAMES / length.max(1.0)).ceil();
            let names = self.names.iter().enumerate().step_by(every as usize);
            return names
                .map(|(k, name)| (k as f64 + 1.0, (*name).to_owned()))
                .collect();
        }
        if self.scale == Scale::Bare {
            return Vec::new();
        }
        let most = length / apart;
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        if self.scale == Scale::Decades && high - low < 2.0 {
            return within_decades(low, high);
        }
        let step = match self.scale {
            Scale::Linear | Scale::Bare => {
                round_step(self.times * (high - low) / most.max(1.0)) / self.times
            }
            Scale::Decades => ((high - low) / most.max(1.0)).ceil().max(1.0),
        };
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let text = |at: f64| match self.scale {
            Scale::Linear | Scale::Bare => {
                let step = step * self.times;
                let digits = (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 6.0) as usize;
                format!("{}{}", format_number(at * self.times, digits), self.unit)
            }
            // All numbers of an axis use the same notation.
            Scale::Decades if first as f64 * step < -3.0 || last as f64 * step > 3.0 => {
                format!("10^{}", format_number(at, 0))
            }
            Scale::Decades => power_of_ten(at as i32),
        };
        (first..=last.min(first + 100))
            .map(|index| {
                let at = index as f64 * step;
                (at, text(at))
            })
            .collect()
    }
}

/// Rounds up to 1, 2, 5, 10, 20 …
fn round_step(step: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(step.max(1e-300))));
    let times = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|n| n * power >= step * (1.0 - 1e-9));
    times.unwrap_or(10.0) * power
}

/// Writes a power of ten in full.
fn power_of_ten(power: i32) -> String {
    format_number(libm::exp10(f64::from(power)), (-power).max(0) as usize)
}

/// Returns ticks at 1, 2, 5, 10, 20 … for an axis of about one decade or less.
fn within_decades(low: f64, high: f64) -> Vec<(f64, String)> {
    let powers = libm::floor(low) as i32..=libm::floor(high) as i32;
    let ticks = powers.flat_map(|power| {
        [1.0, 2.0, 5.0].map(|times| {
            let value = times * libm::exp10(f64::from(power));
            (
                libm::log10(value),
                format_number(value, (-power).max(0) as usize),
            )
        })
    });
    let is_inside = |(at, _): &(f64, String)| (low - 1e-9..=high + 1e-9).contains(at);
    ticks.filter(is_inside).collect()
}

/// Converts a value to the world of a logarithmic axis; zero and negative values are mapped far
/// below.
pub(crate) fn decade(value: f64) -> f64 {
    libm::log10(value.max(1e-300))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ruler: &Ruler, most: f64) -> Vec<String> {
        ruler
            .ticks(most, 1.0)
            .into_iter()
            .map(|(_, text)| text)
            .collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(
            texts(&Ruler::linear(0.0, 8.3), 5.0),
            ["0", "2", "4", "6", "8"]
        );
        assert_eq!(
            texts(&Ruler::linear(-0.3, 0.3), 3.0),
            ["−0.2", "0.0", "0.2"]
        );
        let shares = Ruler::linear(0.1, 0.9).shown(100.0, "%");
        assert_eq!(texts(&shares, 5.0), ["20%", "40%", "60%", "80%"]);
    }

    #[test]
    fn things_have_names_as_far_as_there_is_room() {
        let ruler = Ruler::things(&["a", "b", "c", "d", "e"]);
        assert_eq!(ruler.ticks(200.0, 1.0).len(), 5);
        let few = ruler.ticks(60.0, 1.0);
        let few: Vec<_> = few.iter().map(|(at, name)| (*at, &**name)).collect();
        assert_eq!(few, [(1.0, "a"), (3.0, "c"), (5.0, "e")]);
    }

    #[test]
    fn decades_are_powers_of_ten() {
        let ruler = Ruler::decades(-1.2, 4.4);
        assert_eq!(
            texts(&ruler, 10.0),
            ["10^−1", "10^0", "10^1", "10^2", "10^3", "10^4"]
        );
        assert_eq!(texts(&ruler, 2.0), ["1", "1000"]);
        assert_eq!(
            texts(&Ruler::decades(-3.0, 1.0), 4.0),
            ["0.001", "0.01", "0.1", "1", "10"]
        );
        assert_eq!(
            texts(&Ruler::decades(-0.4, 0.7), 3.0),
            ["0.5", "1", "2", "5"]
        );
        assert!((decade(1000.0) - 3.0).abs() < 1e-12 && decade(0.0) < -200.0);
    }
}
