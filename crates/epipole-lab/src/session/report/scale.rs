//! Metric scale from all known lengths, or from control points, and disagreement of lengths.

use super::measure::Length;
use crate::project::Project;

/// Origin of the scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScaleSource {
    /// Known lengths, with their number.
    Lengths(usize),
    /// Coordinates of control points.
    ControlPoints,
}

/// Metric scale of the reconstruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Meters in a unit.
    pub meters_per_unit: f64,
    /// Its relative standard deviation.
    pub relative_sigma: f64,
    /// Its origin.
    pub source: ScaleSource,
}

/// A known length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScaleBar {
    /// Index of its measure.
    pub measure: usize,
    /// Its known length, meters.
    pub known_m: f64,
    /// Its reconstructed length, units of the reconstruction.
    pub units: Length,
}

impl ScaleBar {
    fn meters_per_unit(&self) -> f64 {
        self.known_m / self.units.value
    }

    fn relative_sigma(&self) -> f64 {
        self.units.sigma / self.units.value
    }
}

/// Known lengths that disagree by more than their uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Disagreement {
    /// The only two, by index of their measures, and their relative difference.
    Two([usize; 2], f64),
    /// One against all others, by index of its measure, and its relative difference.
    One(usize, f64),
}

/// Largest deviation that is not reported, in standard deviations.
pub(super) const MAX_SIGMAS: f64 = 3.0;
/// Largest relative difference of lengths that is not reported: a tape is read to about a
/// thousandth, and the standard deviations take the cameras as exact.
const MAX_DIFFERENCE: f64 = 0.001;

/// Returns the weights of lengths, which sum to 1: by the uncertainty of their ratios or, if one is
/// unknown, as in the sum of squared residuals.
fn weights(bars: &[ScaleBar]) -> Vec<f64> {
    let is_known = bars.iter().all(|bar| bar.relative_sigma() > 0.0);
    let weight = |bar: &ScaleBar| match is_known {
        true => 1.0 / (bar.relative_sigma() * bar.relative_sigma()),
        false => bar.units.value * bar.units.value,
    };
    let all: f64 = bars.iter().map(weight).sum();
    bars.iter().map(|bar| weight(bar) / all).collect()
}

/// Returns the scale by weighted least squares; `None` without a length.
fn scale_of(bars: &[ScaleBar]) -> Option<Scale> {
    let weights = weights(bars);
    let (mut meters, mut variance) = (0.0, 0.0);
    for (bar, weight) in bars.iter().zip(&weights) {
        meters += weight * bar.meters_per_unit();
        let share = weight * bar.relative_sigma();
        variance += share * share;
    }
    (!bars.is_empty() && meters > 0.0 && meters.is_finite()).then_some(Scale {
        meters_per_unit: meters,
        relative_sigma: libm::sqrt(variance),
        source: ScaleSource::Lengths(bars.len()),
    })
}

/// Finds the length whose exclusion leaves the best agreement of the others, if it is off by more
/// than its uncertainty and theirs; or the difference of two.
fn disagreement(bars: &[ScaleBar]) -> Option<Disagreement> {
    let mut best: Option<(f64, Disagreement, bool)> = None;
    for (n, bar) in bars.iter().enumerate() {
        let mut others = bars.to_vec();
        others.remove(n);
        let rest = scale_of(&others)?;
        let off = |bar: &ScaleBar| rest.meters_per_unit / bar.meters_per_unit() - 1.0;
        let squared = |other: &ScaleBar| {
            let sigmas = off(other) / other.relative_sigma().max(f64::MIN_POSITIVE.sqrt());
            sigmas * sigmas
        };
        let chi_squared: f64 = others.iter().map(squared).sum();
        // Others that disagree among themselves show that the uncertainty is underestimated.
        let freedom = others.len().saturating_sub(1).max(1) as f64;
        let inflation = libm::sqrt((chi_squared / freedom).max(1.0));
        let own = bar.relative_sigma();
        let sigma = libm::sqrt(own * own + rest.relative_sigma * rest.relative_sigma) * inflation;
        let difference = off(bar);
        let is_off = difference.abs() > (MAX_SIGMAS * sigma).max(MAX_DIFFERENCE);
        let found = match bars {
            [first, second] => Disagreement::Two([first.measure, second.measure], difference),
            _ => Disagreement::One(bar.measure, difference),
        };
        if best.is_none_or(|(least, ..)| chi_squared < least) {
            best = Some((chi_squared, found, is_off));
        }
    }
    let (_, found, is_off) = best?;
    (bars.len() > 1 && is_off).then_some(found)
}

