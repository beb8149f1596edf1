//! What `ransac-epipolar` says.

use super::model::{RansacEpipolar, Show};
use super::question::Question;
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;
use crate::kit::words;
use epipole::epipolar::epipolar_line2;

/// Stands for a number until there is one.
const WAITING: &str = "none yet";

impl Words for RansacEpipolar {
    fn readouts(&self) -> Vec<Readout> {
        let votes = self.votes();
        let best = votes.and_then(|votes| votes.best());
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
        let [drawn, needed] = votes.map_or_else(
            || {
                [
                    ("iterations", "Samples drawn"),
                    ("budget", "Samples needed"),
                ]
                .map(|(id, label)| words(id, label, None))
            },
            |votes| votes.samples().readouts(),
        );
        let mut readouts = vec![
            words(
                "best",
                "Votes for the best F",
                best.map(|best| of(best.num_votes)),
            )
            .main(),
            Readout::words("right", "Right ones among them", right).main(),
            drawn.main(),
            needed.main(),
            words(
                "inliers",
                "Votes for the last sample",
                votes.and_then(|votes| votes.num_votes_of_last()).map(of),
            ),
        ];
        if let Some(best) = best {
            let (label, unit) = ("Mean Sampson distance", "px");
            readouts.push(Readout::number("sampson", label, best.mean_px, 3, unit));
            if self.num_right().is_some() {
                let right = all.iter().filter(|found| found.is_right == Some(true));
                readouts.push(Readout::count(
                    "found",
                    "Right matches in all",
                    right.count(),
                ));
            }
            if let Ok(line) = epipolar_line2(&best.fundamental, &self.probe()) {
                let line = words::line(&line);
                readouts.push(Readout::words("line", "Line of the probe", line));
            }
            let f = words::matrix(&best.fundamental);
            readouts.push(Readout::words("f", "F of all its voters, by rows", f));
        }
        readouts
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.problem() {
            return problem.to_owned();
        }
        let Some(votes) = self.votes() else {
            return format!("{}.", Question::LABEL);
        };
        let num_matches = self.matches().len();
        let Some(best) = votes.best() else {
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
        format!(
            "After {}, {} of {num_matches} matches agree on one F within {} px{right}. Their mean \
             Sampson distance is {} px. {}{show}",
            votes.samples().count_words(),
            best.num_votes,
            format_number(self.epsilon_px(), 1),
            format_number(best.mean_px, 2),
            votes.samples().outlook(),
        )
    }
}
