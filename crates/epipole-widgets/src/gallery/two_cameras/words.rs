//! Readouts and description of `two-cameras`.

use super::model::{Meeting, TwoCameras};
use crate::contract::{Readout, Words, format_number};

impl Words for TwoCameras {
    fn readouts(&self) -> Vec<Readout> {
        let (_, depth_m) = self.balls()[0];
        let found = match self.meeting() {
            Meeting::Ahead(found) => Readout::number("found", "Depth found", found.y, 2, "m"),
            Meeting::Behind(_) => Readout::words("found", "Depth found", "behind us"),
            Meeting::Nowhere => Readout::words("found", "Depth found", "infinite"),
        };
        let mut readouts = vec![
            Readout::number("disparity", "Shift d", self.disparity_px(), 0, "px").main(),
            found.main(),
            Readout::number("depth", "True depth", depth_m, 2, "m").main(),
        ];
        if let Ok([left, right]) = self.columns() {
            readouts.push(Readout::number("left", "Left column", left, 1, "px"));
            readouts.push(Readout::number("right", "Right column", right, 1, "px"));
        }
        if let Meeting::Ahead(found) = self.meeting() {
            let error_m = found.y - depth_m;
            readouts.push(Readout::number("error", "Depth error", error_m, 2, "m"));
        }
        readouts
    }

    fn describe(&self) -> String {
        let (_, depth_m) = self.balls()[0];
        let shift = format_number(self.disparity_px(), 0);
        let depth = format_number(depth_m, 2);
        let meeting = match self.meeting() {
            Meeting::Ahead(found) => format!("meet {} m away", format_number(found.y, 2)),
            Meeting::Behind(_) => {
                "part; extended backward, they meet behind the cameras".to_owned()
            }
            Meeting::Nowhere => "are parallel and meet nowhere".to_owned(),
        };
        match self.is_wrong() {
            false => format!(
                "The two images of P are {shift} px apart, and the rays through them {meeting}, \
                 where P is."
            ),
            true => format!(
                "The right camera takes Q for P: the two pixels are {shift} px apart, \
                 and their rays {meeting}. P is {depth} m away, and nothing is where the rays meet."
            ),
        }
    }
}
