//! Readouts and description of `eight-point`.

use super::estimate::Estimate;
use super::model::EightPoint;
use crate::contract::{Readout, Words, format_number};
use crate::kit::meeting::Meeting;
use crate::kit::words;
use epipole::math::svd3;

impl Words for EightPoint {
    fn readouts(&self) -> Vec<Readout> {
        let estimate = self.estimate();
        let known = estimate.ok();
        let px = |id, label, value: Option<f64>| Readout::number(id, label, value, 2, "px");
        let held_out = known.map(|estimate| estimate.held_out_px);
        let used = known.map(|estimate| estimate.used_px);
        let meeting = known.and_then(|estimate| estimate.meeting);
        let condition = known.map(|estimate| estimate.chosen().condition_number);
        let condition = condition.map(|number| words::magnitude(number, 0.0));
        let condition = condition.unwrap_or_else(|| "no value".to_owned());
        let probe = "Probe's match";
        let mut readouts = vec![
            px("held-out", "Held-out points", held_out).main(),
            px("used", "Matches used", used).main(),
            px("miss", "Lines miss", meeting.map(Meeting::shown_px)).main(),
            Readout::words("condition", "Condition number", condition).main(),
            match (known, self.probe_px()) {
                (Some(_), None) => Readout::words("probe-px", probe, "not seen"),
                (_, distance) => px("probe-px", probe, distance),
            },
        ];
        readouts.extend(known.into_iter().flat_map(details));
        let state = estimate.err();
        readouts.extend(state.map(|why| Readout::words("state", "State", why)));
        readouts
    }

    fn describe(&self) -> String {
        let estimate = match self.estimate() {
            Ok(estimate) => estimate,
            Err(sentence) => return sentence.to_owned(),
        };
        format!(
            "F from {} matches with {} px of noise, {}, condition number {}. {}. Held-out points are \
             {} px from their lines on average.",
            estimate.used.len(),
            format_number(self.noise_px(), 1),
            if self.is_normalized() {
                "normalized"
            } else {
                "not normalized"
            },
            words::magnitude(estimate.chosen().condition_number, 0.0),
            match estimate.meeting {
                Some(meeting) if meeting.is_exact() =>
                    "All epipolar lines meet in the epipole".to_owned(),
                Some(meeting) => format!(
                    "Its rank is 3, so the epipolar lines miss one another, by {} px on average",
                    format_number(meeting.miss_px, 2)
                ),
                None => "The epipolar lines are nearly parallel".to_owned(),
            },
            format_number(estimate.held_out_px, 2),
        )
    }
}

/// Returns the secondary readouts: the intersection of the lines and the singular values.
fn details(estimate: &Estimate) -> Vec<Readout> {
    let sigma = &estimate.chosen().singular_values;
    let values = [0, 7, 8].map(|k| words::magnitude(sigma[k], sigma[0]));
    let of_f = svd3(&estimate.fundamental).singular_values;
    let third = of_f[2] / of_f[0].max(f64::MIN_POSITIVE);
    let place = match estimate.meeting {
        Some(meeting) => words::pixel(&meeting.place),
        None => "nearly parallel".to_owned(),
    };
    vec![
        Readout::words("meeting", "Meeting point", place),
        Readout::words("values", "σ₁, σ₈, σ₉", values.join(", ")),
        Readout::words("third", "σ₃ / σ₁", words::magnitude(third, 1.0)),
    ]
}
