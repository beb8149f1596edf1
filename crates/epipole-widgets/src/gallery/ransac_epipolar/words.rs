//! Readouts and description of `ransac-epipolar`.

use super::model::{RansacEpipolar, Show};
use super::votes::LeftOpen;
use crate::contract::{Readout, Words, format_number};
use crate::kit::samples::Drawn;
use crate::kit::words;
use epipole::epipolar::epipolar_line2;

/// Text in place of a missing number.
const WAITING: &str = "none yet";

/// Explains why a degenerate F means nothing, and what to do.
pub(super) fn left_open(model: &RansacEpipolar) -> Option<String> {
    let num_votes = model.best()?.num_votes;
    let why = match model.left_open()? {
        LeftOpen::Unmoved(count) => format!(
            "{count} of its {num_votes} inliers are where they were in photograph 1: the camera did not move"
        ),
        LeftOpen::Homography(count) => format!(
            "one homography explains {count} of its {num_votes} inliers: the camera only turned, or all is in one \
             plane"
        ),
    };
    Some(format!(
        "This F is one of many: {why}. Take a step aside, and photograph things at different distances."
    ))
}

impl Words for RansacEpipolar {
    fn readouts(&self) -> Vec<Readout> {
        let last = self.moment().and_then(|moment| moment.last);
        let best = self.best();
        let right = match (best, self.num_right()) {
            (Some(best), Some(count)) => format!("{count} of {}", best.num_votes),
            (Some(_), None) => "not known".to_owned(),
            (None, _) => WAITING.to_owned(),
        };
        let all = self.matches();
        let of = |count: usize| format!("{count} of {}", all.len());
        let words = |id, label, value: Option<String>| {
            Readout::words(id, label, value.unwrap_or_else(|| WAITING.to_owned()))
        };
        let now = last.map(|trial| of(trial.num_votes));
        let [drawn, needed] = Drawn::readouts(self.drawn(), WAITING);
        let mut readouts = vec![
            words("best", "Best votes", best.map(|best| of(best.num_votes))).main(),
            Readout::words("right", "Right inliers", right).main(),
            drawn.main(),
            needed.main(),
            words("inliers", "Votes now", now),
        ];
        if let Some(best) = best {
            let (label, unit) = ("Mean Sampson", "px");
            readouts.push(Readout::number("sampson", label, best.mean_px, 3, unit));
            if self.num_right().is_some() {
                let right = all.iter().filter(|found| found.is_right == Some(true));
                readouts.push(Readout::count("found", "Right matches", right.count()));
            }
            if let Ok(line) = epipolar_line2(&best.fundamental, &self.probe()) {
                let line = words::line(&line);
                readouts.push(Readout::words("line", "Probe's line", line));
            }
            let f = words::matrix(&best.fundamental);
            readouts.push(Readout::words("f", "F, by rows", f));
        }
        readouts
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.problem() {
            return problem.to_owned();
        }
        if let Some(label) = self.label() {
            return format!("{label}.");
        }
        let num_matches = self.matches().len();
        let Some((last, best)) = self
            .moment()
            .and_then(|moment| moment.last.zip(moment.best))
        else {
            return format!("{num_matches} matches, some of them wrong; no F found yet.");
        };
        let right = self.num_right().map_or_else(String::new, |count| {
            format!(", {count} of them right by the scene's true geometry")
        });
        let show = match self.show() {
            Show::Matches => "",
            Show::Outliers => " Outliers are shown.",
            Show::Lines => " Epipolar lines are shown.",
        };
        let open = words::after(left_open(self).as_deref());
        format!(
            "After {}, {} of {num_matches} matches agree on one F within {} px{right}. Their mean \
             Sampson distance is {} px. {}{show}{open}",
            last.drawn.count_words(),
            best.num_votes,
            format_number(self.epsilon_px(), 1),
            format_number(best.mean_px, 2),
            last.drawn.outlook(),
        )
    }
}
