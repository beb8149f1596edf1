//! Readouts and description of `patch-match`.

use super::model::PatchMatch;
use super::question::NUM_ROUNDS;
use crate::contract::{Readout, Words};

impl Words for PatchMatch {
    fn readouts(&self) -> Vec<Readout> {
        let machine = match self.is_finished() && self.asked.answer().is_some() {
            true => format!("{} of {NUM_ROUNDS}", self.machine_score()),
            false => "after you".to_owned(),
        };
        let yours = format!("{} of {}", self.score(), self.num_picked());
        vec![
            Readout::words("score", "Your score", yours).main(),
            Readout::words("machine", "Nearest descriptor", machine).main(),
        ]
    }

    fn describe(&self) -> String {
        if self.asked.answer().is_none() {
            return self.asked.sentence();
        }
        let (picked, score) = (self.num_picked(), self.score());
        if self.is_finished() {
            let machine = self.machine_score();
            return format!(
                "All five patches are matched, {score} of them correctly. The nearest descriptor is right for \
                 {machine} of {NUM_ROUNDS}."
            );
        }
        format!(
            "Five patches of photograph 1, each with four patches of photograph 2 of which one shows the same \
             place. {picked} are matched, {score} of them correctly."
        )
    }
}
