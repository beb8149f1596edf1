//! Readouts and description of `ransac-budget`.

use super::model::{RansacBudget, SIZES};
use crate::contract::{Readout, Words, format_number};

impl Words for RansacBudget {
    fn readouts(&self) -> Vec<Readout> {
        const LABELS: [(&str, &str); 5] = [
            ("n2", "Line, s = 2"),
            ("n4", "Homography, s = 4"),
            ("n5", "E, s = 5"),
            ("n7", "F, s = 7"),
            ("n8", "F, s = 8"),
        ];
        let ratio = Readout::percent("w", "Inlier ratio", self.inlier_ratio, 0);
        let mut readouts = vec![ratio.main()];
        for ((id, label), size) in LABELS.into_iter().zip(SIZES) {
            let count = Readout::number(id, label, self.now(size) as f64, 0, "");
            // The smallest, a middle and the largest size carry the figure's point.
            let is_main = [2, 4, 8].contains(&size);
            readouts.push(count.main_if(is_main));
        }
        readouts
    }

    fn describe(&self) -> String {
        format!(
            "With an inlier ratio of {}% and a confidence of {}%, a line takes {} samples of 2, a \
             homography {} of 4, E {} of 5, and F {} of 7 or {} of 8.",
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
