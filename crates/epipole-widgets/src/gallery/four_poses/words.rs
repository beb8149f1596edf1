//! What `four-poses` says.

use super::model::FourPoses;
use crate::contract::{Readout, Words, format_number};

impl Words for FourPoses {
    fn readouts(&self) -> Vec<Readout> {
        let names = [
            ("first", "R, t"),
            ("second", "R, −t"),
            ("third", "turned R, t"),
            ("fourth", "turned R, −t"),
        ];
        let all = self.num_matches();
        let mut readouts: Vec<Readout> = names
            .into_iter()
            .enumerate()
            .map(|(index, (id, label))| {
                let count = self.poses().get(index).map(|pose| pose.num_in_front());
                let text =
                    count.map_or_else(|| "none".to_owned(), |count| format!("{count} of {all}"));
                Readout::words(id, label, text).main()
            })
            .collect();
        readouts.push(Readout::count("matches", "Matches", all));
        readouts.push(Readout::words("step", "Step", self.place_words()));
        readouts.push(Readout::number("turn", "Turn", self.turn_deg(), 0, "°"));
        readouts
    }

    fn describe(&self) -> String {
        let counts: Vec<String> = (self.poses().iter())
            .map(|pose| pose.num_in_front().to_string())
            .collect();
        let [first, others @ ..] = &counts[..] else {
            return "Camera 2 stands where camera 1 does: without a step there is no essential \
                matrix."
                .to_owned();
        };
        if self.num_matches() == 0 {
            return "Camera 2 looks past the house, so there is no match to decide by.".to_owned();
        }
        format!(
            "Four poses explain {} matches equally well. The first puts {first} of them in front of \
             both cameras, the others {}. Camera 2 stands {}, turned by {}°.",
            self.num_matches(),
            others.join(", "),
            self.place_words(),
            format_number(self.turn_deg(), 0)
        )
    }
}