impl Project {
    /// Returns all known lengths whose points exist.
    pub fn scale_bars(&self) -> Vec<ScaleBar> {
        let measures = self.document.measures.iter().enumerate();
        let bar = |(measure, known): (usize, &crate::project::Measure)| {
            Some(ScaleBar {
                measure,
                known_m: known.length_m?,
                units: self.length_in_units(known)?,
            })
        };
        measures.filter_map(bar).collect()
    }

    /// Returns the scale set by the control points or, without them, by all known lengths.
    pub fn scale(&self) -> Option<Scale> {
        match self.alignment() {
            Some(alignment) => Some(alignment.scale()),
            None => scale_of(&self.scale_bars()),
        }
    }

    /// Returns the length of a measure in meters by the scale; exact for the only one that sets it.
    pub fn length_in_meters(&self, index: usize) -> Option<Length> {
        let scale = self.scale()?;
        let units = self.length_in_units(self.document.measures.get(index)?)?;
        let value = units.value * scale.meters_per_unit;
        let own = units.sigma / units.value;
        let mut variance = own * own + scale.relative_sigma * scale.relative_sigma;
        if scale.source != ScaleSource::ControlPoints {
            // The scale contains the errors of the lengths that set it.
            let bars = self.scale_bars();
            let place = bars.iter().position(|bar| bar.measure == index);
            if let Some(place) = place {
                match bars.len() {
                    1 => variance = 0.0,
                    _ => variance -= 2.0 * weights(&bars)[place] * own * own,
                }
            }
        }
        Some(Length {
            value,
            sigma: value * libm::sqrt(variance.max(0.0)),
        })
    }

    /// Returns known lengths that disagree by more than their uncertainty.
    pub fn disagreement(&self) -> Option<Disagreement> {
        disagreement(&self.scale_bars())
    }

    /// Describes the origin of the scale, and lengths that disagree.
    pub(super) fn scale_words(&self) -> String {
        let mut words = match self.scale().map(|scale| scale.source) {
            Some(ScaleSource::Lengths(1)) => "The scale is set.".to_owned(),
            Some(ScaleSource::Lengths(count)) => {
                format!("The scale is set by {count} known lengths.")
            }
            Some(ScaleSource::ControlPoints) => "The scale is set by control points.".to_owned(),
            None => "The scale is not set: type a length that you know.".to_owned(),
        };
        if let Some(found) = self.disagreement_words() {
            words.push_str(&format!(" {found}"));
        }
        words
    }

    /// Describes known lengths that disagree.
    pub fn disagreement_words(&self) -> Option<String> {
        let percent = |difference: f64| 100.0 * difference.abs();
        Some(match self.disagreement()? {
            Disagreement::Two([a, b], difference) => format!(
                "Lengths {} and {} disagree by {:.2}%: check what you typed, and their points.",
                a + 1,
                b + 1,
                percent(difference)
            ),
            Disagreement::One(index, difference) => format!(
                "Length {} disagrees with the others by {:.2}%: check what you typed, and its \
                 points.",
                index + 1,
                percent(difference)
            ),
        })
    }

