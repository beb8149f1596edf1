//! The number of samples that RANSAC needs, N = log(1 − p) / log(1 − wˢ), for samples of several
//! sizes.

use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider,
    format_number,
};
use epipole::robust::num_trials_with_replacement;

/// Sample sizes, and what needs them.
pub(super) const SIZES: [(usize, &str); 5] = [
    (2, "a line"),
    (4, "a homography"),
    (5, "E"),
    (7, "F from seven"),
    (8, "F from eight"),
];

/// Smallest and largest share of inliers, and the one at first.
pub(super) const SHARES: [f64; 2] = [0.1, 0.99];
const SHARE: f64 = 0.5;

const CONFIDENCE: Slider = Slider {
    id: "p",
    label: "Confidence p",
    unit: "",
    min: 0.5,
    max: 0.999,
    step: 0.001,
    default: 0.99,
    digits: 3,
    visible: true,
};
const KNOBS: &[Knob] = &[Knob::Slider(&CONFIDENCE)];

/// The model of `ransac-budget`.
pub struct RansacBudget {
    settings: Settings,
    share: f64,
}

impl RansacBudget {
    pub(super) fn share(&self) -> f64 {
        self.share
    }

    fn confidence(&self) -> f64 {
        self.settings.number(&CONFIDENCE)
    }

    /// Samples of this size needed when a share `w` are inliers.
    pub(super) fn trials(&self, size: usize, w: f64) -> Option<u64> {
        num_trials_with_replacement(w, size, self.confidence()).ok()
    }

    fn now(&self, size: usize) -> u64 {
        self.trials(size, self.share()).unwrap_or(u64::MAX)
    }
}

impl Model for RansacBudget {
    const NAME: &'static str = "ransac-budget";
    const TITLE: &'static str = "How many samples?";
    const HELP: &'static str = "Drag the dashed line to a share of inliers, or click where it should be, \
        and change the confidence.";

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            share: SHARE,
        }
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let share = self.share();
        vec![Handle {
            id: "share".to_owned(),
            panel: "plot",
            label: "Share of inliers w".to_owned(),
            value_text: format!("{} % inliers", format_number(100.0 * share, 0)),
            x: share,
            y: 0.0,
            x_range: SHARES,
            y_range: [0.0, 0.0],
            step: [0.01, 0.0],
            digits: 2,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
            }
            Event::Clicked { x, .. } | Event::HandleMoved { x, .. } => {
                let handles = self.handles();
                if let Some((share, _)) = handles[0].admit(*x, 0.0) {
                    self.share = share;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        const LABELS: [(&str, &str); 5] = [
            ("n2", "s = 2, a line"),
            ("n4", "s = 4, a homography"),
            ("n5", "s = 5, E"),
            ("n7", "s = 7, F"),
            ("n8", "s = 8, F"),
        ];
        let counts = LABELS.iter().zip(SIZES);
        counts
            .map(|((id, label), (size, _))| {
                Readout::number(id, label, self.now(size) as f64, 0, "")
            })
            .collect()
    }

    fn describe(&self) -> String {
        format!(
            "With {} % inliers and a confidence of {} %, a line needs {} samples of 2, a homography {} \
             of 4, E {} of 5, and F {} of 7 or {} of 8.",
            format_number(100.0 * self.share(), 0),
            format_number(100.0 * self.confidence(), 1),
            self.now(2),
            self.now(4),
            self.now(5),
            self.now(7),
            self.now(8),
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "cheap",
                goal: "Find the share of inliers from which on fewer than 20 samples of 8 will do.",
                hint: "Go to the right.",
                check: |model| model.now(8) < 20,
                solution: || vec![moved(0.9)],
            },
            Challenge {
                id: "dear",
                goal: "Make samples of 8 a thousand times as dear as samples of 2.",
                hint: "How do the curves run apart?",
                check: |model| model.now(8) >= 1000 * model.now(2),
                solution: || vec![moved(0.25)],
            },
        ]
    }
}

fn moved(share: f64) -> Event {
    Event::HandleMoved {
        id: "share".to_owned(),
        x: share,
        y: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_the_chapter() {
        let model = RansacBudget::new();
        assert_eq!(
            SIZES.map(|(size, _)| model.now(size)),
            [17, 72, 146, 588, 1177]
        );
    }
}
