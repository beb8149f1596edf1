//! Readouts and description of `ransac-budget`.

use super::model::{GUESSED, RansacBudget, SIZES};
use crate::contract::{Readout, Words, format_number};
use crate::kit::guess::NOT_COMPARED;

impl Words for RansacBudget {
    fn readouts(&self) -> Vec<Readout> {
        const LABELS: [(&str, &str); 5] = [
            ("n2", "Line, s = 2"),
            ("n4", "Homography, s = 4"),
            ("n5", "E, s = 5"),
            ("n7", "F, s = 7"),
            ("n8", "F, s = 8"),
        ];
        let ratio = self.shows_curves().then_some(self.inlier_ratio);
        let ratio = Readout::percent("w", "Inlier ratio", ratio, 0).or("hidden");
        let mut readouts = vec![ratio.main()];
        for ((id, label), size) in LABELS.into_iter().zip(SIZES) {
            let count = self.shows_curves().then(|| self.now(size) as f64);
            let count = Readout::number(id, label, count, 0, "").or("hidden");
            // The smallest, a middle and the largest size carry the figure's point.
            let is_main = [2, 4, 8].contains(&size);
            readouts.push(count.main_if(is_main));
        }
        let factor = Readout::number("off", "Off by", self.guess_factor(), 1, "×");
        readouts.push(factor.or(NOT_COMPARED));
        readouts
    }

    fn describe(&self) -> String {
        if !self.shows_curves() {
            return format!(
                "The curves are hidden. Five points are your guess of how many samples of {GUESSED} are \
                 needed, for inlier ratios from 30% to 90%."
            );
        }
        let guess = match self.guess_factor() {
            Some(factor) => {
                let factor = format_number(factor, 1);
                format!(
                    " Your guess for samples of {GUESSED} is off by up to a factor of {factor}."
                )
            }
            None => String::new(),
        };
        format!(
            "With an inlier ratio of {}% and a confidence of {}%, a line takes {} samples of 2, a \
             homography {} of 4, E {} of 5, and F {} of 7 or {} of 8.{guess}",
            format_number(100.0 * self.inlier_ratio, 0),
            format_number(100.0 * self.confidence(), 1),
            self.now(2),
            self.now(4),
            self.now(5),
            self.now(7),
            self.now(8),
        )
    }
}
