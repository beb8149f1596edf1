//! Matches scaled to an image width, and the sizes of the columns of their equations.

use crate::contract::{
    Challenge, Control, Declared, Event, Knob, Model, Problem, Settings, Slider, knobs,
};
use crate::kit::matches::{MAX_USED, Match, Matches};
use crate::kit::scenes::PHOTO_WIDTH;
use epipole::Error;
use epipole::epipolar::{Normalization, epipolar_row};
use nalgebra::Point2;

const WIDTH: Slider = Slider::new("width", "Image width")
    .range(2.0, 4002.0, 2.0)
    .at(640.0)
    .unit("px");
const COUNT: Slider = Slider::new("count", "Matches")
    .range(8.0, MAX_USED as f64, 1.0)
    .at(20.0);
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![WIDTH, COUNT, SEED];
const NOISE_PX: f64 = 0.5;

/// Root mean square of each column of the equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes(pub(super) [f64; 9]);

impl Sizes {
    fn of(matches: &[Match]) -> Self {
        let share = 1.0 / matches.len().max(1) as f64;
        let mut squares = [0.0; 9];
        for (pixel1, pixel2) in matches {
            for (sum, entry) in squares.iter_mut().zip(epipolar_row(pixel1, pixel2)) {
                *sum += share * entry * entry;
            }
        }
        Self(squares.map(f64::sqrt))
    }

    /// Returns the ratio of the largest size to the smallest.
    pub(super) fn spread(&self) -> f64 {
        let bounds = self
            .0
            .iter()
            .fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), size| {
                (low.min(*size), high.max(*size))
            });
        bounds.1 / bounds.0.max(1e-300)
    }
}

/// The columns in raw pixels, and after Hartley's normalization.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Both {
    pub(super) raw: Sizes,
    pub(super) normalized: Sizes,
}

impl Both {
    fn new(matches: &[Match]) -> Result<Self, Error> {
        let pixels = |get: fn(&Match) -> Point2<f64>| -> Vec<Point2<f64>> {
            matches.iter().map(get).collect()
        };
        let one = Normalization::new(&pixels(|pair| pair.0))?;
        let two = Normalization::new(&pixels(|pair| pair.1))?;
        let normalized: Vec<Match> = (matches.iter())
            .map(|(pixel1, pixel2)| (one.apply(pixel1), two.apply(pixel2)))
            .collect();
        Ok(Self {
            raw: Sizes::of(matches),
            normalized: Sizes::of(&normalized),
        })
    }
}

/// The model of `column-sizes`.
pub(crate) struct ColumnSizes {
    settings: Settings,
    both: Result<Both, String>,
}

impl ColumnSizes {
    /// Returns the sizes, or a message why there are none.
    pub(super) fn both(&self) -> Result<&Both, &str> {
        self.both.as_ref().map_err(String::as_str)
    }

    pub(super) fn width_px(&self) -> f64 {
        self.settings.number(&WIDTH)
    }

    pub(super) fn count(&self) -> usize {
        self.settings.count(&COUNT)
    }

    fn compute(&mut self) {
        let scale = self.width_px() / f64::from(PHOTO_WIDTH);
        let matches = Matches::draw(self.settings.count(&SEED) as u64);
        let matches = matches.noisy(self.count(), NOISE_PX);
        let scaled: Vec<Match> = (matches.iter())
            .map(|(pixel1, pixel2)| (pixel1 * scale, pixel2 * scale))
            .collect();
        self.both = Both::new(&scaled).map_err(|error| format!("There are no columns: {error}."));
    }
}

impl Declared for ColumnSizes {
    const NAME: &'static str = "column-sizes";
    const TITLE: &'static str = "Nine columns, nine sizes";
    const HELP: &'static str = "Set how many pixels the images are wide. The matches stay the same; only their \
        unit changes.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            both: Err(String::new()),
        };
        model.compute();
        model
    }
}

impl Model for ColumnSizes {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.settings.update(event)?.is_some() {
            self.compute();
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<ColumnSizes>] = &[
    Challenge {
        id: "million",
        goal: "Make the largest raw column a million times as large as the smallest.",
        hint: "How does a product of two coordinates grow?",
        why: "The first columns are products of two coordinates, so they grow with the square of the image's \
              width, and the last column stays 1.",
        check: |model| model.both().is_ok_and(|both| both.raw.spread() >= 1e6),
        solution: || vec![Event::set(&WIDTH, 4000.0)],
    },
    Challenge {
        id: "unit",
        goal: "Bring all raw columns within a factor of 5 without normalizing.",
        hint: "In which unit are coordinates about 1?",
        why: "Nothing but the unit was wrong. Normalization chooses the unit, and the origin, in which typical \
              coordinates are about 1.",
        check: |model| model.both().is_ok_and(|both| both.raw.spread() <= 5.0),
        solution: || vec![Event::set(&WIDTH, 2.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_column_is_one_and_normalized_ones_hardly_differ() {
        let model = ColumnSizes::new();
        let both = model.both().unwrap();
        assert_eq!((both.raw.0[8], both.normalized.0[8]), (1.0, 1.0));
        assert!(both.raw.spread() > 1e4, "{}", both.raw.spread());
        assert!(
            both.normalized.spread() < 5.0,
            "{}",
            both.normalized.spread()
        );
    }

    #[test]
    fn the_unit_changes_raw_columns_alone() {
        let mut model = ColumnSizes::new();
        let before = *model.both().unwrap();
        model.update(&Event::set(&WIDTH, 1280.0)).unwrap();
        let after = *model.both().unwrap();
        // At twice the pixel coordinates, products are four times as large.
        assert!((after.raw.0[0] / before.raw.0[0] - 4.0).abs() < 1e-9);
        assert!((after.raw.0[2] / before.raw.0[2] - 2.0).abs() < 1e-9);
        for (one, other) in after.normalized.0.iter().zip(before.normalized.0) {
            assert!((one - other).abs() < 1e-9);
        }
    }

    #[test]
    fn a_column_is_as_large_as_its_entries() {
        let matches = [
            (Point2::new(3.0, 0.0), Point2::new(1.0, 2.0)),
            (Point2::new(-3.0, 0.0), Point2::new(1.0, 2.0)),
        ];
        assert_eq!(
            Sizes::of(&matches).0,
            [3.0, 0.0, 1.0, 6.0, 0.0, 2.0, 3.0, 0.0, 1.0]
        );
    }
}
