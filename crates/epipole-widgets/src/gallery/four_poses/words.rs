//! Readouts and description of `four-poses`.

use super::model::FourPoses;
use crate::contract::{Readout, Words, format_number};

impl Words for FourPoses {
    fn readouts(&self) -> Vec<Readout> {
        let all = self.num_matches();
        let pose = |id, label, index: usize| {
            let count = self.poses().get(index).map(|pose| pose.num_in_front());
            let text = count.map_or("none".to_owned(), |count| format!("{count} of {all}"));
            Readout::words(id, label, text).main()
        };
        vec![
            pose("first", "R, t", 0),
            pose("second", "R, −t", 1),
            pose("third", "turned R, t", 2),
            pose("fourth", "turned R, −t", 3),
            Readout::count("matches", "Matches", all),
            Readout::words("step", "Step", self.camera2.text()),
            Readout::number("turn", "Turn", self.turn_deg(), 0, "°"),
        ]
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
            "Four poses explain {} equally well. The first puts {first} of them in front of \
             both cameras, the others {}. Camera 2 stands {}, turned by {}°.",
            match self.num_matches() {
                1 => "1 match".to_owned(),
                several => format!("{several} matches"),
            },
            others.join(", "),
            self.camera2.text(),
            format_number(self.turn_deg(), 0)
        )
    }
}