    /// Describes the difference of a measure from its known length; `None` if there is none, or if
    /// it alone sets the scale.
    pub fn residual_words(&self, index: usize) -> Option<String> {
        let known_m = self.document.measures.get(index)?.length_m?;
        let is_alone = self.scale()?.source == ScaleSource::Lengths(1);
        let off_m = self.length_in_meters(index)?.value - known_m;
        (!is_alone).then(|| {
            let (percent, off_mm) = (100.0 * off_m / known_m, 1000.0 * off_m);
            format!("{percent:+.2}% ({off_mm:+.1} mm) from what you typed")
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    fn bar(measure: usize, known_m: f64, value: f64, sigma: f64) -> ScaleBar {
        let units = Length { value, sigma };
        ScaleBar {
            measure,
            known_m,
            units,
        }
    }

    #[test]
    fn the_scale_minimizes_the_weighted_residuals() {
        let bars = [
            bar(0, 2.0, 1.0, 0.002),
            bar(1, 4.1, 2.0, 0.01),
            bar(2, 1.0, 0.49, 0.001),
        ];
        let scale = scale_of(&bars).unwrap();
        // Σ (m uᵢ − Lᵢ)² / (σᵢ Lᵢ / uᵢ)² in relative terms: each ratio by its relative sigma.
        let cost = |m: f64| -> f64 {
            let term = |bar: &ScaleBar| {
                let off = (m - bar.meters_per_unit()) / bar.relative_sigma();
                off * off
            };
            bars.iter().map(term).sum()
        };
        let m = scale.meters_per_unit;
        for other in [m - 1e-4, m + 1e-4] {
            assert!(cost(other) > cost(m), "{m}");
        }
        // Curvature of the cost: the variance of m is its inverse.
        let curvature = (cost(m + 1e-3) - 2.0 * cost(m) + cost(m - 1e-3)) / 2e-6;
        assert!((scale.relative_sigma * scale.relative_sigma * curvature - 1.0).abs() < 1e-6);
        let plain = [bar(0, 2.0, 1.0, 0.0), bar(1, 3.8, 2.0, 0.0)];
        let m = scale_of(&plain).unwrap().meters_per_unit;
        assert!((m - (2.0 + 7.6) / 5.0).abs() < 1e-12, "{m}");
        assert_eq!(scale_of(&[]), None);
    }

    #[test]
    fn the_length_that_is_off_is_named() {
        let sigma = 0.001;
        let good = |n: usize, units: f64| bar(n, 3.0 * units, units, sigma * units);
        assert_eq!(disagreement(&[good(0, 1.0)]), None);
        assert_eq!(disagreement(&[good(0, 1.0), good(1, 0.4)]), None);
        assert_eq!(
            disagreement(&[good(0, 1.0), good(1, 0.4), good(2, 0.7)]),
            None
        );
        let bad = bar(4, 3.0 * 1.05, 1.0, sigma);
        let Some(Disagreement::Two([0, 4], difference)) = disagreement(&[good(0, 1.0), bad]) else {
            panic!("they disagree");
        };
        assert!((difference.abs() - 0.05).abs() < 3e-3, "{difference}");
        for place in 0..3 {
            let mut bars = vec![good(0, 1.0), good(1, 0.4), good(2, 1.1)];
            bars[place] = ScaleBar {
                measure: place,
                known_m: bars[place].known_m * 0.97,
                ..bars[place]
            };
            let found = disagreement(&bars);
            let Some(Disagreement::One(index, off)) = found else {
                panic!("{found:?}");
            };
            assert_eq!(index, place);
            assert!((off - (1.0 / 0.97 - 1.0)).abs() < 1e-6, "{off}");
        }
        // Lengths that all disagree a little show a larger uncertainty, not a bad one.
        let scattered = [0.98, 0.99, 1.01, 1.02, 1.035];
        let bars: Vec<ScaleBar> = (scattered.iter().enumerate())
            .map(|(n, factor)| bar(n, *factor, 1.0, sigma))
            .collect();
        assert_eq!(disagreement(&bars), None);
    }
}
