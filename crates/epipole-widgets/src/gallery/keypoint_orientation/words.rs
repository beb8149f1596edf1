//! Readouts and description of `keypoint-orientation`.

use super::model::KeypointOrientation;
use crate::contract::{Readout, Words, format_number};

impl Words for KeypointOrientation {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let [before, after] = match self.orientations_deg() {
            Some(both) => both.map(Some),
            None => [None; 2],
        };
        let keypoints = self.num_keypoints().map(|count| count as f64);
        vec![
            number("before", "Before", before, 0, "°").main(),
            number("after", "After", after, 0, "°").main(),
            Readout::percent("second", "Second peak", self.second(), 0)
                .or(missing)
                .main(),
            number("keypoints", "Keypoints", keypoints, 0, "").main(),
            number("change", "Patch change", self.patch_change(), 1, "levels"),
        ]
    }

    fn describe(&self) -> String {
        let (Some([before, after]), Some(second), Some(keypoints), Some(change)) = (
            self.orientations_deg(),
            self.second(),
            self.num_keypoints(),
            self.patch_change(),
        ) else {
            return self.asked.sentence();
        };
        let makes = match keypoints {
            1 => "one keypoint",
            _ => "two keypoints",
        };
        format!(
            "The keypoint at {}, in a photograph turned by {}°. The peak of its histogram went from {}° to {}°. The \
             second peak has {}% of its height: {makes}. The normalized patch changed by {} gray levels.",
            self.keypoint.text(),
            format_number(self.turn_deg(), 0),
            format_number(before, 0),
            format_number(after, 0),
            format_number(100.0 * second, 0),
            format_number(change, 1),
        )
    }
}
