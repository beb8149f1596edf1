//! The reader's guess for a curve, before the curve is shown.

use crate::contract::{Event, Handle, format_number};

/// Panel of the curves.
pub(super) const PLOT: &str = "plot";

/// Inlier ratios at which the reader guesses.
pub(super) const RATIOS: [f64; 5] = [0.3, 0.45, 0.6, 0.75, 0.9];
const IDS: [&str; 5] = ["guess30", "guess45", "guess60", "guess75", "guess90"];

/// Range of guesses: base-10 logarithms.
const DECADES: [f64; 2] = [0.0, 6.0];

/// Guessed numbers of samples.
pub(super) struct Guess {
    decades: [f64; 5],
}

impl Guess {
    /// Creates a constant guess of 100 samples.
    pub(super) fn new() -> Self {
        Self { decades: [2.0; 5] }
    }

    /// Returns inlier ratios, each with the base-10 logarithm of the guessed number of samples.
    pub(super) fn places(&self) -> [(f64, f64); 5] {
        [0, 1, 2, 3, 4].map(|index| (RATIOS[index], self.decades[index]))
    }

    /// Returns the maximum ratio between guess and true number, in either direction.
    pub(super) fn worst_factor(&self, truth: [u64; 5]) -> f64 {
        let errors = (self.decades.into_iter().zip(truth))
            .map(|(decade, count)| (decade - libm::log10(count as f64)).abs());
        libm::pow(10.0, errors.fold(0.0, f64::max))
    }

    pub(super) fn handles(&self) -> Vec<Handle> {
        let handle = |((ratio, decade), id): ((f64, f64), &'static str)| {
            let percent = format_number(100.0 * ratio, 0);
            let label = format!("Guess at {percent}% inliers");
            let count = format_number(libm::pow(10.0, decade), 0);
            Handle::new(id, PLOT, label, (ratio, decade), [[ratio; 2], DECADES])
                .told(format!("{count} samples"))
                .step([0.0, 0.05], 2)
        };
        self.places().into_iter().zip(IDS).map(handle).collect()
    }

    /// Handles a drag or, at the nearest inlier ratio, a click. Returns whether it was one.
    pub(super) fn update(&mut self, event: &Event) -> bool {
        let handles = self.handles();
        let index = match event {
            Event::HandleMoved { id, .. } => handles.iter().position(|handle| handle.id == *id),
            Event::Clicked { panel, x, .. } if *panel == PLOT => {
                let away = |index: &usize| (RATIOS[*index] - x).abs();
                (0..RATIOS.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
            }
            _ => None,
        };
        let Some(index) = index else { return false };
        if let Some((_, decade)) = handles[index].moved_by(event) {
            self.decades[index] = decade;
        }
        true
    }
}
