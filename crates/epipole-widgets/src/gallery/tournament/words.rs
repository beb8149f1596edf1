//! Readouts and description of `tournament`.

use super::model::Tournament;
use super::question::Subject;
use super::rivals::{NUM_RIVALS, RIVALS, WITHIN_DEG, WITHIN_PX};
use crate::contract::{Readout, Words, format_number};
use crate::kit::words::after;

/// Describes the criterion for a success.
pub(super) fn success(subject: Subject) -> String {
    match subject {
        Subject::Line => format!("within {WITHIN_DEG}° of the hidden line"),
        Subject::Fundamental => format!("within {WITHIN_PX} px of unseen matches on average"),
    }
}

impl Words for Tournament {
    fn readouts(&self) -> Vec<Readout> {
        let (ratio, _) = self.ratio();
        let share = |rival: usize| {
            let (id, name, is_main) = RIVALS[rival];
            let readout = Readout::percent(id, name, self.share(rival, ratio), 0);
            readout.or("no runs yet").main_if(is_main)
        };
        let mut readouts: Vec<Readout> = (0..NUM_RIVALS).map(share).collect();
        readouts.push(Readout::count("runs", "Runs", self.num_runs()));
        readouts
    }

    fn describe(&self) -> String {
        let (index, ratio) = self.ratio();
        if self.num_runs() == 0 {
            let waiting = "The first runs are on their way.";
            return self.asked.problem().unwrap_or(waiting).to_owned();
        }
        let share = |rival: usize| {
            let share = 100.0 * self.share(rival, index).unwrap_or(0.0);
            format!("{} {}%", RIVALS[rival].1, format_number(share, 0))
        };
        let shares: Vec<String> = (0..NUM_RIVALS).map(share).collect();
        let thing = match self.subject() {
            Subject::Line => "Lines",
            Subject::Fundamental => "Fundamental matrices",
        };
        let stopped = after(self.asked.problem());
        format!(
            "{thing} {}, at an outlier ratio of {} over {} runs: {}.{stopped}",
            success(self.subject()),
            format_number(ratio, 1),
            self.num_runs(),
            shares.join(", ")
        )
    }
}
